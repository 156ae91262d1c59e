// SPDX-License-Identifier: MIT
// Moving walls within fixed ones.
//
// A part of a moving wall may lie within a fixed wall: the foot of a paddle in the floor, or a
// piston that starts in line with the side of a basin. What two walls share must act on the water
// once. Fixed walls keep their volume; a particle of a moving wall has that of the part of its cell
// outside of all fixed walls, which changes as the wall moves.
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

/// The numbers of the walls that do not move.
std::vector<int> fixed_walls_of(const Scene& scene);

/// The share of a cell about a place, or about its image in the domain, that lies outside of the
/// walls `fixed`, by 27 parts of it, of which each wall cuts one by a plane. `edge`: of the cell
/// [m]. `surfaces`: of all walls.
double uncovered_share(std::span<const SolidSurface> surfaces, std::span<const int> fixed,
                       const Vec3& place, double edge, const Periods& periods);

} // namespace hyoryu
