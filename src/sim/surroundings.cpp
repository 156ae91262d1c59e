// SPDX-License-Identifier: MIT
#include "surroundings.hpp"

#include "hyoryu/sim/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace hyoryu {

namespace {

std::string owner_name(const Simulation& sim, std::int32_t owner)
{
    if (owner == no_owner) {
        return "of the fluid";
    }
    if (owner >= 0) {
        return fmt::format("of body \"{}\"",
                           sim.rigid.bodies[static_cast<std::size_t>(owner)].name);
    }
    return fmt::format("of wall \"{}\"",
                       sim.scene.walls[static_cast<std::size_t>(-1 - owner)].name);
}

} // namespace

std::string solid_name(const Simulation& sim, int b)
{
    return b >= 0 ? fmt::format("body \"{}\"", sim.rigid.bodies[static_cast<std::size_t>(b)].name)
                  : fmt::format("wall \"{}\"",
                                sim.rigid.boundaries[static_cast<std::size_t>(-1 - b)].name);
}

std::string surroundings(const Simulation& sim, std::size_t row)
{
    const Particles& particles = sim.fluid->particles;
    const auto x = particles[field::position];
    const double dp = sim.fluid->parameters.spacing;
    std::map<std::int32_t, int> counts;
    double nearest = infinity;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double distance = (x[k] - x[row]).norm();
        if (k != row && distance <= 2 * dp) {
            counts[particles.owner()[k]] += 1;
            nearest = std::min(nearest, distance);
        }
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
    const auto bodies = static_cast<int>(sim.rigid.bodies.size());
    const auto walls = static_cast<int>(sim.rigid.boundaries.size());
    for (int a = 0; a < bodies; ++a) {
        for (int b = -walls; b < a; ++b) {
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
        mass = f.mass * static_cast<double>(sim.fluid->particles.fluid().size());
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
