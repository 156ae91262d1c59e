// SPDX-License-Identifier: MIT
// The ground below a window, from the exact surfaces of the walls.
#include "open_side.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/open_settings.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

std::vector<SolidSurface> surfaces_of(const Scene& scene)
{
    std::vector<SolidSurface> surfaces;
    const double thickness = wall_layers(scene.fluid->smoothing_ratio) * scene.spacing;
    for (const Wall& wall : scene.walls) {
        surfaces.push_back(surface_of(wall, thickness, scene.dimensions));
    }
    return surfaces;
}

// Distance of a point from the nearest wall, negative inside of one.
double distance_to_walls(const std::vector<SolidSurface>& surfaces, const Vec3& point)
{
    double least = infinity;
    for (const SolidSurface& surface : surfaces) {
        const Vec3 local = surface.rotation.conjugate() * (point - surface.centre);
        least = std::min(least, nearest_place(surface, local).distance);
    }
    return least;
}

// The lowest height from which on a vertical is free of walls, between two heights: by steps of
// half a spacing from below, then by halving. Infinity if none is.
double ground_at(const std::vector<SolidSurface>& surfaces, Vec3 point, double low, double high,
                 double spacing)
{
    const double shallow = 1e-6 * spacing; // the surface itself is free
    const auto is_free = [&](double z) {
        point.z() = z;
        return distance_to_walls(surfaces, point) > -shallow;
    };
    double free = low;
    double solid = low;
    while (free <= high && !is_free(free)) {
        solid = free;
        free += spacing / 2;
    }
    if (free > high) {
        return infinity;
    }
    for (int k = 0; k < 40 && free > low; ++k) {
        const double middle = (free + solid) / 2;
        (is_free(middle) ? free : solid) = middle;
    }
    return free;
}

} // namespace

Vec3 point_of_window(const OpenSide& side, int lane, double distance, double spacing,
                     int dimensions)
{
    Vec3 x = Vec3::Zero();
    x[side.axis] = side.plane + side.into * distance;
    x[1 - side.axis] = dimensions == 2 ? 0 : side.first + (lane + 0.5) * spacing;
    return x;
}

OpenSide open_side(const Scene& scene, const OpenSettings& open)
{
    constexpr int strip_columns = 8;
    const double dp = scene.spacing;
    const auto across = static_cast<std::size_t>(1 - open.axis());
    OpenSide side;
    side.axis = open.axis();
    side.plane = open.plane();
    side.into = open.sign();
    side.low = open.min.z();
    side.repeats = scene.domain && scene.domain->periodic[across];
    const double width = open.width(scene.dimensions);
    const int lanes =
        scene.dimensions == 2 ? 1 : std::max(1, static_cast<int>(std::floor(width / dp + 1e-6)));
    side.first = scene.dimensions == 2 ? 0 : open.min[1 - open.axis()] + (width - lanes * dp) / 2;
    const std::vector<SolidSurface> surfaces = surfaces_of(scene);
    for (int lane = 0; lane < lanes; ++lane) {
        const auto ground = [&](double distance) {
            return ground_at(surfaces, point_of_window(side, lane, distance, dp, scene.dimensions),
                             open.min.z(), open.max.z(), dp);
        };
        double mean = 0;
        for (int k = 0; k < strip_columns; ++k) {
            const double s = k + 0.5;
            const double weight = (1 - std::abs(s - 4) / 4) / 4;
            mean += weight * ground(s * dp);
        }
        side.bed.push_back(mean < infinity ? ground(dp / 2) : infinity);
        side.strip.push_back(mean);
    }
    return side;
}

bool is_walled(const Scene& scene, const OpenSide& side)
{
    const std::vector<SolidSurface> surfaces = surfaces_of(scene);
    for (int lane = 0; lane < side.lanes(); ++lane) {
        const double bed = side.bed[static_cast<std::size_t>(lane)];
        Vec3 x = point_of_window(side, lane, -0.5 * scene.spacing, scene.spacing, scene.dimensions);
        x.z() = bed + scene.spacing;
        if (bed < infinity && distance_to_walls(surfaces, x) < -1e-6 * scene.spacing) {
            return true;
        }
    }
    return false;
}

bool stands_on_ground(const Scene& scene, const OpenSide& side)
{
    const std::vector<SolidSurface> surfaces = surfaces_of(scene);
    for (int lane = 0; lane < side.lanes(); ++lane) {
        const double bed = side.bed[static_cast<std::size_t>(lane)];
        Vec3 x = point_of_window(side, lane, 0.5 * scene.spacing, scene.spacing, scene.dimensions);
        x.z() = bed;
        if (bed < infinity && distance_to_walls(surfaces, x) > 0.5 * scene.spacing) {
            return false;
        }
    }
    return true;
}

void carry_walls_out(const Scene& scene, Filling& filling)
{
    if (scene.open.empty() || !scene.fluid) {
        return;
    }
    const double dp = scene.spacing;
    const int layers = wall_layers(scene.fluid->smoothing_ratio);
    for (const OpenSettings& open : scene.open) {
        const Index across = 1 - open.axis();
        const auto beside = [&](const Vec3& x) {
            return scene.dimensions == 2 || (x[across] > open.min[across] - (layers + 0.5) * dp &&
                                             x[across] < open.max[across] + (layers + 0.5) * dp);
        };
        const auto distance = [&](const Vec3& x) {
            return open.sign() * (x[open.axis()] - open.plane());
        };
        std::vector<Vec3> place;
        std::vector<std::int32_t> owner;
        std::vector<double> depth;
        const auto put = [&](std::size_t k, const Vec3& x) {
            place.push_back(x);
            owner.push_back(filling.wall_owner[k]);
            if (!filling.wall_depth.empty()) {
                depth.push_back(filling.wall_depth[k]);
            }
        };
        const auto stays = [&](std::size_t k) {
            const Vec3& x = filling.wall[k];
            const Wall& wall = scene.walls[static_cast<std::size_t>(filling.wall_owner[k])];
            return distance(x) >= 0 || !beside(x) || moves(wall.motion);
        };
        for (std::size_t k = 0; k < filling.wall.size(); ++k) {
            if (stays(k)) {
                put(k, filling.wall[k]);
            }
        }
        const int columns =
            static_cast<int>(std::ceil(2 * scene.fluid->smoothing_ratio)) + 3 + layers;
        for (std::size_t k = 0; k < filling.wall.size(); ++k) {
            const double s = distance(filling.wall[k]);
            const Wall& wall = scene.walls[static_cast<std::size_t>(filling.wall_owner[k])];
            if (!(s >= 0 && s < dp * (1 - 1e-6)) || !beside(filling.wall[k]) ||
                moves(wall.motion)) {
                continue;
            }
            for (int column = 1; column <= columns; ++column) {
                Vec3 x = filling.wall[k];
                x[open.axis()] -= open.sign() * column * dp;
                put(k, x);
            }
        }
        filling.wall = std::move(place);
        filling.wall_owner = std::move(owner);
        filling.wall_depth = std::move(depth);
    }
}

} // namespace hyoryu
