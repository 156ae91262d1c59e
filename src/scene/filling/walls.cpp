// SPDX-License-Identifier: MIT
#include "walls.hpp"

#include "layer_places.hpp"
#include "overlap_owner.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/covered_share.hpp"
#include "hyoryu/scene/wall_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

double depth_in(const PlaneWall& plane, const Vec3& p, int)
{
    return -plane.normal.dot(p - plane.point);
}
double depth_in(const BasinWall& basin, const Vec3& p, int dimensions)
{
    double depth = -infinity;
    for (int a = 0; a < 3; ++a) {
        if (dimensions == 2 && a == 1) {
            continue;
        }
        if (!basin.open[at(2 * a)]) {
            depth = std::max(depth, basin.min[a] - p[a]);
        }
        if (!basin.open[at(2 * a + 1)]) {
            depth = std::max(depth, p[a] - basin.max[a]);
        }
    }
    return depth;
}
double depth_in(const RoundWall& round, const Vec3& p, int)
{
    return (p - round.centre).norm() - round.radius;
}
double depth_in(const SolidWall& solid, const Vec3& p, int dimensions)
{
    return -signed_distance(placed(solid, dimensions), p);
}

std::vector<LayerPlaces> places_of_walls(const Scene& scene, const Filling& filling,
                                         std::span<const SolidSurface> surfaces)
{
    const LayerLattice lattice = layer_lattice(scene, filling.domain);
    std::vector<LayerPlaces> places;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        places.push_back(layer_places(scene.walls[w], surfaces[w], lattice));
    }
    return places;
}

// A place in the layers of a wall, by its number there.
struct WallPlace {
    std::int32_t wall = 0;
    Index number = 0;
    Vec3 place{0, 0, 0};
};

const WallRun& run_with(const std::vector<WallRun>& runs, Index index)
{
    return *(std::ranges::upper_bound(runs, index, {}, &WallRun::first) - 1);
}

} // namespace

bool in_period(const Scene& scene, const Vec3& point)
{
    for (Index axis = 0; axis < 3; ++axis) {
        const bool repeats = scene.domain && scene.domain->periodic[at(axis)];
        if (repeats &&
            !(point[axis] >= scene.domain->min[axis] && point[axis] < scene.domain->max[axis])) {
            return false;
        }
    }
    return true;
}

double depth_behind(const Wall& wall, const SolidSurface& surface, const Vec3& p, int dimensions)
{
    if (std::holds_alternative<TriangleTree>(surface.shape)) {
        return -nearest_from_centre(surface, p - surface.centre).distance;
    }
    return depth_behind(wall, p, dimensions);
}

WallCrowd::WallCrowd(const Scene& scene, const std::vector<Vec3>& points)
    : scene_(scene), first_(first_alike(scene.walls)),
      crowds_(scene.walls.size(), Crowd(scene.spacing, points))
{
}

bool WallCrowd::add(const Vec3& point, std::size_t wall)
{
    const auto* solid = std::get_if<SolidWall>(&scene_.walls[wall].geometry);
    const bool is_mesh = solid != nullptr && std::holds_alternative<MeshShape>(solid->shape);
    return crowds_[first_[wall]].add(point,
                                     is_mesh ? static_cast<std::int32_t>(wall) : Crowd::no_group);
}

void fill_walls(const Scene& scene, Filling& filling)
{
    const LayerLattice lattice = layer_lattice(scene, filling.domain);
    const auto surfaces = surfaces_of(scene.walls, lattice.depth(), scene.dimensions);
    const OverlapOwner owners(scene, surfaces, lattice.depth());
    WallCrowd crowd(scene, filling.wall);
    WallPlace expected{-1}; // the place that a run would go on with
    const auto add = [&](const WallPlace& place) {
        const auto& [w, number, p] = place;
        if (!crowd.add(p, at(w))) {
            return;
        }
        if (w != expected.wall || number != expected.number) {
            filling.wall_runs.push_back({static_cast<Index>(filling.wall.size()), number, w});
        }
        expected = {w, number + 1};
        filling.wall.push_back(p);
        filling.wall_owner.push_back(w);
        if (scene.fluid->walls.sticks) {
            filling.wall_depth.push_back(
                depth_behind(scene.walls[at(w)], surfaces[at(w)], p, scene.dimensions));
        }
    };
    std::vector<WallPlace> within; // other walls too
    for (std::int32_t w = 0; w < std::ssize(scene.walls); ++w) {
        for_each_place(layer_places(scene.walls[at(w)], surfaces[at(w)], lattice), nullptr,
                       [&](Index number, const Vec3& p) {
                           const Owner owner =
                               in_period(scene, p) ? owners.owner(at(w), p) : Owner::other;
                           if (owner == Owner::alone) {
                               add({w, number, p});
                           } else if (owner == Owner::best) {
                               within.push_back({w, number, p});
                           }
                       });
    }
    std::ranges::for_each(within, add);
}

WallMaker wall_maker(const Scene& scene, const Filling& filling,
                     std::span<const SolidSurface> surfaces, real cube_mass)
{
    std::vector<LayerPlaces> places = places_of_walls(scene, filling, surfaces);
    return [walls = std::span(scene.walls), surfaces, places = std::move(places),
            runs = filling.wall_runs, shifts = filling.wall_shifts,
            sticks = scene.fluid->walls.sticks, dimensions = scene.dimensions,
            cube_mass](std::int32_t index) -> WallPoint {
        const WallRun& run = run_with(runs, index);
        const auto w = at(run.wall);
        const auto place_in = [&](const auto& layers) {
            return layers.place(run.place + index - run.first);
        };
        const WallCell cell = std::visit(place_in, places[w]).value();
        const real depth = sticks ? depth_behind(walls[w], surfaces[w], cell.place, dimensions) : 0;
        return {cell.place + shifts[at(run.shift)], depth,
                static_cast<real>(cell.cubes) * cube_mass, -1 - run.wall};
    };
}

std::vector<float> wall_cubes(const Scene& scene, const Filling& filling)
{
    const LayerLattice lattice = layer_lattice(scene, filling.domain);
    const auto surfaces = surfaces_of(scene.walls, lattice.depth(), scene.dimensions);
    const std::vector<LayerPlaces> places = places_of_walls(scene, filling, surfaces);
    const Covers covers(scene, surfaces, 0);
    std::vector<float> cubes(filling.wall.size());
    parallel_for(0, static_cast<Index>(cubes.size()), [&](Index k) {
        const auto index = static_cast<Index>(filling.number_of_wall(at(k)));
        const WallRun& run = run_with(filling.wall_runs, index);
        const double share = covers.share(at(run.wall), filling.wall[at(k)], scene.spacing);
        cubes[at(k)] = static_cast<float>(
            share * cubes_at(places[at(run.wall)], run.place + index - run.first));
    });
    return cubes;
}

double box_thickness(const Wall& wall, int dimensions)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    const auto* box = solid != nullptr ? std::get_if<BoxShape>(&solid->shape) : nullptr;
    if (box == nullptr) {
        return infinity;
    }
    return dimensions == 2 ? std::min(box->size.x(), box->size.z()) : box->size.minCoeff();
}

double depth_behind(const Wall& wall, const Vec3& point, int dimensions)
{
    return std::visit([&](const auto& g) { return depth_in(g, point, dimensions); }, wall.geometry);
}

} // namespace hyoryu
