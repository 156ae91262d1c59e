// SPDX-License-Identifier: MIT
#include "hyoryu/scene/plan.hpp"

#include "hyoryu/core/built_effects.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/memory.hpp"
#include "hyoryu/scene/moving_walls.hpp"
#include "hyoryu/scene/rigid_scene.hpp"
#include "plan_checks.hpp"
#include "plan_contact.hpp"
#include "plan_facts.hpp"
#include "plan_gauges.hpp"
#include "plan_open.hpp"
#include "plan_scale.hpp"
#include "plan_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <numbers>
#include <numeric>
#include <string_view>

namespace hyoryu {

namespace {

// Time step of bodies without a fluid. Impacts are located in time, so stability does not limit it.
constexpr double bodies_only_step = 1e-3; // [s]
// Sound speed over the largest expected speed: Mach 0.1 keeps density within 1 %.
constexpr double sound_over_speed = 10;
// Skin of the neighbour lists in spacings that flows come to, for the estimate of memory.
constexpr double usual_skin = 0.2;
constexpr const char* no_fluid = "the scene has no fluid";

std::string counted(std::integral auto number, std::string_view one, std::string_view many)
{
    return fmt::format("{} {}", number, number == 1 ? one : many);
}

// Lowest height that anything in the scene has, along -g.
double lowest(const Scene& scene, const PlanFacts& facts)
{
    double low = facts.height.lowest;
    const Vec3 up = -scene.gravity.normalized();
    for (const Wall& wall : scene.walls) {
        if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
            low = std::min(low, plane->normal.dot(up) > 0.5 ? up.dot(plane->point) : infinity);
        }
        if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
            low = std::min({low, up.dot(basin->min), up.dot(basin->max)});
        }
        if (const auto* round = std::get_if<RoundWall>(&wall.geometry)) {
            low = std::min(low, up.dot(round->centre) - round->radius);
        }
    }
    return low;
}

// max(2 sqrt(g H), |V|): H from the lowest point to the top of the fluid.
double expected_speed(const Scene& scene, const PlanFacts& facts)
{
    double speed = facts.fastest;
    const double g = scene.gravity.norm();
    if (g > 0 && facts.fluid > 0) {
        const double top = facts.height.highest + scene.spacing / 2;
        const double depth = std::max(top - lowest(scene, facts), scene.spacing);
        speed = std::max(speed, 2 * std::sqrt(g * depth));
    }
    for (const BodySettings& body : scene.bodies) {
        speed = std::max(speed, body.velocity.norm());
    }
    for (const Wall& wall : scene.walls) {
        speed = std::max(speed, speed_bound(wall.motion, 0, scene.time.end));
    }
    for (const Sponge& sponge : scene.sponges) {
        speed = std::max(speed, (sponge.parabolic ? 1.5 : 1.0) * sponge.velocity.norm());
    }
    for (std::size_t k = 0; k < scene.open.size(); ++k) {
        const OpenSettings& open = scene.open[k];
        const double low = lowest(scene, facts);
        speed = std::max(speed, fastest_asked(open, std::isfinite(low) ? low : open.min.z(),
                                              facts.level_before[k], g, scene.dimensions));
    }
    return speed;
}

FluidParameters fluid_parameters(const Scene& scene, double particle_volume, double speed)
{
    const FluidSettings& settings = *scene.fluid;
    FluidParameters f;
    f.dimensions = scene.dimensions;
    f.formulation = settings.formulation;
    f.spacing = scene.spacing;
    f.h = settings.smoothing_ratio * scene.spacing;
    f.kernel = settings.kernel;
    f.mass = settings.density * particle_volume;
    f.gravity = scene.gravity;
    f.drive = settings.acceleration;
    f.cfl = scene.time.cfl;
    f.precision = scene.precision;
    // A fluid at rest without gravity still needs a pressure: any speed of sound will do.
    const double floor = scene.spacing; // one spacing a second
    f.eos = {settings.density,
             settings.sound_speed.value_or(sound_over_speed * std::max(speed, floor))};
    return f;
}

// Effective viscosity of the scheme in a fluid at rest [m2/s].
double viscosity_of_scheme(const Plan& plan)
{
    return effective_viscosity(Fluid{.parameters = *plan.fluid, .effects = plan.effects});
}

// Each model of a slot; those of one name are one effect.
template <class... Models>
void list_slot(const std::variant<Models...>& choice, bool runs, const std::string& off, Plan& plan)
{
    Plan::Effect held;
    const auto tell = [&]<class Model>(const Model& model) {
        if constexpr (!std::same_as<Model, Off>) {
            held = {std::string(Model::name), model.why()};
        }
    };
    std::visit(tell, choice);
    std::string_view last = Off::name;
    for (const std::string_view name : {Models::name...}) {
        if (name != last && name != Off::name) {
            list_effect(plan, std::string(name), runs && name == held.name, held.why, off);
            last = name;
        }
    }
}

// Friction at solids, and the forces that drive the fluid.
void list_walls_and_drive(const Scene& scene, Plan& plan)
{
    const bool fluid = plan.fluid.has_value();
    const bool solids = fluid && (plan.counts.wall > 0 || plan.counts.bodies > 0);
    list_effect(plan, "no_slip", solids && !std::holds_alternative<Off>(plan.effects[slot::slip]),
                "`fluid.walls` is \"no_slip\": friction at walls and bodies",
                !fluid   ? no_fluid
                : solids ? "`fluid.walls` is \"free_slip\", or there is no viscosity"
                         : "the scene has no wall and no body");
    list_effect(plan, "drive", fluid && scene.fluid->acceleration.norm() > 0,
                "`fluid.acceleration` drives the fluid",
                fluid ? "`fluid.acceleration` is zero" : no_fluid);
}

void list_fluid_effects(const Scene& scene, Plan& plan)
{
    const bool fluid = plan.fluid.has_value();
    const bool solids = fluid && (plan.counts.wall > 0 || plan.counts.bodies > 0);
    const bool mps = fluid && plan.fluid->formulation == FormulationKind::mps;
    list_effect(plan, "pressure", fluid, "the scene has a fluid", no_fluid);
    list_effect(plan, "continuity", fluid, "the scene has a fluid", no_fluid);
    list_effect(plan, "corrected_gradient",
                fluid && !std::holds_alternative<Off>(plan.effects[slot::gradient]),
                fmt::format("`fluid.{}`: reverse kernel gradient correction",
                            mps ? "formulation` is \"mps\"" : "gradient` is \"corrected\""),
                fluid ? "`fluid.gradient` is \"plain\"" : no_fluid);
    list_effect(plan, "paired_walls",
                solids && !std::holds_alternative<Off>(plan.effects[slot::wall_continuity]),
                "`fluid.wall_continuity` is \"paired\": compression in front of walls and "
                "bodies",
                !fluid   ? no_fluid
                : solids ? "`fluid.wall_continuity` is \"plain\""
                         : "the scene has no wall and no body");
    list_effect(plan, "isotropic_kernel", fluid && plan.fluid->kernel == KernelShape::isotropic,
                "`fluid.kernel` is \"isotropic\": pressure stays isotropic among strained "
                "particles",
                fluid ? "`fluid.kernel` is \"wendland\"" : no_fluid);
    list_effect(plan, "wall_extrapolation", solids, "the scene has walls or bodies",
                fluid ? "the scene has no wall and no body" : no_fluid);
    list_effect(plan, "solid_backstop", solids, "the scene has walls or bodies",
                fluid ? "the scene has no wall and no body" : no_fluid);
    const bool surfaces = fluid && (plan.counts.walls > 0 || plan.counts.bodies > 0);
    list_effect(plan, "wall_barrier", surfaces,
                "the scene has walls or bodies: particles that would pass their "
                "exact surfaces are stopped, and their momentum acts on the solid",
                fluid ? "the scene has no wall and no body" : no_fluid);
    const FluidChoices choices = fluid ? scene.fluid->effects : FluidChoices{};
    for_each(ModelSlots<AllSlots>{}, [&](auto slot) {
        const bool runs = !std::holds_alternative<Off>(plan.effects[slot]);
        list_slot(choices[slot], runs, fluid ? std::string(slot.table.off) : no_fluid, plan);
        if (std::same_as<decltype(slot), ViscositySlot>) { // wall friction is listed with viscosity
            list_walls_and_drive(scene, plan);
        }
    });
    const bool periodic =
        scene.domain && std::ranges::any_of(scene.domain->periodic, std::identity{});
    list_effect(plan, "periodic", periodic, "`domain.periodic` lists directions",
                "`domain.periodic` lists no direction");
    const bool coupled = fluid && plan.counts.bodies > 0;
    list_effect(plan, "body_load", coupled, "bodies are in the fluid or may touch it",
                fluid ? "the scene has no bodies" : no_fluid);
    list_effect(plan, "film_pressure", coupled, "thin films of fluid between solids carry pressure",
                fluid ? "the scene has no bodies" : no_fluid);
    const auto sealed = std::ranges::count(scene.bodies, true, &BodySettings::sealed);
    list_effect(plan, "seepage", coupled,
                "water seeps under bodies where they stand" +
                    (sealed == 0 ? std::string()
                                 : fmt::format(", but under {} with `body.stands` "
                                               "\"sealed\"",
                                               sealed)),
                fluid ? "the scene has no bodies" : no_fluid);
}

void list_effects(const Scene& scene, Plan& plan)
{
    const bool gravity = scene.gravity.norm() > 0;
    list_effect(plan, "gravity", gravity, fmt::format("|g| = {} m/s2", scene.gravity.norm()),
                "`gravity` is zero");
    list_fluid_effects(scene, plan);
    list_effect(plan, "rigid_motion", plan.rigid, counted(plan.counts.bodies, "body", "bodies"),
                plan.counts.bodies > 0 ? "every body is fixed" : "the scene has no bodies");
    list_effect(plan, "contact", plan.contact,
                plan.counts.bodies > 1 ? "bodies may touch each other or a wall"
                                       : "the body may touch a wall",
                plan.counts.bodies == 0 ? "the scene has no bodies" : "a single body and no wall");
    const bool moving = has_moving_walls(scene);
    list_effect(plan, "moving_walls", moving, "a wall has `motion`", "all walls are fixed");
    const bool fluid = plan.fluid.has_value();
    list_effect(plan, "sponge", fluid && !scene.sponges.empty(),
                "damping of the fluid in " + counted(scene.sponges.size(), "sponge", "sponges"),
                fluid ? "the scene has no sponge" : no_fluid);
    const auto rough =
        std::ranges::count_if(scene.walls, [](const Wall& wall) { return wall.manning > 0; });
    list_effect(plan, "bed_friction", fluid && rough > 0,
                "`manning` of " + counted(rough, "wall", "walls"),
                fluid ? "no wall has `manning`" : no_fluid);
    const bool absorbs = std::ranges::any_of(
        scene.walls, [](const Wall& wall) { return wall.motion.absorption.has_value(); });
    list_effect(plan, "wave_absorption", fluid && absorbs,
                "a paddle absorbs waves: `wall.motion.absorb`",
                fluid ? "no wall has `motion.absorb`" : no_fluid);
    list_effect(plan, "open_boundary", !scene.open.empty(),
                counted(scene.open.size(), "open side", "open sides"),
                "no side is open: the scene has no [[open]]");
    list_effect(plan, "gauges", !scene.gauges.empty(),
                counted(scene.gauges.size(), "gauge", "gauges"), "the scene has no gauges");
}

void list_pairs(Plan& plan)
{
    if (!plan.fluid) {
        return;
    }
    plan.pair_kinds.push_back({"fluid<-fluid", "pressure, continuity, viscosity, diffusion"});
    if (plan.counts.wall + plan.counts.body > 0) {
        plan.pair_kinds.push_back({"fluid<-solid", "pressure and continuity at walls and bodies"});
        plan.pair_kinds.push_back(
            {"solid<-fluid", "pressure at solid particles, loads, wall reaction"});
    }
    if (plan.counts.body > 0) {
        plan.pair_kinds.push_back({"body<-solid", "pressure in thin films between solids"});
        plan.pair_kinds.push_back({"wall<-body", "reaction of the film pressure"});
    }
}

void list_fields(Plan& plan)
{
    if (!plan.fluid) {
        return;
    }
    // The columns follow from the effects by the same function that makes them; no row is needed.
    Fluid probe;
    probe.parameters = *plan.fluid;
    probe.effects = plan.effects;
    allocate(probe, 0, std::min<Index>(plan.counts.wall, 1), std::min<Index>(plan.counts.body, 1));
    for (const ColumnInfo& column : active_columns(probe.particles)) {
        const Index rows = (column.of_fluid ? plan.counts.fluid : 0) +
                           (column.of_solids ? plan.counts.wall + plan.counts.body : 0);
        plan.fields.push_back({std::string(column.field.name), std::string(column.field.unit),
                               column.bytes_per_particle, !column.of_solids, !column.of_fluid,
                               rows});
    }
}

void estimate_cost(const Scene& scene, Plan& plan)
{
    plan.frames = std::floor(scene.time.end / scene.output.every) + 1;
    constexpr double frame_row = 12 + 8 + 8 + 1 + 12 + 4 + 4 + 8 + 1 + 4;
    plan.frame_bytes = frame_row * static_cast<double>(plan.counts.fluid + plan.counts.body);
    plan.expected_steps = std::ceil(scene.time.end / plan.first_step);
    plan.memory = memory_bytes(scene, plan, {.steps = plan.expected_steps});
}

// The part of a plan that determines the run, without estimates, messages to the user and checks of
// the filled scene.
Plan plan_of(const Scene& scene, const PlanFacts& facts)
{
    Plan plan;
    plan.counts = {facts.fluid, facts.wall, 0, static_cast<Index>(scene.bodies.size()),
                   static_cast<Index>(scene.walls.size())};
    plan.counts.drawn =
        std::accumulate(facts.body_points.begin(), facts.body_points.end(), Index(0));
    plan.rigid = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                             [](const BodySettings& b) { return !b.fixed; });
    const bool stops = std::ranges::any_of(
        scene.open, [](const OpenSettings& open) { return open.bodies == BodiesAtSide::stop; });
    plan.contact = plan.rigid && (scene.bodies.size() > 1 || !scene.walls.empty() || stops);
    if (scene.fluid) {
        plan.counts.body = plan.counts.drawn;
        plan.expected_speed = expected_speed(scene, facts);
        plan.fluid = fluid_parameters(scene, facts.particle_volume, plan.expected_speed);
        plan.effects = chosen_effects(scene.fluid->effects, scene.fluid->gradient,
                                      scene.fluid->continuity, scene.fluid->walls, *plan.fluid);
        const auto limits =
            fluid_limits(*plan.fluid, 0, scene.gravity.norm(), viscosity_of_scheme(plan));
        plan.limits.assign(limits.begin(), limits.end());
        const bool plain = std::holds_alternative<Off>(plan.effects[slot::wall_continuity]);
        const real stiffness = plain ? 1 : PairedWalls::stiffness;
        for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
            const BodySettings& body = scene.bodies[b];
            const double mass =
                effective_density(body, scene.dimensions) * volume(body.shape, scene.dimensions);
            plan.limits.push_back(
                body_limit(*plan.fluid, mass, facts.surface_points[b], stiffness));
        }
    } else {
        plan.limits = {{"bodies only", bodies_only_step}};
    }
    plan.first_step = scene.time.step.value_or(shortest(plan.limits).dt);
    list_effects(scene, plan);
    expect_built(plan, left_out);
    list_pairs(plan);
    list_fields(plan);
    return plan;
}

} // namespace

bool Plan::runs(std::string_view effect) const
{
    return std::any_of(on.begin(), on.end(), [&](const Effect& e) { return e.name == effect; });
}

void expect_built(const Plan& plan, std::span<const std::string_view> without)
{
    for (const std::string_view name : without) {
        if (plan.runs(name)) {
            throw CaseError(fmt::format("{} is not part of this build", name),
                            "configure it without HYORYU_WITHOUT");
        }
    }
}

double list_bytes(const FluidParameters& fluid)
{
    const double radius = 2 * fluid.h / fluid.spacing + usual_skin;
    const double near = fluid.dimensions == 2 ? std::numbers::pi * sq(radius)
                                              : 4.0 / 3.0 * std::numbers::pi * radius * sq(radius);
    // One byte an entry, and ten per cent more for padding and list heads.
    constexpr double others = 10;
    return near + others;
}

Plan make_plan(const Scene& scene, const Filling& filling, Comm* comm)
{
    const PlanFacts facts = facts_of(scene, filling, comm);
    Plan plan = plan_of(scene, facts);
    plan.warnings = scene.notices;
    plan.warnings.insert(plan.warnings.end(), facts.warnings.begin(), facts.warnings.end());
    if (plan.fluid) {
        list_scale(scene, facts, viscosity_of_scheme(plan), plan);
    }
    list_contact(scene, facts, plan);
    list_gauges(scene, plan);
    list_open(scene, facts, plan);
    estimate_cost(scene, plan);
    check_plan(scene, facts, plan);
    list_floating(scene, plan);
    check_submerged(scene, facts, plan);
    check_waves(scene, facts, plan);
    show_places(scene, plan.warnings);
    return plan;
}

} // namespace hyoryu
