// SPDX-License-Identifier: MIT
// How bodies yield to the hits of the last barrier, and what their particles keep.
#include "barrier_hits.hpp"

#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <vector>

namespace hyoryu {

namespace {

// Calls f with the hits of each particle.
void for_each_particle(const WallBarrier& barrier, const auto& f)
{
    for (const std::vector<BarrierHit>& hits : barrier.hits) {
        for (auto first = hits.begin(); first != hits.end();) {
            const auto other = [&](const BarrierHit& hit) { return hit.row != first->row; };
            const auto last = std::find_if(first, hits.end(), other);
            f(std::span<const BarrierHit>(first, last));
            first = last;
        }
    }
}

// Inverse effective mass of a body at the place of a hit: its change of velocity there, along the
// impulse, per unit of impulse [1/kg].
double yield_of(const Body& body, const SolidPlace& place, const BarrierHit& hit)
{
    const Vec3& n = hit.hold.normal;
    double yield = 0;
    for (int axis = 0; axis < 3; ++axis) {
        yield += body.locks[at(axis)] ? 0 : sq(n[axis]) / body.mass.mass;
    }
    if (body.locks[3] && body.locks[4] && body.locks[5]) {
        return yield;
    }
    // With a locked axis the body turns by less; the overestimate only makes its share smaller.
    const Vec3 turn = place.rotation.transpose() * (hit.place - place.position).cross(n);
    return yield + turn.dot(body.mass.inertia.inverse() * turn);
}

// The share of its hits that each body takes; true if some body does not take all.
bool find_shares(const OwnerSums<8>& hits, std::vector<double>& shares)
{
    shares.assign(hits.owners(), 1);
    for (std::size_t b = 0; b < shares.size(); ++b) {
        const auto [fx, fy, fz, tx, ty, tz, spent, speed] = hits.of(b);
        shares[b] = sq(speed) > spent ? spent / sq(speed) : 1;
    }
    return std::ranges::any_of(shares, [](double share) { return share < 1; });
}

// The hits after bodies have yielded, particle by particle.
class YieldedHits {
public:
    YieldedHits(Simulation& sim, std::span<const double> shares)
        : fluid_(*sim.fluid), barrier_(*sim.barrier), shares_(shares)
    {
        const SumUnits units = sum_units(fluid_.parameters);
        const FixedUnit f = units.force;
        const FixedUnit t = units.torque;
        walls.begin(sim.scene.walls.size(), {f, f, f});
        bodies.begin(shares.size(), {f, f, f, t, t, t});
    }

    // Returns to a particle what the bodies that hit it do not take. Other solids have answered to
    // that: now they give less, none below zero, so that the particle leaves none of them faster
    // than it should; walls give more where it would pass them.
    void yield(std::span<const BarrierHit> hits)
    {
        Vec3& v = fluid_.particles.fluid[field::velocity][at(hits.front().row)];
        const Vec3 held = v;
        answers_.clear();
        for (const BarrierHit& hit : hits) {
            const bool wall = is_wall(hit);
            const double share = wall ? 1 : shares_[body_of(hit)];
            SurfaceHold& answer = answers_.emplace_back(hit.hold);
            if (share < 1) {
                v -= (1 - share) * answer.given * answer.normal;
            }
            answer.given *= share;
            answer.most = wall ? infinity : answer.given;
        }
        if (hits.size() > 1 && v != held) {
            settle(v, answers_);
            for (std::size_t k = 0; k < hits.size(); ++k) {
                correct(hits[k], answers_[k]);
            }
        }
    }

    // Corrections of the forces on walls [N] and of the loads of bodies [N], [N m].
    OwnerSums<3> walls;
    OwnerSums<6> bodies;

private:
    bool is_wall(const BarrierHit& hit) const { return at(hit.hold.solid) < barrier_.walls; }
    std::size_t body_of(const BarrierHit& hit) const { return at(hit.hold.solid) - barrier_.walls; }

    // Of a wall from what it has taken, of a body from its share of that.
    void correct(const BarrierHit& hit, const SurfaceHold& answer)
    {
        const double taken = is_wall(hit) ? hit.hold.given : answer.most;
        const Vec3 f =
            fluid_.parameters.mass * (taken - answer.given) / barrier_.dt * answer.normal;
        if (is_wall(hit)) {
            walls.add(at(answer.solid), {f.x(), f.y(), f.z()});
            return;
        }
        const Vec3 t = (hit.place - barrier_.places[at(answer.solid)].position).cross(f);
        bodies.add(body_of(hit), {f.x(), f.y(), f.z(), t.x(), t.y(), t.z()});
    }

    Fluid& fluid_;
    const WallBarrier& barrier_;
    std::span<const double> shares_;
    std::vector<SurfaceHold> answers_; // to one particle
};

void add_corrections(Simulation& sim, YieldedHits& yielded)
{
    Reduction all(comm_of(*sim.fluid));
    std::ranges::for_each(yielded.walls.end(), [&](auto& sums) { all.add(sums.each()); });
    std::ranges::for_each(yielded.bodies.end(), [&](auto& sums) { all.add(sums.each()); });
    all.run();
    for (std::size_t wall = 0; wall < yielded.walls.owners(); ++wall) {
        const auto [x, y, z] = yielded.walls.of(wall);
        sim.loads.walls[wall] += Vec3(x, y, z);
    }
    for (std::size_t body = 0; body < yielded.bodies.owners(); ++body) {
        const auto [fx, fy, fz, tx, ty, tz] = yielded.bodies.of(body);
        sim.loads.bodies[body].force += Vec3(fx, fy, fz);
        sim.loads.bodies[body].torque += Vec3(tx, ty, tz);
    }
}

} // namespace

double settle(Vec3& velocity, std::span<SurfaceHold> holds)
{
    constexpr int rounds = 4;
    constexpr double settled = 1e-12; // of the first change: rounding
    double first = 0;
    double last = 0;
    for (int round = 0; round < rounds; ++round) {
        last = 0;
        for (SurfaceHold& h : std::views::reverse(holds)) { // walls last
            const double lacking = h.wanted - velocity.dot(h.normal);
            // None where a velocity is not a number: its particle is the cause, no body.
            const double given = lacking > -h.given ? std::min(h.given + lacking, h.most) : 0;
            if (given != h.given) {
                velocity += (given - h.given) * h.normal;
                last = std::max(last, std::abs(given - h.given));
                h.largest = std::max(h.largest, given - h.given);
                h.given = given;
            }
        }
        first = round == 0 ? last : first;
        if (last <= settled * first) {
            return 0;
        }
    }
    return last / first;
}

// Adds the reactions of the hits to the sums of the loads, constant over the step. A particle
// between two closing surfaces hits each several times; the body yields to each of them. Bodies on
// both sides of it share what stops it.
void book_hits(Simulation& sim)
{
    const WallBarrier& barrier = *sim.barrier;
    const double mass = sim.fluid->parameters.mass;
    for_each_particle(barrier, [&](std::span<const BarrierHit> hits) {
        double by_bodies = 0;
        for (const BarrierHit& hit : hits) {
            by_bodies += at(hit.hold.solid) < barrier.walls ? 0 : hit.hold.given;
        }
        for (const BarrierHit& hit : hits) {
            const SurfaceHold& hold = hit.hold;
            const auto solid = at(hold.solid);
            const Vec3 f = -mass * hold.given / barrier.dt * hold.normal;
            if (solid < barrier.walls) {
                sim.loads.of_walls.add(solid, {f.x(), f.y(), f.z()});
            } else if (hold.given > 0) {
                const Vec3 t = (hit.place - barrier.places[solid].position).cross(f);
                const double spent = mass * hold.given * std::min(hold.given, hold.largest) *
                                     (hold.given / by_bodies);
                const std::size_t body = solid - barrier.walls;
                const double speed =
                    mass * hold.given *
                    std::sqrt(yield_of(sim.rigid.bodies[body], barrier.places[solid], hit));
                sim.loads.of_hits.add(body,
                                      {f.x(), f.y(), f.z(), t.x(), t.y(), t.z(), spent, speed});
            }
        }
    });
}

void share_hits(Simulation& sim)
{
    Loads& loads = sim.loads;
    std::vector<double>& shares = sim.barrier->shares;
    const bool some_yield = find_shares(loads.of_hits, shares);
    for (std::size_t body = 0; body < shares.size(); ++body) {
        const auto [fx, fy, fz, tx, ty, tz, spent, speed] = loads.of_hits.of(body);
        loads.bodies[body].force += shares[body] * Vec3(fx, fy, fz);
        loads.bodies[body].torque += shares[body] * Vec3(tx, ty, tz);
    }
    if (!some_yield) {
        return;
    }
    YieldedHits yielded(sim, shares);
    for_each_particle(*sim.barrier, [&](auto hits) { yielded.yield(hits); });
    add_corrections(sim, yielded);
}

} // namespace hyoryu
