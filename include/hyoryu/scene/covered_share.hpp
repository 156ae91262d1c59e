// SPDX-License-Identifier: MIT
// Fixed walls within moving ones.
//
// A part of a moving wall may lie within a fixed wall: the foot of a paddle in the floor, a piston
// that starts in line with the side of a basin, or a platform that rises out of the floor. What two
// walls share must act on the water once, and there the moving wall acts: its surface, and not that
// of the fixed wall, comes out or bounds what comes out. A particle of a fixed wall has the volume
// of the part of its cell outside of all moving walls, which changes as these move. With the fixed
// wall in its place, water that follows a platform would recede from hidden particles at rest, and
// lose its density and pressure.
#pragma once

#include "hyoryu/scene/scene.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <array>
#include <span>
#include <vector>

namespace hyoryu {

/// The periodic directions of a scene; length 0 along the others [m].
struct Periods {
    Vec3 first{0, 0, 0}, length{0, 0, 0};
};

Periods periods_of(const Scene& scene);

/// Calls f(image) for a place in the first period and for those of its images that are within
/// `reach` of an edge of it [m]. `first`: its lower corner [m]; `length`: as of Periods.
void over_images(const Vec3& own, const Vec3& first, const Vec3& length, double reach,
                 const auto& f)
{
    std::array<int, 3> low{}, high{};
    for (int a = 0; a < 3; ++a) {
        const double from_low = own[a] - first[a];
        low[at(a)] = length[a] > 0 && length[a] - from_low < reach ? -1 : 0;
        high[at(a)] = length[a] > 0 && from_low < reach ? 1 : 0;
    }
    for (int i = low[0]; i <= high[0]; ++i) {
        for (int j = low[1]; j <= high[1]; ++j) {
            for (int k = low[2]; k <= high[2]; ++k) {
                f(Vec3(own + Vec3(i, j, k).cwiseProduct(length)));
            }
        }
    }
}

/// A wall where it is.
struct MovedWall {
    const SolidSurface* solid = nullptr;
    Vec3 centre{0, 0, 0}; // [m]
};

/// The walls that move, where they are at a time [s]; `surfaces`: of all walls.
std::vector<MovedWall> moving_covers(const Scene& scene, std::span<const SolidSurface> surfaces,
                                     double time);

/// The share of a cell about a place, or about its images in the domain, that lies outside of the
/// covers, by 27 parts of it, of which each cover cuts one by a plane. `edge`: of the cell [m].
double uncovered_share(std::span<const MovedWall> covers, const Vec3& place, double edge,
                       const Periods& periods);

} // namespace hyoryu
