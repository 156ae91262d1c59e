// SPDX-License-Identifier: MIT
#include "plan_gaps.hpp"

#include "plan_warnings.hpp"

#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

// A wall as surfaces that can each be at a distance: a basin as its sides.
std::vector<SolidSurface> parts_of(const Scene& scene, const Wall& wall)
{
    const SolidSurface whole = surface_of(wall, thickness_of_rows(scene), scene.dimensions);
    const auto* basin = std::get_if<HollowBox>(&whole.shape);
    if (basin == nullptr) {
        return {whole};
    }
    std::vector<SolidSurface> sides;
    for (const Bounds& side : basin->sides) {
        SolidSurface part = whole;
        part.shape = SolidBox{(side.max - side.min) / 2};
        part.centre = (side.min + side.max) / 2;
        sides.push_back(part);
    }
    return sides;
}

double distance(const SolidSurface& solid, const Vec3& point, int dimensions)
{
    Vec3 r = point - solid.centre;
    r.y() = dimensions == 2 ? 0 : r.y();
    return nearest_from_centre(solid, r).distance;
}

// From the surface of a wall, whose particles are at these points, to another solid [m].
double gap_between(const SolidSurface& own, std::span<const Vec3> points, const SolidSurface& other,
                   int dimensions)
{
    double gap = infinity;
    for (const Vec3& p : points) {
        gap = std::min(gap, distance(other, p, dimensions) + distance(own, p, dimensions));
    }
    return gap;
}

// Gaps that are larger are meant: four spacings, or a tenth of the size of the obstacle [m].
double largest_slip(const Scene& scene, const SolidWall& solid)
{
    const Bounds box = bounds(placed(solid, scene.dimensions));
    return std::max(4 * scene.spacing, 0.1 * (box.max - box.min).maxCoeff());
}

void warn_about_gap(const Scene& scene, std::size_t wall, const Wall& other, double gap, Plan& plan)
{
    warn(scene, scene.walls[wall].place, table_of(scene.walls[wall], wall),
         fmt::format("\"{}\" moves and leaves a gap of {:.3g} m, {:.2g} spacings, to \"{}\": water "
                     "passes through it",
                     scene.walls[wall].name, gap, gap / scene.spacing, other.name),
         "extend it to half a spacing from that wall", plan);
}

} // namespace

void warn_about_gaps(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const auto* solid = std::get_if<SolidWall>(&scene.walls[w].geometry);
        if (solid == nullptr || !moves(scene.walls[w].motion)) {
            continue;
        }
        const SolidSurface own = parts_of(scene, scene.walls[w]).front();
        for (const Wall& other : scene.walls) {
            if (moves(other.motion)) {
                continue;
            }
            for (const SolidSurface& part : parts_of(scene, other)) {
                const double gap = gap_between(own, facts.moving[w], part, scene.dimensions);
                if (gap > scene.spacing * (1 - 1e-6) && gap < largest_slip(scene, *solid)) {
                    warn_about_gap(scene, w, other, gap, plan);
                }
            }
        }
    }
}

} // namespace hyoryu
