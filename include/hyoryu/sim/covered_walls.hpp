// SPDX-License-Identifier: MIT
// The volumes of moving and fixed walls that overlap, see scene/covered_share.hpp.
#pragma once

#include "hyoryu/core/types.hpp"

#include <vector>

namespace hyoryu {

struct Simulation;

struct CoveredWalls {
    bool needed = false;         // some walls move and others do not
    std::vector<real> of_moving; // displaced mass of the rows of moving walls, uncovered [kg]
    std::vector<real> mass; // the same of each row that may be covered before the next lists [kg]
    long long builds = -1;  // of the lists
    std::vector<Vec3> ways; // of the walls since time 0, for which the rows are set [m]
};

/// None of the rows is set yet.
CoveredWalls covered_walls(const Simulation& sim);

/// Sets the displaced mass of rows of walls for the places of moving walls at that time [s]; to be
/// called when lists were made, before their volumes are computed.
void cover_walls(Simulation& sim, double time);

} // namespace hyoryu
