// SPDX-License-Identifier: MIT
#include "plan_contact.hpp"

#include "plan_warnings.hpp"

#include "hyoryu/scene/rigid_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hyoryu {

namespace {

void list_method(const ContactSettings& contact, Plan& plan)
{
    const bool penalty = plan.contact && contact.penalty;
    const bool impulse = plan.contact && !contact.penalty;
    const std::string none = "no bodies or walls that could touch";
    list_effect(plan, "contact_impulse", impulse, "`contact.method` is \"impulse\"",
                plan.contact ? "`contact.method` is \"penalty\"" : none);
    const PenaltyParameters parameters = contact.penalty.value_or(PenaltyParameters{});
    list_effect(
        plan, "contact_penalty", penalty,
        fmt::format("`contact.method` is \"penalty\": {} N/m and {} N s/m per pair of particles, "
                    "sub-steps of {} s",
                    parameters.stiffness, parameters.damping, parameters.step),
        plan.contact ? "`contact.method` is \"impulse\"" : none);
    struct Law {
        ImpactLaw law;
        const char* name;
        const char* meaning;
    };
    for (const Law& known :
         {Law{ImpactLaw::coupled, "coupled", "iterations over all approaching contacts"},
          Law{ImpactLaw::paper, "paper", "uncoupled equations (1)-(6), which can gain energy"},
          Law{ImpactLaw::simultaneous, "simultaneous", "all touching contacts at once"}}) {
        const std::string off = impulse   ? "`contact.law` selects another law"
                                : penalty ? "the penalty method has no impact law"
                                          : none;
        list_effect(plan, fmt::format("law_{}", known.name), impulse && contact.law == known.law,
                    fmt::format("`contact.law` is \"{}\": {}", known.name, known.meaning), off);
    }
}

Plan::MaterialContact resolved(const ContactSettings& contact, const std::string& a,
                               const std::string& b)
{
    for (const MaterialPair& pair : contact.pairs) {
        const auto& [m, n] = pair.materials;
        if ((m == a && n == b) || (m == b && n == a)) {
            return {{a, b}, pair.restitution, pair.friction, pair.stiffness, true};
        }
    }
    return {{a, b}, contact.restitution, contact.friction, std::nullopt, false};
}

void list_materials(const Scene& scene, Plan& plan)
{
    struct Number {
        int moving = 0;
        int fixed = 0;
    };
    std::map<std::string, Number> bodies;
    for (const BodySettings& body : scene.bodies) {
        Number& number = bodies[body.material];
        ++(body.fixed ? number.fixed : number.moving);
    }
    std::set<std::array<std::string, 2>> pairs;
    for (const auto& [a, na] : bodies) {
        for (const auto& [b, nb] : bodies) {
            const int others = nb.moving + nb.fixed - (a == b ? 1 : 0);
            if (na.moving > 0 && others > 0 && pairs.count({b, a}) == 0) {
                pairs.insert({a, b});
            }
        }
        for (const Wall& wall : scene.walls) {
            if (na.moving > 0 && pairs.count({wall.material, a}) == 0) {
                pairs.insert({a, wall.material});
            }
        }
    }
    for (const auto& [a, b] : pairs) {
        plan.materials.push_back(resolved(scene.contact, a, b));
    }
}

// A body whose particles are all pressed swings with sqrt(N k / M); explicit Euler follows that
// while the sub-step is a small part of a radian of it.
void warn_about_sub_steps(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    const PenaltyParameters& penalty = *scene.contact.penalty;
    double shortest = infinity;
    std::size_t lightest = 0;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        const double mass =
            effective_density(body, scene.dimensions) * volume(body.shape, scene.dimensions);
        const auto count = static_cast<double>(facts.body_points[b]);
        const double radian = std::sqrt(mass / (count * penalty.stiffness));
        if (!body.fixed && radian < shortest) {
            shortest = radian;
            lightest = b;
        }
    }
    constexpr double part = 0.2;
    if (penalty.step > part * shortest) {
        warn(scene, scene.bodies[lightest].place, "contact.penalty.step",
             fmt::format("sub-steps of {} s are too long for the springs of body "
                         "\"{}\": its restitution will depend on them",
                         penalty.step, scene.bodies[lightest].name),
             fmt::format("{:.2g} s or less is sufficient", part * shortest), plan);
    }
}

} // namespace

void list_contact(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    list_method(scene.contact, plan);
    if (!plan.contact) {
        return;
    }
    list_materials(scene, plan);
    if (scene.contact.penalty) {
        warn_about_sub_steps(scene, facts, plan);
    }
}

} // namespace hyoryu
