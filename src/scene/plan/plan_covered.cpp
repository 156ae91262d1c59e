// SPDX-License-Identifier: MIT
#include "plan_covered.hpp"

#include "plan_warnings.hpp"

#include "hyoryu/scene/covered_share.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

constexpr std::size_t most_looks = 2000; // places of a wall
constexpr double noteworthy = 0.03;      // of the places that are looked at

// Whether a particle of a moving wall is as deep in a fixed wall as in its own, along the same
// normal: the two surfaces coincide there.
bool coincides(const NearestPlace& own, const SolidSurface& fixed, const Vec3& place,
               double spacing)
{
    constexpr double close = 0.1;    // spacings
    constexpr double parallel = 0.9; // cosine
    const NearestPlace other = nearest_from_centre(fixed, place - fixed.centre);
    return std::abs(other.distance - own.distance) < close * spacing &&
           other.normal.dot(own.normal) > parallel;
}

// Of the particles of a wall in the first row behind its surface those whose surface is that of a
// fixed wall at several times of the run.
double share_covered(const Scene& scene, const Wall& wall, const SolidSurface& own,
                     const SolidSurface& fixed, const std::vector<Vec3>& places)
{
    constexpr std::array parts{0.0, 0.25, 0.5, 0.75, 1.0}; // of the run
    const std::size_t stride = 1 + places.size() / most_looks;
    double looks = 0;
    double covered = 0;
    for (std::size_t k = 0; k < places.size(); k += stride) {
        const NearestPlace at_own = nearest_from_centre(own, places[k] - own.centre);
        if (at_own.distance < -scene.spacing) {
            continue;
        }
        const bool always = std::ranges::all_of(parts, [&](double part) {
            const Vec3 way = displacement(wall.motion, part * scene.time.end);
            return coincides(at_own, fixed, places[k] + way, scene.spacing);
        });
        covered += always ? 1 : 0;
        ++looks;
    }
    return looks > 0 ? covered / looks : 0;
}

} // namespace

void warn_about_covered_walls(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    if (std::ranges::all_of(facts.moving, &std::vector<Vec3>::empty)) {
        return;
    }
    const double thickness = 4 * scene.spacing; // of the sides of basins: more than is looked at
    const auto surfaces = surfaces_of(scene.walls, thickness, scene.dimensions);
    for (std::size_t w = 0; w < facts.moving.size(); ++w) {
        const Wall& wall = scene.walls[w];
        for (std::size_t f = 0; f < scene.walls.size(); ++f) {
            if (!moves(scene.walls[f].motion) &&
                share_covered(scene, wall, surfaces[w], surfaces[f], facts.moving[w]) >
                    noteworthy) {
                warn(scene, wall.place, table_of(wall, w),
                     fmt::format("the surface of the moving wall \"{}\" lies in that of the fixed "
                                 "wall \"{}\", which alone acts on the water there",
                                 wall.name, scene.walls[f].name),
                     "open that side of the basin, or let the moving wall stand in front of it",
                     plan);
            }
        }
    }
}

} // namespace hyoryu
