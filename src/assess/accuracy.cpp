// SPDX-License-Identifier: MIT
#include "hyoryu/assess/accuracy.hpp"

#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace hyoryu {

namespace {

constexpr std::array<StudiedRung, 5> still_water{
    {{10, 0.008609}, {14, 0.004296}, {20, 0.002484}, {28, 0.001908}, {40, 0.001774}}};
constexpr std::array<StudiedRung, 3> bore{{{8, 0.09068}, {10, 0.04452}, {12.5, 0.01791}}};
constexpr std::array<StudiedRung, 5> timber{{{0.00125, 2.078e-7},
                                             {0.0025, 8.309e-7},
                                             {0.005, 3.319e-6},
                                             {0.01, 1.324e-5},
                                             {0.02, 5.272e-5}}};
constexpr double penalty_error = 0.58; // of the timber, at every step
constexpr double timber_length = 1;    // [m]

constexpr const char* not_studied = "not studied";

// The first eight are those of the still water.
constexpr std::array<std::string_view, 15> bore_effects{"gravity",
                                                        "pressure",
                                                        "continuity",
                                                        "wall_extrapolation",
                                                        "solid_backstop",
                                                        "wall_barrier",
                                                        "artificial_viscosity",
                                                        "density_diffusion",
                                                        "body_load",
                                                        "film_pressure",
                                                        "seepage",
                                                        "rigid_motion",
                                                        "contact",
                                                        "contact_impulse",
                                                        "law_coupled"};
constexpr std::array<std::string_view, 5> timber_effects{"gravity", "rigid_motion", "contact",
                                                         "contact_impulse", "law_coupled"};
constexpr std::array<std::string_view, 3> fluid_models{"gravity", "artificial_viscosity",
                                                       "density_diffusion"};
constexpr std::array<std::string_view, 2> timber_models{"gravity", "contact"};

// The finest runs but one of the debris flood, against the finest.
constexpr double impulse_in_water = 0.35;

bool has_fluid(const StudyCoverage& coverage)
{
    return std::ranges::find(coverage.effects, "pressure") != coverage.effects.end();
}

// Effects of the scene that the study lacks, and models of the study that the scene lacks.
void compare_effects(const StudyCoverage& coverage, const Plan& plan,
                     std::vector<std::string>& differences)
{
    std::vector<std::string> more, fewer;
    for (const Plan::Effect& effect : plan.on) {
        const bool known =
            std::ranges::find(coverage.effects, effect.name) != coverage.effects.end();
        // The penalty method has runs of its own beside those of the timber.
        const bool apart = effect.name == "gauges" || effect.name == "contact_penalty";
        if (!known && !apart) {
            more.push_back(effect.name);
        }
    }
    for (const std::string_view model : coverage.models) {
        if (!plan.runs(model)) {
            fewer.emplace_back(model);
        }
    }
    if (!more.empty()) {
        differences.push_back(fmt::format("studied without {}", fmt::join(more, ", ")));
    }
    if (!fewer.empty()) {
        differences.push_back(fmt::format("studied with {}", fmt::join(fewer, ", ")));
    }
}

// Between the rungs a power; NaN outside.
double error_at(std::span<const StudiedRung> rungs, double number)
{
    for (std::size_t k = 1; k < rungs.size(); ++k) {
        const StudiedRung& a = rungs[k - 1];
        const StudiedRung& b = rungs[k];
        if (a.number <= number && number <= b.number) {
            const double share = std::log(number / a.number) / std::log(b.number / a.number);
            return a.error * std::pow(b.error / a.error, share);
        }
    }
    return not_a_number;
}

// The nearest number on the way to `end` at which the error is half of that at `number`.
std::optional<double> halved_at(std::span<const StudiedRung> rungs, double number, double end)
{
    const double wanted = error_at(rungs, number) / 2;
    if (!(error_at(rungs, end) <= wanted)) {
        return std::nullopt;
    }
    double far = end;
    double near = number;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (near + far);
        (error_at(rungs, middle) <= wanted ? far : near) = middle;
    }
    return far;
}

// The entry of a quantity that no study covers for this scene: no error is given.
ExpectedError unless_covered(ExpectedError expected, std::vector<std::string> differences)
{
    if (!differences.empty()) {
        expected.error = not_a_number;
        expected.halving = not_studied;
        expected.not_covered = std::move(differences);
    }
    return expected;
}

ExpectedError pressure_at_rest(const Scene& scene, const Plan& plan, double depth)
{
    const double k = plan.fluid->eos.c0 / std::sqrt(scene.gravity.norm() * depth);
    ExpectedError expected{.quantity = "pressure at rest",
                           .error = error_at(still_water, k),
                           .why = fmt::format("c0 = {:.3g} sqrt(g H)", k),
                           .halving = not_studied,
                           .study = std::string(still_water_study.study)};
    if (const auto halved = halved_at(still_water, k, still_water.back().number)) {
        expected.halving = fmt::format("fluid.sound_speed = {:.3g}: {:.2g} times the cost",
                                       plan.fluid->eos.c0 * *halved / k, *halved / k);
    } else if (std::isfinite(expected.error)) {
        expected.halving = "no studied setting: the error is close to its floor";
    }
    return unless_covered(std::move(expected), not_covered(still_water_study, scene, plan, depth));
}

ExpectedError arrival_of_bore(const Scene& scene, const Plan& plan, double depth)
{
    const double n = depth / scene.spacing;
    ExpectedError expected{.quantity = "arrival of a bore",
                           .error = error_at(bore, n),
                           .why = fmt::format("{:.3g} spacings over the depth", n),
                           .halving = not_studied,
                           .study = std::string(bore_study.study)};
    if (const auto halved = halved_at(bore, n, bore.back().number)) {
        expected.halving =
            fmt::format("particles.spacing = {:.3g}: {:.2g} times the cost", depth / *halved,
                        std::pow(*halved / n, scene.dimensions + 1));
    }
    return unless_covered(std::move(expected), not_covered(bore_study, scene, plan, depth));
}

double longest_edge(const BodySettings& body, int dimensions)
{
    const Bounds box = bounds({.shape = &body.shape, .dimensions = dimensions});
    return (box.max - box.min).maxCoeff();
}

// No error is given for the motion of bodies in water: no study of it has converged.
ExpectedError motion_in_water()
{
    return {.quantity = "motion of bodies in contact, in water",
            .error = not_a_number,
            .why = fmt::format("the impulse on the house of the debris flood changes by {:.0f} % "
                               "between the two finest runs",
                               100 * impulse_in_water),
            .halving = not_studied,
            .study = std::string(bore_study.study),
            .not_covered = {"no study of it has converged"}};
}

ExpectedError motion_of(const Scene& scene, const Plan& plan, double length)
{
    if (plan.fluid) {
        return motion_in_water();
    }
    ExpectedError expected{.quantity = "motion of bodies in contact",
                           .error = penalty_error,
                           .why = "springs of the penalty method",
                           .halving = "contact.method = \"impulse\"; no time step, spacing or "
                                      "stiffness halves it",
                           .study = std::string(timber_study.study)};
    if (!scene.contact.penalty) {
        // The scale of time of a body that tilts is sqrt(L/g).
        const double step = plan.first_step * std::sqrt(timber_length / length);
        const double finest = timber.front().number;
        expected.error = step < finest ? timber.front().error : error_at(timber, step);
        expected.why = fmt::format("steps of {:.3g} sqrt(L/g), L = {:.3g} m{}",
                                   plan.first_step * std::sqrt(scene.gravity.norm() / length),
                                   length, step < finest ? "; an upper bound" : "");
        // On all rungs it is small beside any error of the water.
        expected.halving = std::isnan(expected.error) ? not_studied : "not needed";
    }
    return unless_covered(std::move(expected), not_covered(timber_study, scene, plan, 0));
}

} // namespace

const StudyCoverage still_water_study{.study = "hydrostatic_tank/study",
                                      .dimensions = 2,
                                      .fewest_spacings = 10,
                                      .most_spacings = 40,
                                      .effects = std::span(bore_effects).first(8),
                                      .models = fluid_models,
                                      .rungs = still_water};
const StudyCoverage bore_study{.study = "debris_flood/study",
                               .dimensions = 3,
                               .most_bodies = 9,
                               .fewest_spacings = 8,
                               .most_spacings = 12.5,
                               .effects = bore_effects,
                               .models = fluid_models,
                               .rungs = bore};
const StudyCoverage timber_study{.study = "falling_timber/study",
                                 .dimensions = 3,
                                 .most_bodies = 1,
                                 .effects = timber_effects,
                                 .models = timber_models,
                                 .rungs = timber};

std::vector<std::string> not_covered(const StudyCoverage& coverage, const Scene& scene,
                                     const Plan& plan, double depth)
{
    std::vector<std::string> differences;
    if (scene.dimensions != coverage.dimensions) {
        differences.push_back(fmt::format("studied in {} dimensions", coverage.dimensions));
    }
    if (plan.fluid && !has_fluid(coverage)) {
        differences.emplace_back("studied without water");
    } else {
        compare_effects(coverage, plan, differences);
    }
    if (plan.fluid && plan.fluid->formulation == FormulationKind::mps) {
        differences.emplace_back("studied with formulation sph");
    }
    const auto moving = std::ranges::count(scene.bodies, false, &BodySettings::fixed);
    if (moving > coverage.most_bodies) {
        differences.push_back(
            coverage.most_bodies == 0
                ? std::string("studied without bodies")
                : fmt::format("studied with {} at most",
                              coverage.most_bodies == 1
                                  ? std::string("one body")
                                  : fmt::format("{} bodies", coverage.most_bodies)));
    }
    const double spacings = depth / scene.spacing;
    // A depth is known to half a layer of a particle.
    constexpr double round_off = 1e-9;
    if (depth > 0 && (spacings < coverage.fewest_spacings * (1 - round_off) ||
                      spacings > coverage.most_spacings * (1 + round_off))) {
        differences.push_back(fmt::format("studied with {} to {} spacings over the depth",
                                          coverage.fewest_spacings, coverage.most_spacings));
    }
    return differences;
}

std::vector<ExpectedError> expected_errors(const Scene& scene, const Filling& filling,
                                           const Plan& plan)
{
    std::vector<ExpectedError> all;
    const bool has_gravity = scene.gravity.norm() > 0;
    if (plan.fluid && has_gravity && !filling.fluid_depth.empty()) {
        const double depth = *std::ranges::max_element(filling.fluid_depth) + 0.5 * scene.spacing;
        all.push_back(pressure_at_rest(scene, plan, depth));
        const auto is_front = [](const Gauge& gauge) { return gauge.type == GaugeType::front; };
        if (std::ranges::any_of(scene.gauges, is_front)) {
            all.push_back(arrival_of_bore(scene, plan, depth));
        }
    }
    double shortest = not_a_number;
    for (const BodySettings& body : scene.bodies) {
        if (!body.fixed) {
            shortest = std::fmin(shortest, longest_edge(body, scene.dimensions));
        }
    }
    if (plan.contact && has_gravity && std::isfinite(shortest)) {
        all.push_back(motion_of(scene, plan, shortest));
    }
    return all;
}

std::string expected_errors_text(const std::vector<ExpectedError>& errors)
{
    if (errors.empty()) {
        return "accuracy     no study applies to this scene (docs/accuracy.md)\n";
    }
    std::string text =
        "accuracy     expected from the studies of other scenes (docs/accuracy.md)\n";
    for (const ExpectedError& e : errors) {
        const std::string covers =
            e.not_covered.empty() ? "" : fmt::format(": {}", fmt::join(e.not_covered, ", "));
        text += fmt::format("  {}: {} ({})\n    to halve it: {}\n    from {}{}\n", e.quantity,
                            std::isfinite(e.error) ? fmt::format("{:.2g} %", 100 * e.error)
                                                   : not_studied,
                            e.why, e.halving, e.study, covers);
    }
    return text;
}

} // namespace hyoryu
