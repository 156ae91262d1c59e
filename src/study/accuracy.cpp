// SPDX-License-Identifier: MIT
#include "hyoryu/study/accuracy.hpp"

#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace hyoryu {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<StudiedRung, 5> still_water{
    {{10, 0.008609}, {14, 0.004296}, {20, 0.002484}, {28, 0.001908}, {40, 0.001774}}};
constexpr std::array<StudiedRung, 3> bore{{{8, 0.07940}, {10, 0.03996}, {12.5, 0.01075}}};
constexpr std::array<StudiedRung, 5> timber{{{0.00125, 2.078e-7},
                                             {0.0025, 8.309e-7},
                                             {0.005, 3.319e-6},
                                             {0.01, 1.324e-5},
                                             {0.02, 5.272e-5}}};
constexpr double penalty_error = 0.58; // of the timber, at every step
constexpr double timber_length = 1;    // [m]

constexpr const char* not_studied = "not studied";

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
    return none;
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

ExpectedError pressure_at_rest(const Scene& scene, const Plan& plan, double depth)
{
    const double k = plan.fluid->eos.c0 / std::sqrt(scene.gravity.norm() * depth);
    ExpectedError expected{.quantity = "pressure at rest",
                           .error = none,
                           .why = fmt::format("c0 = {:.3g} sqrt(g H)", k),
                           .halving = not_studied,
                           .study = "hydrostatic_tank/study"};
    // Ten spacings are the fewest, MPS was studied with one sound speed.
    constexpr double fewest = 10;
    if (plan.fluid->formulation == FormulationKind::mps || depth < fewest * scene.spacing) {
        return expected;
    }
    expected.error = error_at(still_water, k);
    if (const auto halved = halved_at(still_water, k, still_water.back().number)) {
        expected.halving = fmt::format("fluid.sound_speed = {:.3g}: {:.2g} times the cost",
                                       plan.fluid->eos.c0 * *halved / k, *halved / k);
    } else if (std::isfinite(expected.error)) {
        expected.halving = "nothing that was studied: its floor is near";
    }
    return expected;
}

ExpectedError arrival_of_bore(const Scene& scene, double depth)
{
    const double n = depth / scene.spacing;
    ExpectedError expected{.quantity = "arrival of a bore",
                           .error = error_at(bore, n),
                           .why = fmt::format("{:.3g} spacings in the depth", n),
                           .halving = not_studied,
                           .study = "debris_flood/study"};
    if (const auto halved = halved_at(bore, n, bore.back().number)) {
        expected.halving =
            fmt::format("particles.spacing = {:.3g}: {:.2g} times the cost", depth / *halved,
                        std::pow(*halved / n, scene.dimensions + 1));
    }
    return expected;
}

double longest_edge(const BodySettings& body, int dimensions)
{
    const Bounds box = bounds({.shape = &body.shape, .dimensions = dimensions});
    return (box.max - box.min).maxCoeff();
}

ExpectedError motion_of(const Scene& scene, const Plan& plan, double length)
{
    ExpectedError expected{.quantity = "motion of bodies in contact",
                           .error = penalty_error,
                           .why = "springs of the penalty method",
                           .halving = "contact.method = \"impulse\"; no step, spacing or stiffness",
                           .study = "falling_timber/study"};
    if (scene.contact.penalty) {
        return expected;
    }
    // The scale of time of a body that tilts is sqrt(L/g).
    const double stretch = std::sqrt(timber_length / length);
    const double step = plan.first_step * stretch;
    const double finest = timber.front().number;
    expected.error = step < finest ? timber.front().error : error_at(timber, step);
    expected.why = fmt::format("steps of {:.3g} sqrt(L/g), L = {:.3g} m{}",
                               plan.first_step * std::sqrt(scene.gravity.norm() / length), length,
                               step < finest ? "; at most" : "");
    // On all rungs it is small beside any error of the water.
    expected.halving = std::isnan(expected.error) ? not_studied : "not needed";
    return expected;
}

} // namespace

std::span<const StudiedRung> still_water_rungs()
{
    return still_water;
}

std::span<const StudiedRung> bore_rungs()
{
    return bore;
}

std::span<const StudiedRung> timber_rungs()
{
    return timber;
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
            all.push_back(arrival_of_bore(scene, depth));
        }
    }
    double shortest = none;
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
        return "accuracy     no study says anything of this scene (docs/accuracy.md)\n";
    }
    std::string text =
        "accuracy     expected from the studies of other scenes (docs/accuracy.md)\n";
    for (const ExpectedError& e : errors) {
        text += fmt::format("  {}: {} ({})\n    to halve it: {}\n    from {}\n", e.quantity,
                            std::isfinite(e.error) ? fmt::format("{:.2g} %", 100 * e.error)
                                                   : not_studied,
                            e.why, e.halving, e.study);
    }
    return text;
}

} // namespace hyoryu
