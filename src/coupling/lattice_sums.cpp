// SPDX-License-Identifier: MIT
#include "lattice_sums.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Sums W over a row of the lattice at a distance z, from the point first_x on.
double row_sum(const Fluid& fluid, int first_x, double z)
{
    const double dp = fluid.parameters.spacing;
    const int reach = static_cast<int>(fluid.kernel.support / dp) + 1;
    const int across = fluid.parameters.dimensions == 3 ? reach : 0;
    double total = 0;
    for (int x = first_x; x <= reach; ++x) {
        for (int y = -across; y <= across; ++y) {
            const Vec<real> r{x * dp, y * dp, z};
            total += fluid.kernel(r).w;
        }
    }
    return total;
}

// Sum of -F z between a row of fluid at a distance from a face, in spacings, and the rows of solid
// behind the face.
double push_on_face(const Fluid& fluid, double distance)
{
    const double dp = fluid.parameters.spacing;
    const int reach = static_cast<int>(fluid.kernel.support / dp) + 1;
    const int across = fluid.parameters.dimensions == 3 ? reach : 0;
    double total = 0;
    for (int row = 0; row <= reach; ++row) {
        const double z = (distance + row + 0.5) * dp;
        for (int x = -reach; x <= reach; ++x) {
            for (int y = -across; y <= across; ++y) {
                const Vec<real> r{x * dp, y * dp, z};
                total -= z * fluid.kernel(r).f;
            }
        }
    }
    return total;
}

// Sum of -F z over all pairs of particles of a column of fluid before a face and one of solid
// behind it, a number of spacings beside it.
double push_of_column(const Fluid& fluid, double beside)
{
    const double dp = fluid.parameters.spacing;
    const int reach = static_cast<int>(fluid.kernel.support / dp) + 1;
    const int across = fluid.parameters.dimensions == 3 ? reach : 0;
    double total = 0;
    for (int apart = 1; apart <= reach; ++apart) { // rows; as many pairs are that far apart
        for (int y = -across; y <= across; ++y) {
            const Vec<real> r{beside * dp, y * dp, apart * dp};
            total -= apart * apart * fluid.kernel(r).f;
        }
    }
    return total;
}

// The k-th column of solid behind the edge meets the columns of fluid from the k-th on.
double push_across_edge(const Fluid& fluid, double apart)
{
    const int reach = static_cast<int>(fluid.kernel.support / fluid.parameters.spacing) + 1;
    double all = 0;
    double across = 0;
    for (int k = -reach; k <= reach; ++k) {
        all += push_of_column(fluid, k);
        across += std::max(k, 0) * push_of_column(fluid, k + apart);
    }
    return across / all;
}

// Sum of W at a distance z over the columns of fluid beyond a rim.
double row_beside(const Fluid& fluid, double inside, double z)
{
    const double dp = fluid.parameters.spacing;
    const int reach = static_cast<int>(fluid.kernel.support / dp) + 1;
    const int across = fluid.parameters.dimensions == 3 ? reach : 0;
    double total = 0;
    for (int x = 0; x < reach; ++x) {
        for (int y = -across; y <= across; ++y) {
            const Vec<real> r{(inside + 0.5 + x) * dp, y * dp, z * dp};
            total += fluid.kernel(r).w;
        }
    }
    return total;
}

// The same over all heights, as the columns may stand at any height over their floor.
double columns_beside(const Fluid& fluid, double inside, double width)
{
    constexpr int parts = 8; // of a spacing of height
    const double reach = fluid.kernel.support / fluid.parameters.spacing;
    double total = 0;
    // Solid particles are half a spacing behind their face.
    for (double z = -width - 0.5 + 0.5 / parts; z < reach; z += 1.0 / parts) {
        total += row_beside(fluid, inside, z) / parts;
    }
    return total;
}

} // namespace

double LatticeSums::row(double width) const
{
    const double place = steps * std::clamp(width - 0.5, 0.0, 1.5);
    const auto k = std::min(static_cast<int>(place), 3 * steps / 2 - 1);
    return between[at(k)] + (place - k) * (between[at(k + 1)] - between[at(k)]);
}

double LatticeSums::beyond(const BeyondRim& sums, double inside, double width)
{
    const double i = 4 * std::clamp(inside, 0.0, 3.0);
    const double w = 4 * std::clamp(width - 0.5, 0.0, 1.5);
    const int i0 = std::min(static_cast<int>(i), insides - 2);
    const int w0 = std::min(static_cast<int>(w), floors - 2);
    const auto along = [&](int k) {
        const auto& row = sums[at(k)];
        return row[at(w0)] + (w - w0) * (row[at(w0 + 1)] - row[at(w0)]);
    };
    return inside < 3 ? along(i0) + (i - i0) * (along(i0 + 1) - along(i0)) : 0;
}

double LatticeSums::transmitted(double width) const
{
    const double place = steps * std::clamp(2 * width - 1, 0.0, 1.0);
    const auto k = std::min(static_cast<int>(place), steps - 1);
    const auto in_table = [&](const std::array<double, steps + 1>& table) {
        return table[at(k)] + (place - k) * (table[at(k + 1)] - table[at(k)]);
    };
    return in_table(pushes) * std::clamp(4 * width - 1, 0.0, 1.0) +
           in_table(films) * std::clamp(2 * width - 1, 0.0, 1.0);
}

double LatticeSums::across_edge(double apart) const
{
    const double place = steps * std::clamp(apart, 0.0, 2.0);
    const auto k = std::min(static_cast<int>(place), 2 * steps - 1);
    const double sum = across[at(k)] + (place - k) * (across[at(k + 1)] - across[at(k)]);
    return apart < 2 ? sum : 0;
}

LatticeSums lattice_sums(const Fluid& fluid)
{
    const double dp = fluid.parameters.spacing;
    const int reach = static_cast<int>(fluid.kernel.support / dp) + 1;
    LatticeSums sums;
    for (int k = 0; k <= 3 * LatticeSums::steps / 2; ++k) {
        // Solid particles are half a spacing behind their face.
        const double width = 0.5 + static_cast<double>(k) / LatticeSums::steps;
        sums.between[at(k)] = row_sum(fluid, -reach, (1 + width) / 2 * dp);
    }
    double all = 0; // rows of fluid before a face, a spacing apart
    for (int row = 0; row <= reach; ++row) {
        all += push_on_face(fluid, row + 0.5);
    }
    for (int k = 0; k <= LatticeSums::steps; ++k) {
        const double width = 0.5 + 0.5 * k / LatticeSums::steps;
        sums.pushes[at(k)] = push_on_face(fluid, width / 2) / all;
        for (int row = 0; row <= reach; ++row) {
            sums.films[at(k)] += push_on_face(fluid, width + row + 0.5) / all;
        }
    }
    sums.rim = row_sum(fluid, 1, 0);
    for (int row = 1; row <= reach; ++row) {
        sums.below += row_sum(fluid, 1, (row + 0.5) * dp);
        sums.under += row > 1 ? row_sum(fluid, -reach, row * dp) : 0;
    }
    sums.first = row_sum(fluid, -reach, dp);
    for (int i = 0; i < LatticeSums::insides; ++i) {
        for (int w = 0; w < LatticeSums::floors; ++w) {
            const double width = 0.5 + w / 4.0;
            sums.fluid_beyond[at(i)][at(w)] = columns_beside(fluid, i / 4.0, width);
            sums.row_beyond[at(i)][at(w)] = row_beside(fluid, i / 4.0, (1 + width) / 2);
        }
    }
    for (int k = 0; k <= 2 * LatticeSums::steps; ++k) {
        sums.across[at(k)] = push_across_edge(fluid, static_cast<double>(k) / LatticeSums::steps);
    }
    return sums;
}

} // namespace hyoryu
