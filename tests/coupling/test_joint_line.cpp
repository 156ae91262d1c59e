// SPDX-License-Identifier: MIT
// The direct solution along a line of cells that are all wet is the one that sweeps find: lines
// drawn at random, level and on slopes, with rims that are wet, dry or closed. With air in it there
// is none.
#include "../../src/coupling/joint_line.hpp"
#include "../dice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyoryu::test_joint_line {
namespace {

// Lines of cells that follow each other; between lines some cells are not joined.
std::vector<JointWay> random_line(std::uint64_t seed, int cells)
{
    Dice dice(seed);
    std::vector<JointWay> ways(static_cast<std::size_t>(4 * cells));
    std::vector<bool> joined;
    for (int c = 0; c < cells; ++c) {
        joined.push_back(!dice.chance(0.05));
    }
    const double rise = dice.chance(0.5) ? 0 : dice.between(-100, 100);
    for (int c = 0; c < cells; ++c) {
        for (int edge = 0; edge < 2 && joined[static_cast<std::size_t>(c)]; ++edge) {
            const int next = c + 2 * edge - 1;
            JointWay& way = ways[static_cast<std::size_t>(4 * c + edge)];
            if (next >= 0 && next < cells && joined[static_cast<std::size_t>(next)]) {
                way = {1, 0, 0, next, edge == 0 ? rise : -rise};
            } else if (edge == 0 || !dice.chance(0.3)) { // else closed
                way = {2, dice.chance(0.2) ? dice.between(-300, 0) : dice.between(0, 4000),
                       dice.between(0.05, 1), -1, 0};
            }
        }
    }
    return ways;
}

// Projected Gauss-Seidel to rest.
std::vector<double> swept(const JointWays& ways, std::vector<double> pressure)
{
    double change = 1;
    for (int sweep = 0; sweep < 400000 && change > 0; ++sweep) {
        change = 0;
        for (std::size_t c = 0; c < pressure.size(); ++c) {
            const double now = std::max(balanced(ways, pressure, static_cast<int>(c)), 0.0);
            change = std::max(change, std::abs(now - pressure[c]));
            pressure[c] = now;
        }
    }
    return pressure;
}

TEST(JointLine, TheDirectSolutionOfAWetLineIsThatOfTheSweeps)
{
    int solved = 0;
    for (int seed = 1; seed <= 200; ++seed) {
        Dice dice(static_cast<std::uint64_t>(seed) + 1000);
        const int cells = 1 + dice.below(24);
        const std::vector<JointWay> line = random_line(static_cast<std::uint64_t>(seed), cells);
        const JointWays ways{line, 2};
        std::vector<double> pressure(static_cast<std::size_t>(cells), dice.between(0, 1000));
        const std::vector<double> expected = swept(ways, pressure);
        if (!solve_line(ways, pressure)) {
            continue;
        }
        solved += 1;
        for (std::size_t c = 0; c < pressure.size(); ++c) {
            EXPECT_NEAR(pressure[c], expected[c], 1e-9) << "seed " << seed << " cell " << c;
        }
    }
    EXPECT_GT(solved, 50) << "lines that are wet all along";
}

} // namespace
} // namespace hyoryu::test_joint_line
