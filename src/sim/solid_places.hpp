// SPDX-License-Identifier: MIT
// Where the solids of a simulation are, and how far points are from them.
#pragma once

#include "hyoryu/scene/covered_share.hpp"
#include "hyoryu/sim/simulation.hpp"
#include "hyoryu/sim/wall_barrier.hpp"

namespace hyoryu {

/// Walls at a time, then bodies at their poses.
void place_solids(const Simulation& sim, std::span<const Pose> poses, double time,
                  std::vector<SolidPlace>& places);

/// The nearest place of a solid, with the normal in its own axes; distance infinity if it is
/// farther away.
NearestPlace nearest_of(const WallBarrier& barrier, const SolidPlace& place, std::size_t solid,
                        const Vec3& x, double farthest);

/// The solids that a particle of a tile may meet within two spacings, ascending, since the last
/// step of the barrier. `r`: of the particle from the centre of the tile [m].
std::span<const int> solids_near(const WallBarrier& barrier, const TileLattice& lattice, Index tile,
                                 const Vec3& r);

/// Calls f(x); in a periodic domain for x in the first period and for those of its images that are
/// within `reach` of an edge of it: positions beyond an edge are images.
void for_images(const Fluid& fluid, const Vec3& x, double reach, const auto& f)
{
    if (fluid.period == Vec3(0, 0, 0)) {
        f(x);
        return;
    }
    over_images(fluid.neighbours.fluid.lattice.wrapped(x), fluid.domain_min, fluid.period, reach,
                f);
}

} // namespace hyoryu
