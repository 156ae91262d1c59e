// SPDX-License-Identifier: MIT
#include "fill_size.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/machine_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Row numbers are 32-bit in the neighbour lists.
constexpr double most_particles = 2e9;
// Bytes a particle while a scene is filled: place, velocity, depth and pressure, twice while they
// grow. A run needs several times as much.
constexpr double bytes_while_filling = 100;

double half_surface(const Vec3& size, int dimensions)
{
    return dimensions == 2 ? size.x() + size.z()
                           : size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

// The layers below the surface of a mesh, which are all that walls take of it.
double shell_volume(const MeshShape& mesh, const Scene& scene)
{
    const double layers = scene.fluid ? wall_layers(scene.fluid->smoothing_ratio) : 0;
    double area = 0;
    for (const auto& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) { return mesh.corners[at(t[k])]; };
        area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    }
    return area * layers * scene.spacing;
}

// The source of particles of a wall: an obstacle, or one layer of a surface.
double wall_volume(const Scene& scene, const Wall& wall)
{
    if (const auto* solid = std::get_if<SolidWall>(&wall.geometry)) {
        const auto* mesh = std::get_if<MeshShape>(&solid->shape);
        const double all = volume(solid->shape, scene.dimensions);
        return mesh == nullptr ? all : std::min(all, shell_volume(*mesh, scene));
    }
    const Bounds domain = domain_of(scene);
    double surface = half_surface(domain.max - domain.min, scene.dimensions);
    if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        surface = std::max(surface, half_surface(basin->max - basin->min, scene.dimensions));
    }
    return surface * scene.spacing;
}

} // namespace

double particles_asked(const Scene& scene)
{
    const auto count = [&](double volume_, double spacing) {
        return volume_ / std::pow(spacing, scene.dimensions);
    };
    double total = 0;
    for (const BodySettings& body : scene.bodies) {
        total += count(volume(body.shape, scene.dimensions), body.spacing);
    }
    if (scene.fluid) {
        for (const FluidBlock& block : scene.fluid->blocks) {
            // Still water fills a part of its box, whose cells were counted when it was found.
            total += block.seeded ? 0 : count(volume(block.shape, scene.dimensions), scene.spacing);
        }
        for (const Wall& wall : scene.walls) {
            total += count(wall_volume(scene, wall), scene.spacing);
        }
    }
    return total;
}

void check_size(const Scene& scene, double part)
{
    const double asked = particles_asked(scene);
    if (!(asked < most_particles)) {
        throw CaseError(
            fmt::format("this scene needs about {:.2g} particles; at most {:.0g} are supported",
                        asked, most_particles),
            "increase `particles.spacing`");
    }
    constexpr double giga = 1e9;
    const double memory = machine_memory();
    const double needed = part * asked * bytes_while_filling;
    if (needed > memory) {
        throw CaseError(
            fmt::format("this scene needs about {:.2g} particles: their positions alone take "
                        "{:.1f} GB, but only {:.1f} GB are available to this process",
                        asked, needed / giga, memory / giga),
            "increase `particles.spacing`");
    }
}

} // namespace hyoryu
