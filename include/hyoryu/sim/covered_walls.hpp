// SPDX-License-Identifier: MIT
// The volume of moving walls outside of fixed ones, see scene/covered_share.hpp.
#pragma once

#include "hyoryu/core/types.hpp"

#include <vector>

namespace hyoryu {

struct Simulation;

struct CoveredWalls {
    /// Displaced mass of the rows of moving walls, as if there were no fixed walls [kg]; empty
    /// unless the scene has both.
    std::vector<real> mass;
    std::vector<int> fixed; // numbers of the fixed walls
    std::vector<Vec3> ways; // of the walls since time 0, for which the rows are set [m]
};

/// The moving walls at time 0, as their rows are.
CoveredWalls covered_walls(const Simulation& sim);

/// Sets displaced mass and volume of the rows of moving walls for their places at that time [s].
void cover_walls(Simulation& sim, double time);

} // namespace hyoryu
