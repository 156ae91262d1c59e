// SPDX-License-Identifier: MIT
#include "relax_packing.hpp"

#include "free_space.hpp"
#include "near_points.hpp"
#include "packing_lists.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <functional>

namespace hyoryu {

namespace {

// In spacings.
constexpr double least = 0.46;    // distance of a particle from a surface
constexpr double skin = 0.5;      // by which listed pairs may come nearer
constexpr double longest = 0.1;   // way of a particle in a round
constexpr double farthest = 1;    // that a particle is moved in all
constexpr double beside = 2;      // farther from a surface than that none comes too near
constexpr double looked = 1;      // distance to which surfaces are looked for
constexpr double emptiness = 1.2; // of a place whose nearest particle is as far away

// A want of water spreads by a layer in about ten rounds; what deeper water than this keeps of it,
// the run evens out.
constexpr int rounds_of_layer = 10;
constexpr int least_rounds = 100;
constexpr int most_rounds = 1000;
constexpr double gain = 0.1;     // of the descent, at twice of which it is unstable
constexpr double momentum = 0.9; // share of a way that the next round goes on with
// Places are rounded to so much, from the middle of the fluid on, after every round, which would
// otherwise make the rounding of numbers grow: that depends on where the scene lies and how it is
// turned.
constexpr double unit = 0x1p-20; // spacings

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

// The particles that take part: those that move, then fluid that stays, then solids.
struct Packing {
    std::vector<std::size_t> rows;        // of the fluid, for those that move and stay
    std::vector<Vec3> points;             // [m]
    std::vector<double> depth;            // of the fluid, below its surface [m]
    std::vector<Vec3> start;              // of those that move [m]
    std::vector<Vec3> way;                // that those that move went in the last round [m]
    std::vector<std::vector<int>> solids; // that each of them may come too near to
    // Way that each of them may go before it can be too near to a solid [m]; less: unknown.
    std::vector<double> room;
    Index moving = 0;
    PackingLists lists; // of those that move
};

std::vector<Vec3> solid_points(const Scene& scene, const Filling& filling)
{
    std::vector<Vec3> points = filling.wall;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        for (const Vec3& p : filling.bodies[b].points) {
            points.push_back(scene.bodies[b].position + scene.bodies[b].rotation * p);
        }
    }
    return points;
}

// Ways along which water may lie open: level ones and down.
std::vector<Vec3> open_ways(const Scene& scene)
{
    const Vec3 down = scene.gravity.normalized();
    const Vec3 u =
        scene.dimensions == 2 ? down.cross(Vec3::UnitY()).normalized() : down.unitOrthogonal();
    const Vec3 v = down.cross(u);
    if (scene.dimensions == 2) {
        return {down, u, -u};
    }
    const double h = std::sqrt(0.5);
    return {down, u, -u, v, -v, h * (u + v), h * (u - v), h * (v - u), -h * (u + v)};
}

// The nearest point to a place, and whether it is fluid.
class Surroundings {
public:
    Surroundings(std::span<const Vec3> points, std::size_t fluid, double reach)
        : points_(points), fluid_(fluid), reach_(reach)
    {
        build(grid_, points, 0, reach);
    }

    // Whether a way from a point leads to an empty place before it leads to a solid.
    bool is_open(const Vec3& from, const Vec3& way, double support) const
    {
        // On a lattice many distances are equal but for rounding: a solid goes before fluid.
        const double equal = 1e-6 * reach_;
        for (double s = reach_; s < support + reach_ / 2 - equal; s += reach_ / 2) {
            double fluid = reach_ - equal;
            double solid = reach_ - equal;
            const Vec3 place = from + s * way;
            for_cells_about(grid_, place, [&](std::size_t k) {
                double& nearest = k < fluid_ ? fluid : solid;
                nearest = std::min(nearest, (points_[k] - place).norm());
            });
            if (solid < reach_ - equal && solid <= fluid + equal) {
                return false;
            }
            if (!(fluid < reach_ - equal)) {
                return true;
            }
        }
        return false;
    }

private:
    std::span<const Vec3> points_;
    std::size_t fluid_;
    double reach_;
    CellGrid grid_;
};

// The marks without those of particles beside open sides.
std::vector<std::uint8_t> free_to_move(const Scene& scene, const Filling& filling,
                                       std::span<const Vec3> solids, double support)
{
    std::vector<Vec3> points = filling.fluid;
    points.insert(points.end(), solids.begin(), solids.end());
    const Surroundings about(points, filling.fluid.size(), emptiness * scene.spacing);
    const std::vector<Vec3> ways = open_ways(scene);
    std::vector<std::uint8_t> moves = filling.fluid_cut;
    parallel_for(0, static_cast<Index>(moves.size()), [&](Index k) {
        if (moves[at(k)] != 0 && std::ranges::any_of(ways, [&](const Vec3& way) {
                return about.is_open(points[at(k)], way, support);
            })) {
            moves[at(k)] = 0;
        }
    });
    return moves;
}

void add_fluid(const Filling& filling, std::span<const std::uint8_t> rows, Packing& packing)
{
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows[k] != 0) {
            packing.rows.push_back(k);
            packing.points.push_back(filling.fluid[k]);
            packing.depth.push_back(filling.fluid_depth[k]);
        }
    }
}

// Those that some particle that moves may see.
void add_solids(std::span<const Vec3> solids, double seen, Packing& packing)
{
    CellGrid grid;
    build(grid, std::span(packing.points).first(at(packing.moving)), 0, seen);
    for (const Vec3& p : solids) {
        bool near = false;
        for_cells_about(grid, p, [&](std::size_t) { near = true; });
        if (near) {
            packing.points.push_back(p);
        }
    }
}

Packing packing_of(const Scene& scene, const Filling& filling, double support)
{
    const double dp = scene.spacing;
    const std::vector<Vec3> solids = solid_points(scene, filling);
    const std::vector<std::uint8_t> moves = free_to_move(scene, filling, solids, support);
    Packing packing;
    add_fluid(filling, moves, packing);
    packing.moving = static_cast<Index>(packing.points.size());
    packing.start = packing.points;
    packing.way.assign(packing.points.size(), Vec3::Zero());
    if (packing.moving == 0) {
        return packing;
    }
    const double seen = support + (skin + 1) * dp;
    std::vector<std::uint8_t> stays = marks_about(filling.fluid, moves, seen);
    std::ranges::transform(stays, moves, stays.begin(), std::minus<>());
    add_fluid(filling, stays, packing);
    add_solids(solids, seen, packing);
    return packing;
}

void find_surfaces(const Scene& scene, const FreeSpace& space, Packing& packing)
{
    const double reach = beside * scene.spacing;
    packing.solids.resize(at(packing.moving));
    packing.room.assign(at(packing.moving), 0);
    parallel_for(0, packing.moving, [&](Index i) {
        const std::vector<int> near = space.about(packing.points[at(i)], reach);
        if (space.nearest(packing.points[at(i)], near).distance < reach) {
            packing.solids[at(i)] = near;
        }
    });
}

Vec3 middle_of_blocks(const Scene& scene)
{
    Bounds box;
    for (const FluidBlock& block : scene.fluid->blocks) {
        box.add(bounds({&block.shape, block.centre, block.rotation, scene.dimensions}));
    }
    return (box.min + box.max) / 2;
}

Vec3 rounded(const Vec3& place, const Vec3& origin, double dp)
{
    const Vec3 units = (place - origin) / (unit * dp);
    return origin + unit * dp * units.array().round().matrix();
}

// Keeps the way of a particle off the surfaces: its end, or where it began if that is a corner.
// Surfaces are looked at again only where it may have come too near since the last look, as no way
// changes a distance by more than its length.
Vec3 off_surfaces(const FreeSpace& space, double dp, std::span<const int> solids, const Vec3& from,
                  const Vec3& to, double& room)
{
    if (solids.empty()) {
        return to;
    }
    room -= (to - from).norm() + unit * dp; // places are rounded
    if (room > 0) {
        return to;
    }
    Vec3 p = to;
    const double distance = space.nearest(p, solids, looked * dp).distance;
    room = std::min(distance, looked * dp) - least * dp;
    if (room < 0) {
        step_off(space, solids, (least + 1e-6) * dp, p, looked * dp);
        const bool in_corner = space.nearest(p, solids, looked * dp).distance < least * dp;
        p = in_corner ? from : p;
    }
    return p;
}

int rounds_for(const Packing& packing, double dp)
{
    double deepest = 0;
    for (Index k = 0; k < packing.moving; ++k) {
        deepest = std::max(deepest, packing.depth[at(k)]);
    }
    return static_cast<int>(
        std::clamp<double>(rounds_of_layer * deepest / dp, least_rounds, most_rounds));
}

// Where one round takes the particles that move, with the fluid in cells of this volume.
void descend(Packing& packing, const FreeSpace& space, const PackingPressure& pressure, double dp,
             double volume, const Vec3& origin, std::vector<Vec3>& moved)
{
    parallel_for(0, packing.moving, [&](Index i) {
        const Vec3& from = packing.points[at(i)];
        const Vec3 force =
            pressure.down - volume * pressure_sum(packing.lists, packing.points, pressure, at(i));
        const double stiffness = (2 * std::max(packing.depth[at(i)], 0.0) + dp) / sq(dp);
        Vec3 way = momentum * packing.way[at(i)] + gain / stiffness * force;
        const double length = way.norm();
        way *= length > longest * dp ? longest * dp / length : 1.0;
        const Vec3 free =
            off_surfaces(space, dp, packing.solids[at(i)], from, from + way, packing.room[at(i)]);
        const Vec3 p = rounded(free, origin, dp);
        const bool strays = (p - packing.start[at(i)]).norm() > farthest * dp;
        moved[at(i)] = strays ? from : p;
    });
}

} // namespace

void relax_packing(const Scene& scene, Filling& filling)
{
    const bool any = std::ranges::find(filling.fluid_cut, 1) != filling.fluid_cut.end();
    const bool in_layers = std::ranges::any_of(scene.fluid->blocks, &FluidBlock::layers);
    if (!any || in_layers || !(scene.gravity.norm() > 0)) {
        return;
    }
    const double dp = scene.spacing;
    const Kernel kernel = make_kernel(scene.fluid->smoothing_ratio * dp, dp, scene.dimensions);
    Packing packing = packing_of(scene, filling, kernel.support);
    const FreeSpace space(scene);
    find_surfaces(scene, space, packing);
    const Vec3 down = scene.gravity.normalized();
    const Vec3 middle = middle_of_blocks(scene);
    const double volume = particle_volume(scene, filling);
    const PackingPressure pressure{packing.depth, kernel, down,
                                   std::pow(dp, scene.dimensions) / volume};
    std::vector<Vec3> moved(at(packing.moving));
    std::vector<Vec3> listed;
    const int rounds = rounds_for(packing, dp);
    for (int round = 0; round < rounds; ++round) {
        double since = listed.empty() ? infinity : 0; // since the lists were made
        for (std::size_t k = 0; k < listed.size(); ++k) {
            since = std::max(since, (packing.points[k] - listed[k]).norm());
        }
        if (since > (skin / 2 - longest) * dp) {
            make_lists(packing.points, packing.moving, kernel.support + skin * dp, packing.lists);
            listed.assign(packing.points.begin(), packing.points.begin() + packing.moving);
        }
        descend(packing, space, pressure, dp, volume, middle, moved);
        for (std::size_t k = 0; k < moved.size(); ++k) {
            packing.way[k] = moved[k] - packing.points[k];
            packing.depth[k] += down.dot(packing.way[k]);
            packing.points[k] = moved[k];
        }
    }
    for (std::size_t k = 0; k < moved.size(); ++k) {
        filling.fluid[packing.rows[k]] = packing.points[k];
        filling.fluid_depth[packing.rows[k]] = packing.depth[k];
    }
}

} // namespace hyoryu
