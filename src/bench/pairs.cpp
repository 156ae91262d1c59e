// SPDX-License-Identifier: MIT
#include "pairs.hpp"

namespace hyoryu::bench {

double pairs_within_support(const Fluid& fluid, const PairList& list)
{
    const FluidNeighbours& n = fluid.neighbours;
    const auto of_fluid = fluid.particles.fluid[field::position];
    const auto of_walls = fluid.particles.wall[field::position];
    const auto of_bodies = fluid.particles.body[field::position];
    const auto in = [](const Tiles& tiles, const auto& x, Index slot) -> const Vec3& {
        return x[tiles.row[at(slot - tiles.first_slot)]];
    };
    const auto place = [&](Index slot) -> const Vec3& { // slots: fluid, then walls, then bodies
        return slot >= n.body.first_slot   ? in(n.body, of_bodies, slot)
               : slot >= n.wall.first_slot ? in(n.wall, of_walls, slot)
                                           : in(n.fluid, of_fluid, slot);
    };
    double pairs = 0;
    list.for_each_pair([&](Index i, Index j) {
        const double squared = (place(i) - place(j)).squaredNorm();
        pairs += i != j && squared < sq(fluid.kernel.support) ? 1 : 0;
    });
    return pairs;
}

} // namespace hyoryu::bench
