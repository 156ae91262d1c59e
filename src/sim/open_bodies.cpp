// SPDX-License-Identifier: MIT
#include "hyoryu/sim/open_bodies.hpp"

#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

// Whether the body has passed that window entirely.
bool has_passed(const Simulation& sim, const OpenSide& side, const Body& body, const Vec3& place)
{
    const double behind = -side.distance(place);
    const int lane = side.lane(place);
    if (behind <= 0 || lane < 0 || lane >= side.lanes()) {
        return false;
    }
    return behind - reach_along(body, side.normal()) > sim.fluid->kernel.support;
}

// Takes the particles of a body out of the stores. The rows behind them move up.
void remove_particles(Simulation& sim, std::size_t body)
{
    std::vector<Rows>& all = sim.body_particles.of;
    const Rows gone = all[body];
    std::vector<Vec3>& points = sim.body_particles.points;
    std::vector<std::int32_t> kept(points.size());
    std::iota(kept.begin(), kept.end(), 0);
    kept.erase(kept.begin() + gone.begin, kept.begin() + gone.end);
    sim.fluid->particles.body.gather(kept);
    points.erase(points.begin() + gone.begin, points.begin() + gone.end);
    for (std::size_t b = body; b < all.size(); ++b) {
        all[b].begin -= b == body ? 0 : gone.size();
        all[b].end -= gone.size();
    }
}

void remove(Simulation& sim, std::size_t b)
{
    Body& body = sim.rigid.bodies[b];
    body.left = true;
    body.velocity.setZero();
    body.angular_momentum.setZero();
    remove_particles(sim, b);
}

// Books the momentum and energy that a body carries out. Until now its weight was part of that of
// the scene.
void record(Simulation& sim, const Body& body)
{
    OpenBoundary& open = sim.open.boundary;
    const double mass = body.mass.mass;
    open.impulse -= mass * body.velocity;
    open.energy -= kinetic_energy(body) - mass * sim.scene.gravity.dot(body.position);
}

} // namespace

void let_bodies_leave(Simulation& sim)
{
    for (std::size_t k = 0; k < sim.scene.open.size(); ++k) {
        if (sim.scene.open[k].bodies != BodiesAtSide::leave) {
            continue;
        }
        for (std::size_t b = 0; b < sim.rigid.bodies.size(); ++b) {
            const Body& body = sim.rigid.bodies[b];
            const OpenSide& side = sim.open.boundary.carpets[k].side;
            if (body.left || is_fixed(body) ||
                !has_passed(sim, side, body, sim.poses[b].position)) {
                continue;
            }
            sim.open.left.push_back({static_cast<int>(b), static_cast<int>(k), sim.clock.time,
                                     body.position, body.velocity});
            record(sim, body);
            remove(sim, b);
        }
    }
}

void remove_left_bodies(Simulation& sim)
{
    for (const LeftBody& left : sim.open.left) {
        remove(sim, at(left.body));
    }
}

} // namespace hyoryu
