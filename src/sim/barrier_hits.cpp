// SPDX-License-Identifier: MIT
// How bodies yield to the hits of the last barrier, and what their particles keep.
#include "barrier_hits.hpp"

#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <vector>

namespace hyoryu {

namespace {

// Inverse effective mass of a body at the place of a hit: its change of velocity there, along the
// impulse, per unit of impulse [1/kg].
double yield_of(const Body& body, const SolidPlace& place, const BarrierHit& hit)
{
    const Vec3 n = hit.impulse.normalized();
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
bool find_shares(const OwnerSums<7>& hits, std::vector<double>& shares)
{
    shares.resize(hits.owners());
    for (std::size_t body = 0; body < shares.size(); ++body) {
        const double yield = hits.of(body).back();
        shares[body] = yield > 1 ? 1 / yield : 1;
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

    // Returns to a particle what the bodies that hit it do not take. Solids on both sides of it
    // have answered each other: now they give less, none below zero, so that the particle leaves
    // none of them faster than it should; walls give more where it would pass them.
    void yield(std::span<const BarrierHit> hits)
    {
        const double mass = fluid_.parameters.mass;
        Vec3& v = fluid_.particles.fluid[field::velocity][at(hits.front().row)];
        const Vec3 held = v;
        answers_.clear();
        for (const BarrierHit& hit : hits) {
            const double share = is_wall(hit) ? 1 : shares_[body_of(hit)];
            if (share < 1) {
                v -= (1 - share) / mass * hit.impulse;
            }
            const double size = hit.impulse.norm();
            answers_.push_back({hit.impulse / size, share * size, share * size});
        }
        if (hits.size() > 1 && v != held) {
            answer_anew(hits, v);
        }
    }

    // Corrections of the forces on walls [N] and of the loads of bodies [N], [N m].
    OwnerSums<3> walls;
    OwnerSums<6> bodies;

private:
    // The impulse of a solid on the particle.
    struct Answer {
        Vec3 normal;
        double taken; // that the solid has taken [N s]
        double now;   // that it takes [N s]
    };

    bool is_wall(const BarrierHit& hit) const { return at(hit.solid) < barrier_.walls; }
    std::size_t body_of(const BarrierHit& hit) const { return at(hit.solid) - barrier_.walls; }

    void answer_anew(std::span<const BarrierHit> hits, Vec3& v)
    {
        const double mass = fluid_.parameters.mass;
        constexpr int rounds = 4;
        for (int round = 0; round < rounds; ++round) {
            for (std::size_t k = hits.size(); k-- > 0;) { // walls last
                Answer& a = answers_[k];
                const double lacking = mass * (hits[k].wanted - v.dot(a.normal));
                const double most = is_wall(hits[k]) ? infinity : a.taken;
                const double now = std::clamp(a.now + lacking, 0.0, most);
                v += (now - a.now) / mass * a.normal;
                a.now = now;
            }
        }
        for (std::size_t k = 0; k < hits.size(); ++k) {
            correct(hits[k], answers_[k]);
        }
    }

    void correct(const BarrierHit& hit, const Answer& answer)
    {
        const Vec3 f = (answer.taken - answer.now) / barrier_.dt * answer.normal;
        if (is_wall(hit)) {
            walls.add(at(hit.solid), {f.x(), f.y(), f.z()});
            return;
        }
        const Vec3 t = (hit.place - barrier_.places[at(hit.solid)].position).cross(f);
        bodies.add(body_of(hit), {f.x(), f.y(), f.z(), t.x(), t.y(), t.z()});
    }

    Fluid& fluid_;
    const WallBarrier& barrier_;
    std::span<const double> shares_;
    std::vector<Answer> answers_; // of one particle
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

// Adds the reactions of the hits to the sums of the loads, constant over the step. A particle
// between two closing surfaces hits each several times; the body yields to each of them.
void book_hits(Simulation& sim)
{
    const WallBarrier& barrier = *sim.barrier;
    const double mass = sim.fluid->parameters.mass;
    for (const std::vector<BarrierHit>& hits : barrier.hits) {
        for (const BarrierHit& hit : hits) {
            const auto solid = at(hit.solid);
            const Vec3 f = -hit.impulse / barrier.dt;
            if (solid < barrier.walls) {
                sim.loads.of_walls.add(solid, {f.x(), f.y(), f.z()});
                continue;
            }
            const std::size_t body = solid - barrier.walls;
            const SolidPlace& place = barrier.places[solid];
            const Vec3 t = (hit.place - place.position).cross(f);
            const double yield = hit.repeats * mass * yield_of(sim.rigid.bodies[body], place, hit);
            sim.loads.of_hits.add(body, {f.x(), f.y(), f.z(), t.x(), t.y(), t.z(), yield});
        }
    }
}

void share_hits(Simulation& sim)
{
    Loads& loads = sim.loads;
    std::vector<double>& shares = sim.barrier->shares;
    const bool some_yield = find_shares(loads.of_hits, shares);
    for (std::size_t body = 0; body < shares.size(); ++body) {
        const auto [fx, fy, fz, tx, ty, tz, yield] = loads.of_hits.of(body);
        loads.bodies[body].force += shares[body] * Vec3(fx, fy, fz);
        loads.bodies[body].torque += shares[body] * Vec3(tx, ty, tz);
    }
    if (!some_yield) {
        return;
    }
    YieldedHits yielded(sim, shares);
    for (const std::vector<BarrierHit>& hits : sim.barrier->hits) {
        for (auto first = hits.begin(); first != hits.end();) {
            const auto other = [&](const BarrierHit& hit) { return hit.row != first->row; };
            const auto last = std::find_if(first, hits.end(), other);
            yielded.yield({first, last});
            first = last;
        }
    }
    add_corrections(sim, yielded);
}

} // namespace hyoryu
