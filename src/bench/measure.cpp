// SPDX-License-Identifier: MIT
// The measurements and their order.
#include "dam_break.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/machine_memory.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hyoryu::bench {

namespace {

// Includes its walls and the temporary memory of filling; 580 were measured.
constexpr double bytes_of_a_fluid_particle = 900;

std::vector<LoopRates> measure_cubes(const Setting& setting)
{
    std::vector<LoopRates> rates;
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        for (const double ratio : {1.5, 1.732}) {
            LoopSetting cube{.edge = setting.extent.edge,
                             .smoothing_ratio = ratio,
                             .seconds = setting.extent.seconds,
                             .precision = precision};
            setting.tell(fmt::format("pair loops, {} precision, h/dp {}", name(precision), ratio));
            rates.push_back(measure_loops(cube));
        }
    }
    return rates;
}

std::vector<StepRates> measure_reference(const Setting& setting)
{
    const Extent& extent = setting.extent;
    std::vector<StepRates> rates;
    setting.tell("steps of the dam break from rest");
    set_threads(setting.threads);
    Simulation sim = make_dam_break(extent.spacing);
    rates.push_back(measure_steps(sim, "start", extent, setting.threads));
    setting.tell(fmt::format("the dam break until {} s", extent.developed));
    set_threads(setting.threads);
    sim = make_dam_break(extent.spacing);
    develop(sim, extent.developed,
            setting.state.empty() ? setting.state
                                  : setting.state / fmt::format("spacing_{}", extent.spacing));
    setting.tell("steps of the developed flow");
    rates.push_back(measure_steps(sim, "developed", extent, setting.threads));
    return rates;
}

std::vector<StepRates> measure_sizes(const Setting& setting)
{
    Extent extent = setting.extent;
    extent.steps = 10;
    extent.tries = 2;
    std::vector<StepRates> rates;
    for (const double count : extent.sizes) {
        if (bytes_of_a_fluid_particle * count > machine_memory()) {
            setting.tell(
                fmt::format("no steps with {:.0f} fluid particles: too little memory", count));
            continue;
        }
        setting.tell(fmt::format("steps of the dam break with {:.0f} fluid particles", count));
        set_threads(setting.threads);
        Simulation sim = make_dam_break(std::cbrt(reference_volume / count));
        rates.push_back(measure_steps(sim, "start", extent, setting.threads));
    }
    return rates;
}

} // namespace

Extent quick()
{
    return {.name = "quick",
            .seconds = 0.02,
            .edge = 20,
            .spacing = 0.03,
            .developed = 0.1,
            .steps = 5,
            .tries = 1,
            .sizes = {1e3, 4e3}};
}

Extent standard()
{
    return {.name = "standard", .sizes = {1e4, 1e5, 1e6}};
}

Extent full()
{
    return {.name = "full", .sizes = {1e4, 3e4, 1e5, 2e5, 5e5, 1e6, 2e6, 4e6, 1e7}};
}

Results measure(const Setting& setting)
{
    Results results{
        .extent = setting.extent, .set = widest_instruction_set(), .threads = setting.threads};
    setting.tell("limits of the machine");
    results.limits = measure_limits(results.set, setting.threads, setting.extent.seconds);
    results.loops = measure_cubes(setting);
    results.steps = measure_reference(setting);
    results.sizes = measure_sizes(setting);
    return results;
}

} // namespace hyoryu::bench
