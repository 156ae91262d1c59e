// SPDX-License-Identifier: MIT
#include "relax_packing.hpp"

#include "fill_neighbours.hpp"
#include "free_sides.hpp"
#include "packing_grid.hpp"
#include "scene/surfaces/free_space.hpp"
#include "scene/surfaces/near_points.hpp"
#include "solid_cells.hpp"
#include "walls.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/ranks/reduction.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace hyoryu {

namespace {

// In spacings.
constexpr double rounding_of_places = 2e-6; // of places
constexpr double least = 0.46;              // distance of a particle from a surface
constexpr double strays = 0.15;     // distance that particles may move before they are sorted again
constexpr double longest = 0.1;     // largest displacement of a particle in a round
constexpr double farthest_move = 1; // largest total displacement of a particle
constexpr double beside = 2;        // particles farther from a surface never come too near
constexpr double looked = 1;        // distance to which surfaces are looked for

// With this momentum the missing water of a bed spreads by a layer in six rounds. In water too deep
// for `most_rounds`, the remainder evens out during the run.
constexpr int rounds_of_layer = 6;
constexpr int least_rounds = 100;
constexpr int most_rounds = 600;
constexpr double gain = 0.1; // of the descent; twice this value is unstable
// Heavy-ball descent (Polyak 1964): the share of the last step that the next round repeats. It is
// smaller for a particle whose force points against its last step, so that it does not swing about
// its place (after the restarts of O'Donoghue and Candes 2015, here for each particle alone).
constexpr double momentum = 0.95;
constexpr double momentum_against = 0.8;
constexpr Index block_slots = 256; // dealt out together

// A particle that may come too near to solids.
struct Beside {
    std::vector<int> solids;
    double least = 0; // distance that it keeps from them [m]
    // Distance that it may move before it can be too near to one [m]; not above 0: unknown.
    double room = 0;
};

// The fluid particles that take part: those of this process that move, then those that stay and
// those of other processes.
struct Packing {
    std::vector<std::int32_t> rows;          // of the fluid
    std::vector<Vec3> points;                // [m]
    std::vector<Eigen::Vector3f> way;        // last displacement of the moving particles [units]
    std::vector<std::uint8_t> sees_solids;   // of the moving particles
    std::vector<std::int32_t> beside_number; // in `beside`, of those that move; -1: none
    std::vector<Beside> beside;
    Index moving = 0;
    std::vector<std::int32_t> others; // that move, in the order in which they are fetched; -1: none
    PackingUnits units;
    PackingGrid grid, solids;
};

void add_fluid(const Filling& filling, std::span<const std::uint8_t> rows, Packing& packing)
{
    const auto all = packing.rows.size() + at(std::ranges::count(rows, 1));
    packing.rows.reserve(all);
    packing.points.reserve(all);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k] != 0) {
            packing.rows.push_back(static_cast<std::int32_t>(k));
            packing.points.push_back(filling.fluid[k]);
        }
    }
}

// Adds the solids that some moving particle may see.
void add_solids(const SolidCells& solids, double seen, double reach, Packing& packing)
{
    CellGrid grid;
    build(grid, std::span(packing.points).first(at(packing.moving)), 0, seen);
    std::vector<UnitPlace> places;
    std::vector<float> cubes;
    for (std::size_t k = 0; k < solids.points.size(); ++k) {
        bool near = false;
        for_cells_about(grid, solids.points[k], [&](std::size_t) { near = true; });
        if (near) {
            places.push_back(packing.units.whole(solids.points[k]));
            cubes.push_back(solids.cubes[k]);
        }
    }
    packing.solids = packing_grid(places, reach);
    packing.solids.cubes.assign(packing.solids.x.size(), 0); // with the zeros behind the last one
    for (std::size_t slot = 0; slot < places.size(); ++slot) {
        packing.solids.cubes[slot] = cubes[at(packing.solids.order[slot])];
    }
    packing.sees_solids.resize(at(packing.moving));
    parallel_for(0, packing.moving, [&](Index i) {
        const UnitPlace place = packing.units.whole(packing.points[at(i)]);
        const double sight = seen / packing.units.size;
        packing.sees_solids[at(i)] = any_within(packing.solids, place, sight) ? 1 : 0;
    });
}

// The distance that a particle keeps from surfaces [m]: less where it was filled into a corner
// without the room.
double least_of(const FreeSpace& space, double dp, std::span<const int> solids, const Vec3& filled)
{
    const auto distance = [&](const Vec3& p) {
        return space.nearest(p, solids, looked * dp).distance;
    };
    Vec3 p = filled;
    step_off(space, solids, (least + 1e-6) * dp, p, looked * dp);
    return distance(p) < least * dp
               ? std::min(least, distance(filled) / dp - rounding_of_places) * dp
               : least * dp;
}

void find_surfaces(const Scene& scene, const FreeSpace& space, Packing& packing)
{
    const double reach = beside * scene.spacing;
    std::vector<std::uint8_t> near(at(packing.moving), 0);
    parallel_for(0, packing.moving, [&](Index i) {
        const Vec3& p = packing.points[at(i)];
        near[at(i)] = space.nearest(p, space.about(p, reach)).distance < reach ? 1 : 0;
    });
    packing.beside_number.assign(at(packing.moving), -1);
    for (Index i = 0; i < packing.moving; ++i) {
        if (near[at(i)] != 0) {
            packing.beside_number[at(i)] = static_cast<std::int32_t>(packing.beside.size());
            const Vec3& p = packing.points[at(i)];
            const std::vector<int> solids = space.about(p, reach);
            packing.beside.push_back({solids, least_of(space, scene.spacing, solids, p)});
        }
    }
}

Vec3 middle_of_blocks(const Scene& scene)
{
    Bounds box;
    for (const FluidBlock& block : scene.fluid->blocks) {
        box.add(bounds(placed(block, scene.dimensions)));
    }
    return (box.min + box.max) / 2;
}

// Particles that were filled into one place, a corner of three surfaces, do not repel each other:
// they are put one above the other.
void part_coincident(const Filling& filling, const Vec3& down, double dp, Packing& packing)
{
    struct Here {
        UnitPlace place;
        std::int64_t number;
        Index k;
    };
    std::vector<Here> all;
    const auto add = [&](Index k) {
        all.push_back({packing.units.whole(packing.points[at(k)]),
                       filling.number_of_fluid(at(packing.rows[at(k)])), k});
    };
    for (Index i = 0; i < packing.moving; ++i) {
        add(i);
    }
    for (const std::int32_t other : packing.others) {
        if (other >= 0) {
            add(other);
        }
    }
    std::ranges::sort(all, {}, [](const Here& h) { return std::pair(h.place, h.number); });
    Index above = 0;
    for (std::size_t k = 1; k < all.size(); ++k) {
        above = all[k].place == all[k - 1].place ? above + 1 : 0;
        packing.points[at(all[k].k)] -= longest * static_cast<double>(above) * dp * down;
    }
}

// Indices in the packing of the moving particles of other processes; -1 if the packing does not see
// them. `moves` marks own particles, then all copies.
std::vector<std::int32_t> places_of_others(const Packing& packing, std::size_t own,
                                           std::span<const std::uint8_t> moves)
{
    std::vector<std::int32_t> place(moves.size(), -1);
    for (std::size_t k = 0; k < packing.rows.size(); ++k) {
        place[at(packing.rows[k])] = static_cast<std::int32_t>(k);
    }
    std::vector<std::int32_t> others;
    for (std::size_t row = own; row < moves.size(); ++row) {
        if (moves[row] != 0) {
            others.push_back(place[row]);
        }
    }
    return others;
}

// Distance to which particles look, those that move included [m].
double sight(double support, double dp)
{
    return support + (strays + 2 * farthest_move) * dp;
}

// The particles of this process that move, with all that they may see.
Packing packing_of(const Scene& scene, const Filling& filling, std::vector<float> wall_cubes,
                   double support, Comm* comm, FillNeighbours* neighbours)
{
    const double dp = scene.spacing;
    const std::size_t own = neighbours != nullptr ? neighbours->own() : filling.fluid.size();
    const SolidCells solids = solid_cells(scene, filling, std::move(wall_cubes), neighbours);
    std::vector<std::uint8_t> moves = free_to_move(scene, filling, own, solids.points, support);
    Packing packing;
    add_fluid(filling, moves, packing);
    packing.moving = static_cast<Index>(packing.points.size());
    packing.way.assign(packing.points.size(), Eigen::Vector3f::Zero());
    moves.resize(filling.fluid.size(), 0);
    const double seen = sight(support, dp);
    std::vector<std::uint8_t> stays = marks_near(filling.fluid, packing.points, seen);
    std::ranges::transform(stays, moves, stays.begin(), std::minus<>());
    add_fluid(filling, stays, packing);
    if (neighbours != nullptr) {
        moves.resize(own);
        moves = neighbours->joined(std::move(moves));
        neighbours->keep(std::span(moves).first(own));
        packing.others = places_of_others(packing, own, moves);
    }
    const Bounds box = bounds_of_all(comm, packing.points);
    packing.units = packing_units(middle_of_blocks(scene), dp, box.min, box.max);
    part_coincident(filling, scene.gravity.normalized(), dp, packing);
    add_solids(solids, seen, support / packing.units.size, packing);
    return packing;
}

// Depth of a particle below the surface where it is now [spacings].
float depth_of(const Filling& filling, const Packing& packing, const Vec3& down, double dp,
               std::size_t k)
{
    const auto row = at(packing.rows[k]);
    const double sunk = down.dot(packing.points[k] - filling.fluid[row]);
    return static_cast<float>((filling.fluid_depth[row] + sunk) / dp);
}

// The end of a way that leads into a corner of two surfaces: it goes along both.
Vec3 along_corner(const FreeSpace& space, double dp, const Beside& particle, const Vec3& from,
                  const Vec3& to)
{
    constexpr double parallel = 0.01; // sine of the angle between normals that span no corner
    const auto nearest = [&](const Vec3& p) {
        return space.nearest(p, particle.solids, looked * dp);
    };
    const NearestPlace first = nearest(to);
    const Vec3 off_first = to + (particle.least - first.distance) * first.normal;
    const Vec3 edge = first.normal.cross(nearest(off_first).normal);
    const Vec3 p = from + edge.dot(to - from) / std::max(edge.squaredNorm(), sq(parallel)) * edge;
    return nearest(p).distance < particle.least ? from : p;
}

// Keeps the path of a particle off the surfaces. A particle that was filled into a corner, nearer
// than the usual distance, comes no nearer. Surfaces are searched again only if the particle may
// have come too near since the last search: a displacement changes no distance by more than its
// length.
Vec3 off_surfaces(const FreeSpace& space, double dp, const PackingUnits& units, const Vec3& from,
                  const Vec3& to, Beside& particle)
{
    particle.room -= (to - from).norm() + units.size; // places are rounded
    if (particle.room > 0) {
        return to;
    }
    Vec3 p = to;
    const double distance = space.nearest(p, particle.solids, looked * dp).distance;
    particle.room = std::min(distance, looked * dp) - particle.least;
    if (particle.room < 0) {
        step_off(space, particle.solids, particle.least + 1e-6 * dp, p, looked * dp);
        const bool in_corner =
            space.nearest(p, particle.solids, looked * dp).distance < particle.least;
        p = in_corner ? along_corner(space, dp, particle, from, to) : p;
    }
    return p;
}

// The place of one particle after a round, which begins at `from` with a force [weights].
Vec3 next_place(Packing& packing, const FreeSpace& space, double dp, std::size_t k,
                const Vec3& force, double depth, const Vec3& start)
{
    const Vec3& from = packing.points[k];
    const double stiffness = (2 * std::max(depth, 0.0) + 1) / dp;
    const Vec3 last = packing.units.size * packing.way[k].cast<double>();
    Vec3 way =
        (last.dot(force) > 0 ? momentum : momentum_against) * last + gain / stiffness * force;
    const double length = way.norm();
    way *= length > longest * dp ? longest * dp / length : 1.0;
    Vec3 to = from + way;
    if (const std::int32_t number = packing.beside_number[k]; number >= 0) {
        to = off_surfaces(space, dp, packing.units, from, to, packing.beside[at(number)]);
    }
    to = packing.units.rounded(to);
    return (to - start).norm() > farthest_move * dp ? from : to;
}

// Gets the places of particles of other processes; the longest way of one [m].
double fetch_others(const FillNeighbours& neighbours, Packing& packing)
{
    const std::vector<Vec3> places =
        neighbours.fetch(std::span(packing.points).first(at(packing.moving)));
    double farthest_gone = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (const std::int32_t other = packing.others[k]; other >= 0) {
            farthest_gone = std::max(farthest_gone, (places[k] - packing.points[at(other)]).norm());
            packing.points[at(other)] = places[k];
        }
    }
    return farthest_gone;
}

// One round; the longest way of a particle [m].
double descend(const Filling& filling, const PackingPressure& pressure, const FreeSpace& space,
               double dp, const FillNeighbours* neighbours, Packing& packing)
{
    const auto all = static_cast<Index>(packing.points.size());
    const PackingUnits& units = packing.units;
    PackingGrid& grid = packing.grid;
    // All particles use the places in the grid, which date from before the round.
    const auto move = [&](Index slot) {
        const auto k = at(grid.order[at(slot)]);
        if (static_cast<Index>(k) >= packing.moving) {
            return;
        }
        const UnitPlace place{grid.x[at(slot)], grid.y[at(slot)], grid.z[at(slot)]};
        const float depth = grid.depth[at(slot)];
        const PackingGrid* solids = packing.sees_solids[k] != 0 ? &packing.solids : nullptr;
        const Vec3 force = pressure.down - pressure_sum(grid, solids, pressure, place, depth);
        const Vec3 to =
            next_place(packing, space, dp, k, force, depth, filling.fluid[at(packing.rows[k])]);
        packing.way[k] = ((to - packing.points[k]) / units.size).array().round().cast<float>();
        packing.points[k] = to;
    };
    parallel_blocks(0, (all + block_slots - 1) / block_slots, [&](Index block) {
        const Index end = std::min(all, (block + 1) * block_slots);
        for (Index slot = block * block_slots; slot < end; ++slot) {
            move(slot);
        }
    });
    const double gone = neighbours != nullptr ? fetch_others(*neighbours, packing) : 0;
    parallel_for(0, all, [&](Index slot) {
        const auto k = at(grid.order[at(slot)]);
        const UnitPlace place = units.whole(packing.points[k]);
        grid.x[at(slot)] = place[0];
        grid.y[at(slot)] = place[1];
        grid.z[at(slot)] = place[2];
        grid.depth[at(slot)] = depth_of(filling, packing, pressure.down, dp, k);
    });
    const double way = units.size * largest(0, packing.moving, 0.0, [&](Index k) {
                           return static_cast<double>(packing.way[at(k)].norm());
                       });
    return std::max(way, gone);
}

void sort(const Filling& filling, const Vec3& down, double dp, double reach, Packing& packing)
{
    std::vector<UnitPlace> places(packing.points.size());
    parallel_for(0, static_cast<Index>(places.size()),
                 [&](Index k) { places[at(k)] = packing.units.whole(packing.points[at(k)]); });
    packing.grid = packing_grid(places, reach);
    packing.grid.depth.assign(packing.grid.x.size(), 0);
    parallel_for(0, static_cast<Index>(places.size()), [&](Index slot) {
        packing.grid.depth[at(slot)] =
            depth_of(filling, packing, down, dp, at(packing.grid.order[at(slot)]));
    });
}

} // namespace

void relax_packing(const Scene& scene, const FillRegion* region, Filling& filling)
{
    Comm* const comm = region != nullptr ? &region->comm() : nullptr;
    const bool any = std::ranges::find(filling.fluid_cut, 1) != filling.fluid_cut.end();
    const bool in_layers = std::ranges::any_of(scene.fluid->blocks, &FluidBlock::layers);
    if (in_layers || !(scene.gravity.norm() > 0) || sum_of_all(comm, any ? 1 : 0) == 0) {
        return;
    }
    const double dp = scene.spacing;
    const double volume = particle_volume(scene, filling);
    const Kernel kernel =
        make_kernel(scene.fluid->smoothing_ratio, 1, scene.dimensions, scene.fluid->kernel);
    std::vector<float> cubes = wall_cubes(scene, filling);
    std::optional<FillNeighbours> neighbours;
    if (region != nullptr) {
        neighbours.emplace(*region, sight(kernel.support * dp, dp), cubes, filling);
    }
    FillNeighbours* const others = neighbours ? &*neighbours : nullptr;
    Packing packing =
        packing_of(scene, filling, std::move(cubes), kernel.support * dp, comm, others);
    if (sum_of_all(comm, packing.moving) == 0) {
        return;
    }
    const FreeSpace space(scene);
    find_surfaces(scene, space, packing);
    const double unit = packing.units.size / dp;
    double deepest = largest(0, packing.moving, 0.0,
                             [&](Index k) { return filling.fluid_depth[at(packing.rows[at(k)])]; });
    largest_of_all(comm, {&deepest, 1});
    const double layers = deepest / dp;
    const PackingPressure pressure{.kernel = kernel,
                                   .down = scene.gravity.normalized(),
                                   .unit = unit,
                                   .reach = (kernel.support + strays) / unit,
                                   .volume = volume / std::pow(dp, scene.dimensions),
                                   .deepest = layers + 1};
    const int rounds =
        static_cast<int>(std::clamp<double>(rounds_of_layer * layers, least_rounds, most_rounds));
    double gone = infinity; // since the last sorting, at most [m]
    for (int round = 0; round < rounds; ++round) {
        if (gone > (strays - longest) * dp) {
            sort(filling, pressure.down, dp, pressure.reach, packing);
            gone = 0;
        }
        gone += descend(filling, pressure, space, dp, others, packing);
    }
    for (Index k = 0; k < packing.moving; ++k) {
        const auto row = at(packing.rows[at(k)]);
        filling.fluid_depth[row] += pressure.down.dot(packing.points[at(k)] - filling.fluid[row]);
        filling.fluid[row] = packing.points[at(k)];
    }
}

} // namespace hyoryu
