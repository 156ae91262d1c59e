// SPDX-License-Identifier: MIT
// How walls move.
#include "number_table.hpp"
#include "reader.hpp"

#include "hyoryu/scene/piston.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hyoryu {

namespace {

// Rounding of a path that passes through the origin at time 0 [m].
constexpr double at_origin = 1e-12;

void flatten(Motion& motion, int dimensions)
{
    for (Vec3& place : motion.places) {
        place.y() = dimensions == 2 ? 0 : place.y();
    }
}

Motion read_table(TableReader& table)
{
    Motion motion;
    const auto path = read_file_path(table, "table");
    if (!path) {
        return {};
    }
    constexpr std::array<NumberColumn, 4> columns{
        {{"time", "s"}, {"x", "m"}, {"y", "m"}, {"z", "m"}}};
    const NumberTable numbers = read_number_table(*path, columns);
    for (const std::string& fault : numbers.faults) {
        table.error("table", fault, "columns are time, x, y, z in s and m");
    }
    for (std::size_t k = 0; k < numbers.rows.size(); ++k) {
        const std::vector<double>& row = numbers.rows[k];
        if (k > 0 && row[0] <= motion.times.back()) {
            table.error("table",
                        fmt::format("{}:{}: time {} does not follow {}", path->string(),
                                    numbers.lines[k], row[0], motion.times.back()),
                        "times must ascend");
            break;
        }
        motion.times.push_back(row[0]);
        motion.places.emplace_back(row[1], row[2], row[3]);
    }
    if (numbers.faults.empty() && numbers.rows.size() < 2) {
        table.error("table", fmt::format("{}: has {} rows of numbers, a path needs two",
                                         path->string(), numbers.rows.size()));
    }
    flatten(motion, table.reading().dimensions);
    if (motion.times.size() < 2) {
        return {};
    }
    const Vec3 start = displacement(motion, 0);
    for (Vec3& place : motion.places) {
        place -= start;
    }
    return motion;
}

Motion read_points(TableReader& table)
{
    Motion motion;
    table.require("times");
    table.require("places");
    motion.times = table.numbers("times");
    motion.places = table.vectors("places");
    flatten(motion, table.reading().dimensions);
    if (!table.has("times") || !table.has("places") || motion.times.empty() ||
        motion.places.empty()) {
        return {};
    }
    if (motion.times.size() != motion.places.size()) {
        table.error("places", fmt::format("has {} points for {} times", motion.places.size(),
                                          motion.times.size()));
        return {};
    }
    const auto unsorted = std::adjacent_find(motion.times.begin(), motion.times.end(),
                                             [](double a, double b) { return b <= a; });
    if (unsorted != motion.times.end()) {
        table.error_at("times", static_cast<std::size_t>(unsorted + 1 - motion.times.begin()),
                       "times must ascend");
        return {};
    }
    if (displacement(motion, 0).norm() > at_origin) {
        table.error("places", "the path is not at [0, 0, 0] at time 0",
                    "places are displacements from where the wall stands then");
    }
    return motion;
}

Motion read_piston(TableReader piston, double gravity)
{
    piston.require("solitary_height");
    piston.require("depth");
    const auto height = piston.find_number("solitary_height");
    const auto depth = piston.find_number("depth");
    piston.finish();
    if (!height || !depth) {
        return {};
    }
    if (!(gravity > 0)) {
        piston.error("depth", "there are no waves without `gravity`");
        return {};
    }
    return solitary_piston(*height, *depth, gravity);
}

} // namespace

Motion read_motion(TableReader table, double gravity)
{
    Motion motion;
    const bool points = table.has("times") || table.has("places");
    const int ways = (table.has("velocity") ? 1 : 0) + (table.has("table") ? 1 : 0) +
                     (table.has("piston") ? 1 : 0) + (points ? 1 : 0);
    if (ways > 1) {
        table.error(table.has("velocity") ? "velocity"
                    : table.has("table")  ? "table"
                                          : "times",
                    "give one of `velocity`, `table`, `piston`, or `times` and `places`");
        table.abandon();
    } else if (table.has("table")) {
        motion = read_table(table);
    } else if (table.has("piston")) {
        motion = read_piston(table.table("piston"), gravity);
    } else if (points) {
        motion = read_points(table);
    } else {
        motion.velocity = table.planar("velocity");
    }
    table.finish();
    return motion;
}

} // namespace hyoryu
