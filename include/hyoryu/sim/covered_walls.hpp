// SPDX-License-Identifier: MIT
// The volume of fixed walls outside of moving ones, see scene/covered_share.hpp.
#pragma once

#include "hyoryu/core/types.hpp"

#include <vector>

namespace hyoryu {

struct Simulation;

struct CoveredWalls {
    bool needed = false; // some walls move and others do not
    // Displaced mass of each row of fixed walls as if there were no moving walls, for one set of
    // lists; none where no moving wall is near [kg].
    std::vector<real> mass;
    long long builds = -1;  // of the lists
    std::vector<Vec3> ways; // of the walls since time 0, for which the rows are set [m]
};

/// None of the rows is set yet.
CoveredWalls covered_walls(const Simulation& sim);

/// Sets the displaced mass of the rows of fixed walls for the places of moving walls at that time
/// [s]; to be called when lists were made, before their volumes are computed.
void cover_walls(Simulation& sim, double time);

} // namespace hyoryu
