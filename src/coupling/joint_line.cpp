// SPDX-License-Identifier: MIT
#include "joint_line.hpp"

#include <algorithm>
#include <vector>

namespace hyoryu {

namespace {

constexpr int most_rounds = 8; // three if the flow through a half-wet rim reverses

// One row: -below q[c-1] + own q[c] - above q[c+1] = right.
struct LineRow {
    double below = 0, own = 1, above = 0, right = 0;
};

// Sets up the equations of a completely wet line; `pressure` only decides the directions of flow at
// the rims.
LineRow row_of(const JointWays& ways, std::span<const double> pressure, int cell)
{
    const double own = pressure[cell];
    LineRow row{0, 0, 0, 0};
    for (int edge = 0; edge < 2; ++edge) {
        const JointWay& way = ways(cell, edge);
        const double g = way.next >= 0 ? way.conductance : open_conductance(way, own, pressure);
        row.own += g;
        row.right += g * (way.next >= 0 ? way.rise : way.pressure);
        if (way.next >= 0) {
            (way.next < cell ? row.below : row.above) = g;
        }
    }
    return row.own > 0 ? row : LineRow{0, 1, 0, own};
}

// Elimination without pivoting: the rows are diagonally dominant. A section of the line without
// outflow keeps the pressure of its last cell.
std::vector<double> eliminate(std::span<const double> before, std::vector<LineRow>& rows)
{
    constexpr double round_off = 1e-12;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const double factor = rows[k].below / rows[k - 1].own;
        const double own = rows[k].own - factor * rows[k - 1].above;
        const double right = rows[k].right + factor * rows[k - 1].right;
        const bool closed = own <= round_off * rows[k].own;
        rows[k] = closed ? LineRow{0, 1, 0, before[k]} : LineRow{0, own, rows[k].above, right};
    }
    std::vector<double> solution(rows.size(), 0);
    for (std::size_t k = rows.size(); k-- > 0;) {
        const double above = k + 1 < rows.size() ? rows[k].above * solution[k + 1] : 0;
        solution[k] = (rows[k].right + above) / rows[k].own;
    }
    return solution;
}

} // namespace

double open_conductance(const JointWay& way, double own, std::span<const double> pressure)
{
    if (way.next < 0) {
        return way.conductance * (way.pressure > own ? way.enters : 1);
    }
    const double its = pressure[way.next];
    return its > 0 || its + way.rise < own ? way.conductance : 0; // none out of air
}

double balanced(const JointWays& ways, std::span<const double> pressure, int cell)
{
    const double own = pressure[cell];
    double total = 0;
    double weight = 0;
    for (int edge = 0; edge < ways.edges; ++edge) {
        const JointWay& way = ways(cell, edge);
        const double g = open_conductance(way, own, pressure);
        total += g * (way.next >= 0 ? pressure[way.next] + way.rise : way.pressure);
        weight += g;
    }
    return weight > 0 ? total / weight : own;
}

bool solve_line(const JointWays& ways, std::span<double> pressure)
{
    const int cells = static_cast<int>(pressure.size());
    std::vector<LineRow> rows(pressure.size());
    std::vector<double> now(pressure.begin(), pressure.end());
    for (int round = 0; round < most_rounds; ++round) {
        for (int c = 0; c < cells; ++c) {
            rows[c] = row_of(ways, now, c);
        }
        std::vector<double> next = eliminate(now, rows);
        for (int c = 0; c < cells; ++c) {
            const bool joined = ways(c, 0).next >= 0 || ways(c, 1).next >= 0 ||
                                ways(c, 0).conductance + ways(c, 1).conductance > 0;
            if (joined && !(next[c] > 0)) {
                return false; // air
            }
        }
        if (next == now) {
            std::ranges::copy(now, pressure.begin());
            return true;
        }
        now = std::move(next);
    }
    return false;
}

} // namespace hyoryu
