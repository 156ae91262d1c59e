// SPDX-License-Identifier: MIT
#include "fill_size.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/machine_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

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

struct Demand {
    std::string table; // of the case file
    double particles = 0;
};

// What each solid and block asks for.
std::vector<Demand> demands_of(const Scene& scene)
{
    std::vector<Demand> all;
    const auto add = [&](const std::string& table, std::string_view kind, std::size_t number,
                         double volume_, double spacing) {
        all.push_back({table.empty() ? fmt::format("{}[{}]", kind, number) : table,
                       volume_ / std::pow(spacing, scene.dimensions)});
    };
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        add(body.table, "body", b, volume(body.shape, scene.dimensions), body.spacing);
    }
    for (std::size_t b = 0; scene.fluid && b < scene.fluid->blocks.size(); ++b) {
        // Still water fills a part of its box, whose cells were counted when it was found.
        const FluidBlock& block = scene.fluid->blocks[b];
        add({}, "fluid.block", b, block.seeded ? 0 : volume(block.shape, scene.dimensions),
            scene.spacing);
    }
    for (std::size_t w = 0; scene.fluid && w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        add(wall.table, "wall", w, wall_volume(scene, wall), scene.spacing);
    }
    return all;
}

double whole_demand(const std::vector<Demand>& all)
{
    return std::accumulate(all.begin(), all.end(), 0.0,
                           [](double sum, const Demand& one) { return sum + one.particles; });
}

// "2e+12 particles, 1.9e+12 of them of `fluid.block[0]`".
std::string told_demand(const std::vector<Demand>& all)
{
    const Demand& most = *std::ranges::max_element(all, {}, &Demand::particles);
    return fmt::format("{:.2g} particles, {:.2g} of them of `{}`", whole_demand(all),
                       most.particles, most.table);
}

} // namespace

double particles_asked(const Scene& scene)
{
    return whole_demand(demands_of(scene));
}

void check_size(const Scene& scene, double part)
{
    const std::vector<Demand> all = demands_of(scene);
    const double asked = whole_demand(all);
    const char* const hint = "increase `particles.spacing`, or make that part of the scene smaller";
    if (!(asked < most_particles)) {
        throw CaseError(fmt::format("this scene needs about {}; at most {:.0g} are supported",
                                    told_demand(all), most_particles),
                        hint);
    }
    constexpr double giga = 1e9;
    const double memory = machine_memory();
    const double needed = part * asked * bytes_while_filling;
    if (needed > memory) {
        throw CaseError(
            fmt::format("this scene needs about {}: their positions alone take {:.1f} GB, but only "
                        "{:.1f} GB are available to this process",
                        told_demand(all), needed / giga, memory / giga),
            hint);
    }
}

} // namespace hyoryu
