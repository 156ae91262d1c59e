// SPDX-License-Identifier: MIT
#include "barrier_hits.hpp"
#include "solid_places.hpp"

#include "hyoryu/scene/fill.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

// Distances from the surface in spacings: where it stops approaching particles, how near those
// farther away than `slowed` may come within a step, and up to where particles are examined.
constexpr double held = 0.25;
constexpr double slowed = held + 1.0 / 16;
constexpr double approached = 0.125;
constexpr double looked_at = 2;
// Displacement of particles and solids for which the lists of near solids hold [spacings].
constexpr double slack = 1;
constexpr double steps_to_surface = 20;
constexpr double fastest_way_out = 0.02; // of the speed of sound

// A bound of how far any point of any solid is from where it was.
double farthest_way(const WallBarrier& barrier)
{
    double way = 0;
    for (std::size_t k = 0; k < barrier.before.size(); ++k) {
        const SolidPlace& now = barrier.places[k];
        const Mat3 turn = now.rotation - barrier.before[k].rotation;
        const double turned = turn.isZero(0) ? 0 : turn.norm() * barrier.solids[k].reach;
        way = std::max(way, (now.position - barrier.before[k].position).norm() + turned);
    }
    return way;
}

// A place and a clearance, reduced by more than the rounding of single precision.
WallBarrier::Seen seen_at(const Vec3& r, double clearance, double spacing)
{
    constexpr double lost = 1e-4; // spacings; a tile is ten of them
    return {static_cast<float>(r.x()), static_cast<float>(r.y()), static_cast<float>(r.z()),
            static_cast<float>(clearance - lost * spacing)};
}

void add(WallBarrier::Near& near, int solid)
{
    if (near.count < static_cast<int>(near.solid.size())) {
        near.solid[at(near.count)] = solid;
    }
    near.count += 1;
}

// Records the solids that each tile may meet until the next lists are made, and a lower bound of
// the distance of its particles from them: that of its centre less their distance from the centre.
void find_near(const Fluid& fluid, WallBarrier& barrier)
{
    const Tiles& tiles = fluid.neighbours.fluid;
    const auto x = fluid.particles.fluid[field::position];
    barrier.builds = fluid.neighbours.builds;
    barrier.way = 0;
    barrier.near.resize(tiles.tile.size());
    barrier.clearance.resize(tiles.tile.size());
    barrier.seen.resize(at(fluid.particles.fluid.size()));
    const double far = looked_at * barrier.spacing;
    const double reach = tiles.lattice.edge.norm() / 2 + far + slack * barrier.spacing;
    const bool repeats = fluid.period != Vec3(0, 0, 0); // images: whatever there is
    parallel_blocks(0, tiles.tiles(), [&](Index tile) {
        WallBarrier::Near& near = barrier.near[at(tile)];
        near.count = 0;
        const Vec3 centre = tiles.lattice.centre(tiles.tile[at(tile)]);
        double nearest = repeats ? -infinity : reach;
        for (std::size_t k = 0; k < barrier.solids.size(); ++k) {
            const double distance =
                nearest_of(barrier, barrier.places[k], k, centre, reach).distance;
            nearest = std::min(nearest, distance);
            if (repeats || distance <= reach) {
                add(near, static_cast<int>(k));
            }
        }
        double farthest = 0;
        for (Index i = tiles.start[at(tile)]; i < tiles.start[at(tile + 1)]; ++i) {
            const Vec3 r = x[at(i)] - centre;
            barrier.seen[at(i)] = seen_at(r, std::min(far, nearest - r.norm()), barrier.spacing);
            farthest = std::max(farthest, r.norm());
        }
        // Displacements are known from the moment of the lists on.
        barrier.clearance[at(tile)] = fluid.neighbours.steps == 0 ? nearest - farthest : -1;
    });
}

// One step of the barrier, for one particle after another.
class BarrierStep {
public:
    BarrierStep(const Fluid& fluid, const WallBarrier& barrier, double dt)
        : fluid_(fluid), barrier_(barrier), dt_(dt), far_(looked_at * barrier.spacing)
    {
        for (std::size_t k = 0; k < barrier.solids.size(); ++k) {
            const SolidPlace& place = barrier.places[k];
            const double spin = place.spin.norm();
            const double turning = spin > 0 ? spin * barrier.solids[k].reach : 0;
            fastest_ = std::max(fastest_, place.velocity.norm() + turning);
        }
    }

    // Whether no surface can hold a particle of velocity v that has moved by `moved` since it was
    // `clearance` away from all: none holds one that ends the step farther away than `held`.
    bool is_free(double clearance, const Vec3& moved, const Vec3& v) const
    {
        const double left = clearance - held * barrier_.spacing - dt_ * fastest_;
        return left > 0 && 2 * (moved.squaredNorm() + sq(dt_) * v.squaredNorm()) < sq(left);
    }

    // The surfaces that may hold a particle; returns the distance of the nearest, at most the
    // search distance.
    double look(const Vec3& x, const Vec3& v, std::span<const int> solids,
                std::vector<SurfaceHold>& holds) const
    {
        holds.clear();
        double clearance = far_;
        const double limit = std::max(slowed * barrier_.spacing,
                                      approached * barrier_.spacing + dt_ * (v.norm() + fastest_));
        for_images(fluid_, x, far_, [&](const Vec3& image) {
            for (const int solid : solids) {
                const auto k = at(solid);
                const SolidPlace& place = barrier_.places[k];
                const NearestPlace nearest = nearest_of(barrier_, place, k, image, far_);
                clearance = std::min(clearance, nearest.distance);
                if (nearest.distance < limit) {
                    holds.push_back({solid, place.rotation * nearest.normal,
                                     place.velocity + place.spin.cross(image - place.position),
                                     least_speed(nearest.distance), Vec3(0, 0, 0)});
                }
            }
        });
        return clearance;
    }

private:
    double least_speed(double distance) const
    {
        if (distance < 0) {
            return std::min(-distance / (steps_to_surface * dt_),
                            fastest_way_out * fluid_.parameters.eos.c0);
        }
        const double full = (approached * barrier_.spacing - distance) / dt_;
        const double part = (distance / barrier_.spacing - held) / (slowed - held);
        return std::clamp(part, 0.0, 1.0) * full;
    }

    const Fluid& fluid_;
    const WallBarrier& barrier_;
    double dt_;
    double far_;         // [m]
    double fastest_ = 0; // of the points of solids [m/s]
};

// Changes a velocity, in a few rounds, until it satisfies every surface. Returns the change in the
// last round relative to that in the first.
double settle(double mass, Vec3& v, std::vector<SurfaceHold>& holds)
{
    constexpr int rounds = 4;
    double first = 0;
    double last = 0;
    for (int round = 0; round < rounds; ++round) {
        last = 0;
        for (SurfaceHold& h : holds) {
            const double lacking = h.least - (v - h.velocity).dot(h.normal);
            if (lacking > 0) {
                v += lacking * h.normal;
                h.impulse += mass * lacking * h.normal;
                h.first = h.sum > 0 ? h.first : lacking;
                h.sum += lacking;
                last = std::max(last, lacking);
            }
        }
        first = round == 0 ? last : first;
        if (last == 0) {
            return 0;
        }
    }
    return last / first;
}

// Between solids that touch or close in on a particle no velocity satisfies all surfaces: every
// round would change it by as much again. There the surfaces only stop the approach of the
// particle.
void hold(double mass, Vec3& v, std::vector<SurfaceHold>& holds)
{
    constexpr double hopeless = 0.5; // surfaces at 45 degrees leave less
    const Vec3 before = v;
    if (settle(mass, v, holds) <= hopeless) {
        return;
    }
    v = before;
    for (SurfaceHold& h : holds) {
        h.impulse.setZero();
        h.sum = 0;
        h.least = std::min(h.least, 0.0);
    }
    settle(mass, v, holds);
}

void hold_row(const BarrierStep& step, Fluid& fluid, WallBarrier& barrier, Index i,
              std::span<const int> solids, WallBarrier::Seen& seen, const Vec3& r)
{
    const Vec3& x = std::as_const(fluid.particles.fluid)[field::position][at(i)];
    Vec3& v = fluid.particles.fluid[field::velocity][at(i)];
    std::vector<SurfaceHold>& holds = barrier.holds[at(worker())];
    const double clearance = step.look(x, v, solids, holds);
    seen = seen_at(r, clearance + barrier.way, barrier.spacing);
    hold(fluid.parameters.mass, v, holds);
    for (const SurfaceHold& h : holds) {
        if (!h.impulse.isZero(0)) {
            const double wanted = h.least + h.velocity.dot(h.normal);
            barrier.hits[at(worker())].push_back(
                {i, h.solid, x, h.impulse, h.sum / h.first, wanted});
        }
    }
}

// Whether no surface can hold any particle of a tile.
bool is_far(const BarrierStep& step, const Fluid& fluid, const WallBarrier& barrier, Index tile)
{
    const FluidNeighbours& n = fluid.neighbours;
    const double clearance = barrier.clearance[at(tile)] - barrier.way;
    if (clearance < 0 || n.fluid_motion.box.size() != n.fluid.tile.size()) {
        return false;
    }
    const DisplacementBox& box = n.fluid_motion.box[at(tile)]; // since the lists were made
    const Vec3 moved = n.steps > 0 ? Vec3(box.high.cwiseMax(-box.low)) : Vec3(0, 0, 0);
    const auto v = fluid.particles.fluid[field::velocity];
    double fastest = 0;
    for (Index i = n.fluid.start[at(tile)]; i < n.fluid.start[at(tile + 1)]; ++i) {
        fastest = std::max(fastest, v[at(i)].squaredNorm());
    }
    return step.is_free(clearance, moved, Vec3(std::sqrt(fastest), 0, 0));
}

void hold_tile(const BarrierStep& step, Fluid& fluid, WallBarrier& barrier, Index tile)
{
    const Tiles& tiles = fluid.neighbours.fluid;
    const Vec3 centre = tiles.lattice.centre(tiles.tile[at(tile)]);
    const auto x = std::as_const(fluid.particles.fluid)[field::position];
    const auto v = std::as_const(fluid.particles.fluid)[field::velocity];
    if (is_far(step, fluid, barrier, tile)) {
        return;
    }
    for (Index i = tiles.start[at(tile)]; i < tiles.start[at(tile + 1)]; ++i) {
        WallBarrier::Seen& seen = barrier.seen[at(i)];
        const Vec3 r = x[at(i)] - centre;
        const Vec3 moved = r - Vec3(seen.x, seen.y, seen.z);
        if (step.is_free(seen.clearance - barrier.way, moved, v[at(i)])) {
            continue;
        }
        hold_row(step, fluid, barrier, i, solids_near(barrier, tiles.lattice, tile, r), seen, r);
    }
}

// Capacity for the hits of a step in usual flows.
void make_room(WallBarrier& barrier)
{
    constexpr std::size_t usual = 1024;
    const auto threads = at(thread_count());
    if (barrier.hits.size() < threads) {
        barrier.hits.resize(threads);
        barrier.holds.resize(threads);
        std::ranges::for_each(barrier.hits, [](auto& hits) { hits.reserve(usual); });
        std::ranges::for_each(barrier.holds, [](auto& holds) { holds.reserve(usual); });
    }
    std::ranges::for_each(barrier.hits, [](auto& hits) { hits.clear(); });
}

} // namespace

WallBarrier make_wall_barrier(const Scene& scene)
{
    WallBarrier barrier;
    barrier.spacing = scene.spacing;
    barrier.dimensions = scene.dimensions;
    barrier.walls = scene.walls.size();
    barrier.solids = surfaces_of(scene.walls, thickness_of_rows(scene), scene.dimensions);
    for (const BodySettings& body : scene.bodies) {
        barrier.solids.push_back(surface_of(body, scene.dimensions));
    }
    barrier.numbers.resize(barrier.solids.size());
    std::iota(barrier.numbers.begin(), barrier.numbers.end(), 0);
    return barrier;
}

std::span<const int> solids_near(const WallBarrier& barrier, const TileLattice& lattice, Index tile,
                                 const Vec3& r)
{
    // A particle far from the centre of its tile may be near other solids.
    const Vec3 roam = lattice.edge / 2 + Vec3::Constant(slack / 4 * barrier.spacing);
    const bool home = (r.cwiseAbs().array() <= roam.array()).all();
    const WallBarrier::Near& near = barrier.near[at(tile)];
    return home && at(near.count) <= near.solid.size() ? std::span(near.solid).first(at(near.count))
                                                       : std::span<const int>(barrier.numbers);
}

void hold_at_solids(Simulation& sim, double time, double dt)
{
    WallBarrier& barrier = *sim.barrier;
    Fluid& fluid = *sim.fluid;
    barrier.before.swap(barrier.places);
    place_solids(sim, sim.poses, time, barrier.places);
    barrier.way += farthest_way(barrier);
    if (barrier.builds != fluid.neighbours.builds || barrier.way > slack / 2 * barrier.spacing) {
        find_near(fluid, barrier);
    }
    make_room(barrier);
    barrier.dt = dt;
    const BarrierStep step(fluid, barrier, dt);
    parallel_blocks(0, fluid.neighbours.fluid.tiles(),
                    [&](Index tile) { hold_tile(step, fluid, barrier, tile); });
    book_hits(sim);
}

std::size_t hits_of_step(const WallBarrier& barrier)
{
    std::size_t count = 0;
    for (const std::vector<BarrierHit>& hits : barrier.hits) {
        count += hits.size();
    }
    return count;
}

} // namespace hyoryu
