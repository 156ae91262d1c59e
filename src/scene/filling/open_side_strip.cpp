// SPDX-License-Identifier: MIT
// The space that walls leave to the water in the strips before open sides, from the exact surfaces
// of the walls.
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/open_settings.hpp"
#include "hyoryu/scene/solid_surface.hpp"
#include "open_side.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

constexpr int cubes_per_spacing = 2; // in which space is measured
constexpr int most_levels = 1000;    // above them the space goes on as it is

// Levels from the lowest ground of a strip to the top of its window, all spaces yet 0.
StripSpace levels_of(const OpenSettings& open, const OpenSide& side, double spacing)
{
    StripSpace levels;
    levels.step = spacing / cubes_per_spacing;
    levels.low = std::ranges::min(side.below_wall);
    const double count = std::ceil((open.max.z() - levels.low) / levels.step - 1e-6);
    levels.below.assign(at(static_cast<Index>(std::clamp(count, 2.0, 1.0 * most_levels)) + 1), 0);
    return levels;
}

// Adds the free parts of the cubes of a vertical, from the ground up. A cube is cut by the surface
// of a wall as by a plane along its faces; a distance of d says that of all cubes within it.
void add_vertical(std::span<const SolidSurface* const> near, Vec3 x, double ground, double weight,
                  StripSpace& space)
{
    const double h = space.step;
    const auto cubes = std::ssize(space.below) - 1;
    auto k = static_cast<Index>(std::max(std::floor((ground - space.low) / h), 0.0));
    while (k < cubes) {
        x.z() = space.low + (static_cast<double>(k) + 0.5) * h;
        double distance = infinity;
        for (const SolidSurface* solid : near) {
            distance = std::min(distance, nearest_from_centre(*solid, x - solid->centre).distance);
        }
        const double share = std::clamp(0.5 + distance / h, 0.0, 1.0);
        const double alike = std::floor(std::abs(distance) / h - 0.5) + 1;
        const Index end = alike < static_cast<double>(cubes - k)
                              ? k + std::max(static_cast<Index>(alike), Index(1))
                              : cubes;
        for (; k < end; ++k) {
            space.below[at(k + 1)] += weight * share;
        }
    }
}

// Surfaces that reach into the strip of a station.
std::vector<const SolidSurface*> surfaces_near(const std::vector<SolidSurface>& surfaces,
                                               const OpenSide& side, int station,
                                               const StripSpace& levels, const Scene& scene)
{
    const double dp = scene.spacing;
    const double height = levels.step * static_cast<double>(levels.below.size());
    Vec3 middle = point_of_window(side, station * side.station_lanes, strip_half * dp);
    middle[1 - side.axis] +=
        scene.dimensions == 2 ? 0 : 0.5 * (side.station_lanes - 1) * side.lane_width;
    middle.z() = levels.low + height / 2;
    const double reach =
        dp + Vec3(strip_half * dp, side.station_lanes * side.lane_width / 2, height / 2).norm();
    std::vector<const SolidSurface*> near;
    for (const SolidSurface& surface : surfaces) {
        if (nearest_from_centre(surface, middle - surface.centre).distance < reach) {
            near.push_back(&surface);
        }
    }
    return near;
}

// Adds the space of a column of a lane, cut into verticals.
void add_column(const Scene& scene, const OpenSide& side, int lane, int column,
                std::span<const SolidSurface* const> near, StripSpace& space)
{
    const double dp = scene.spacing;
    const double h = space.step;
    const int across = scene.dimensions == 2 ? 1 : cubes_per_spacing;
    const double ground = side.below_wall[at(lane * strip_columns + column)] - dp;
    for (int a = 0; a < cubes_per_spacing; ++a) {
        const double s = column * dp + (a + 0.5) * h;
        const double part = side.lane_width / across; // of the width of the lane
        const double volume = strip_weight(s, dp) * (across == 1 ? h * h : h * h * part);
        for (int b = 0; b < across; ++b) {
            Vec3 x = point_of_window(side, lane, s);
            x[1 - side.axis] += across == 1 ? 0 : (b + 0.5) * part - side.lane_width / 2;
            add_vertical(near, x, ground, volume, space);
        }
    }
}

} // namespace

std::vector<StripSpace> strip_spaces(const Scene& scene, const OpenSettings& open,
                                     const OpenSide& side)
{
    if (side.wall.empty() || !(std::ranges::min(side.below_wall) < infinity)) {
        return {};
    }
    const auto surfaces = surfaces_of(scene.walls, thickness_of_rows(scene), scene.dimensions);
    std::vector<StripSpace> spaces(at(side.stations()), levels_of(open, side, scene.spacing));
    for (int c = 0; c < side.stations(); ++c) {
        StripSpace& space = spaces[at(c)];
        const auto near = surfaces_near(surfaces, side, c, space, scene);
        const int begin = c * side.station_lanes;
        for (int lane = begin; lane < std::min(begin + side.station_lanes, side.lanes()); ++lane) {
            for (int k = 0; k < strip_columns; ++k) {
                space.has_wall = space.has_wall || side.has_wall(lane, k);
                add_column(scene, side, lane, k, near, space);
            }
        }
        for (std::size_t k = 1; k < space.below.size(); ++k) {
            space.below[k] += space.below[k - 1];
        }
    }
    return spaces;
}

} // namespace hyoryu
