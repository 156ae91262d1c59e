// SPDX-License-Identifier: MIT
// Where the solids of a simulation are, and how far points are from them.
#pragma once

#include "hyoryu/sim/simulation.hpp"
#include "hyoryu/sim/wall_barrier.hpp"

#include <array>

namespace hyoryu {

/// Walls at a time, then bodies at their poses.
void place_solids(const Simulation& sim, std::span<const Pose> poses, double time,
                  std::vector<SolidPlace>& places);

/// The nearest place of a solid, with the normal in its own axes; distance infinity if it is
/// farther away.
NearestPlace nearest_of(const WallBarrier& barrier, const SolidPlace& place, std::size_t solid,
                        const Vec3& x, double farthest);

/// Calls f(x); in a periodic domain for x in the first period and for those of its images that are
/// within `reach` of an edge of it: positions beyond an edge are images.
void for_images(const Fluid& fluid, const Vec3& x, double reach, const auto& f)
{
    if (fluid.period == Vec3(0, 0, 0)) {
        f(x);
        return;
    }
    const Vec3 own = fluid.neighbours.fluid.lattice.wrapped(x);
    std::array<int, 3> first{}, last{};
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        const double low = own[a] - fluid.domain_min[a];
        first[k] = fluid.period[a] > 0 && fluid.period[a] - low < reach ? -1 : 0;
        last[k] = fluid.period[a] > 0 && low < reach ? 1 : 0;
    }
    for (int i = first[0]; i <= last[0]; ++i) {
        for (int j = first[1]; j <= last[1]; ++j) {
            for (int k = first[2]; k <= last[2]; ++k) {
                f(Vec3(own + Vec3(i, j, k).cwiseProduct(fluid.period)));
            }
        }
    }
}

} // namespace hyoryu
