// SPDX-License-Identifier: MIT
#include "diagnostics.hpp"

#include "hyoryu/sim/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace hyoryu {

namespace {

// Stands for the fluid among the owners of particles.
constexpr std::int32_t fluid_owner = std::numeric_limits<std::int32_t>::min();

std::string owner_name(const Simulation& sim, std::int32_t owner)
{
    if (owner == fluid_owner) {
        return "of the fluid";
    }
    if (owner >= 0) {
        return fmt::format("of body \"{}\"", sim.rigid.bodies[at(owner)].name);
    }
    return fmt::format("of wall \"{}\"", sim.scene.walls[at(-1 - owner)].name);
}

} // namespace

std::string solid_name(const Simulation& sim, int b)
{
    if (b >= 0) {
        return fmt::format("body \"{}\"", sim.rigid.bodies[at(b)].name);
    }
    const Boundary& boundary = sim.rigid.boundaries[at(-1 - b)];
    return fmt::format("{} \"{}\"", boundary.bodies_only ? "open side" : "wall", boundary.name);
}

std::string nearby_particles(const Simulation& sim, std::size_t row)
{
    const Particles& particles = sim.fluid->particles;
    const Vec3& place = particles.fluid[field::position][row];
    const double dp = sim.fluid->parameters.spacing;
    std::map<std::int32_t, int> counts; // by owner
    double nearest = infinity;
    const auto look_at = [&](const Store& store, const auto& owner) {
        const auto x = store[field::position];
        for (Index k = 0; k < store.size(); ++k) {
            const double distance = (x[k] - place).norm();
            if (&x[k] != &place && distance <= 2 * dp) {
                counts[owner(k)] += 1;
                nearest = std::min(nearest, distance);
            }
        }
    };
    look_at(particles.fluid, [](Index) { return fluid_owner; });
    for_solids(particles, [&](const Store& store) {
        look_at(store, [&](Index k) { return store.owner()[k]; });
    });
    if (const Ghosts* const g = sim.fluid->ghosts.get()) { // all processes have all bodies
        look_at(g->particles.fluid, [](Index) { return fluid_owner; });
        look_at(g->particles.wall, [&](Index k) { return g->particles.wall.owner()[k]; });
    }
    if (counts.empty()) {
        return "no particle within 2 spacings of it";
    }
    std::string text = "within 2 spacings of it ";
    for (const auto& [owner, count] : counts) {
        text += fmt::format("{} {}, ", count, owner_name(sim, owner));
    }
    return text + fmt::format("the nearest at {:.3g} spacings", nearest / dp);
}

Overlap deepest_overlap(const Simulation& sim)
{
    Overlap deepest;
    const std::vector<Body>& all = sim.rigid.bodies;
    const auto bodies = static_cast<int>(all.size());
    const auto walls = static_cast<int>(sim.rigid.boundaries.size());
    std::vector<double> reach;
    for (const Body& body : all) {
        reach.push_back(bounding_radius(body, sim.scene.dimensions));
    }
    const auto may_meet = [&](std::size_t a, std::size_t b) {
        return !all[b].left && !(is_fixed(all[a]) && is_fixed(all[b])) &&
               (all[a].position - all[b].position).norm() < reach[a] + reach[b];
    };
    for (int a = 0; a < bodies; ++a) {
        const auto row = at(a);
        for (int b = all[row].left ? a : -walls; b < a; ++b) {
            if (b < 0 ? is_fixed(all[row]) : !may_meet(row, at(b))) {
                continue;
            }
            const double depth = overlap(sim.rigid, a, b, sim.clock.time);
            if (depth > deepest.depth) {
                deepest = {solid_name(sim, a) + " and " + solid_name(sim, b), depth};
            }
        }
    }
    return deepest;
}

double energy_scale(const Simulation& sim)
{
    const Vec3& g = sim.scene.gravity;
    double mass = 0;
    double of_sound = 0;
    double low = infinity;
    double high = -infinity;
    const auto reach = [&](const Vec3& x, double radius) {
        low = std::min(low, g.dot(x) - g.norm() * radius);
        high = std::max(high, g.dot(x) + g.norm() * radius);
    };
    if (sim.fluid) {
        const FluidParameters& f = sim.fluid->parameters;
        const Index count = count_over_ranks(*sim.fluid, sim.fluid->particles.fluid.size());
        mass = f.mass * static_cast<double>(count);
        of_sound = 0.5 * mass * sq(0.01 * f.eos.c0);
        reach(sim.fluid->domain_min, 0);
        reach(sim.fluid->domain_max, 0);
    }
    for (const Body& body : sim.rigid.bodies) {
        mass += body.mass.mass;
        reach(body.position, bounding_radius(body, sim.scene.dimensions));
    }
    return of_sound + (high > low ? mass * (high - low) : 0);
}

} // namespace hyoryu
