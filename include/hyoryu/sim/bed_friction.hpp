// SPDX-License-Identifier: MIT
// Friction of rough beds by Manning's formula. A column of water of depth h and mean velocity U
// along the bed is braked by the stress
//     tau = rho g n^2 |U|^2 / h^(1/3),
// here as a force on the particles within a spacing dp of the wall, whose layer has the mass rho dp
// by area, against their own velocity v along the surface:
//     v <- v / (1 + dt g n^2 |U|^2 / (h^(1/3) dp |v|)),
// which is stable for any step and never turns a velocity round. Depth and mean velocity are those
// of columns about four spacings wide, taken in the middle of each step. The depth is the volume of
// the water in a column over the area of the bed below it. This area is the volume of the particles
// less than dp above a wall, along gravity, over dp: walls and edges of the domain cut columns. The
// wall receives the reaction.
#pragma once

#include "hyoryu/core/types.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace hyoryu {

struct Simulation;

/// Memory of the friction, of one step; empty without rough walls.
struct BedFriction {
    std::vector<int> walls; // that are rough

    std::array<Index, 2> count{1, 1};                // columns along x and y
    std::array<double, 2> width{1, 1};               // of a column [m]
    std::vector<std::int32_t> particles;             // in each column
    std::vector<std::int32_t> lowest;                // of them, within a spacing above a wall
    std::vector<std::array<std::int64_t, 3>> speeds; // their sum, in units of 2^-30 c0
};

/// The rough walls of a scene with fluid.
BedFriction make_bed_friction(const Simulation& sim);

/// Brakes the fluid at rough walls in the middle of a step of length dt, after the barrier, which
/// knows where the walls are; adds the reactions to the sums of the loads.
void rub_on_beds(Simulation& sim, double dt);

} // namespace hyoryu
