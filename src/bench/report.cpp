// SPDX-License-Identifier: MIT
#include "hyoryu/bench/bench.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <numeric>

namespace hyoryu::bench {

namespace {

using nlohmann::ordered_json;

/// The share of the rate of fused multiply-adds that the loop over all terms reaches.
double share_of_limit(const LoopRates& loop, const MachineLimits& limits)
{
    const bool single = loop.setting.precision == Precision::single_precision;
    return loop.flops * loop.all_terms / (single ? limits.fma_single : limits.fma_double);
}

double bytes_a_particle(const StepRates& rates)
{
    return static_cast<double>(total(rates.memory)) / static_cast<double>(rates.particles());
}

/// Serial share of a step by Amdahl's law, from the times with one thread and with all threads.
double serial_share(const StepRates& r)
{
    return r.threads > 1 ? (r.threads * r.all / r.one - 1) / (r.threads - 1) : 0;
}

ordered_json json_of(const MachineLimits& limits)
{
    return {{"fma_single", limits.fma_single},
            {"fma_double", limits.fma_double},
            {"fma_single_all_threads", limits.fma_single_all},
            {"triad_bytes_per_second", limits.triad},
            {"triad_bytes_per_second_all_threads", limits.triad_all}};
}

ordered_json json_of(const LoopRates& loop, const MachineLimits& limits)
{
    return {{"precision", name(loop.setting.precision)},
            {"smoothing_ratio", loop.setting.smoothing_ratio},
            {"particles", loop.setting.edge * loop.setting.edge * loop.setting.edge},
            {"neighbours", loop.neighbours},
            {"hit_share", loop.hit_share},
            {"all_terms_pairs_per_second", loop.all_terms},
            {"force_stage_pairs_per_second", loop.forces},
            {"rate_stage_pairs_per_second", loop.rates},
            {"pressure_stage_particles_per_second", loop.pressure},
            {"lists_pairs_per_second", loop.lists},
            {"lists_in_loops", loop.lists_in_loops},
            {"list_bytes_per_particle", loop.list_bytes},
            {"flops_per_pair", loop.flops},
            {"bytes_per_pair", loop.bytes},
            {"share_of_limit", share_of_limit(loop, limits)}};
}

ordered_json json_of(const StepRates& r)
{
    ordered_json stages = ordered_json::object();
    for (const StageTime& stage : r.stages) {
        stages[stage.name] = {{"one_thread_seconds", stage.one},
                              {"all_threads_seconds", stage.all}};
    }
    ordered_json memory = ordered_json::object();
    for (const MemoryUse& use : r.memory) {
        memory[use.part] = static_cast<double>(use.bytes) / static_cast<double>(r.particles());
    }
    const auto n = static_cast<double>(r.particles());
    return {{"scene", r.scene},
            {"time", r.time},
            {"spacing", r.spacing},
            {"fluid_particles", r.fluid},
            {"wall_particles", r.solid},
            {"steps", r.steps},
            {"threads", r.threads},
            {"one_thread_step_seconds", r.one},
            {"all_threads_step_seconds", r.all},
            {"particle_steps_per_second_one_thread", n / r.one},
            {"fluid_particle_steps_per_second_one_thread", static_cast<double>(r.fluid) / r.one},
            {"particle_steps_per_second_per_core", n / r.all / r.threads},
            {"fluid_particle_steps_per_second_per_core",
             static_cast<double>(r.fluid) / r.all / r.threads},
            {"pairs_per_second_one_thread", r.pairs / r.one},
            {"efficiency", r.efficiency()},
            {"serial_share", serial_share(r)},
            {"list_builds_per_step", r.builds},
            {"bytes_per_particle", bytes_a_particle(r)},
            {"bytes_per_particle_of", memory},
            {"stages", stages}};
}

std::string limits_table(const Results& results)
{
    const MachineLimits& l = results.limits;
    return fmt::format("limits of the machine                 1 thread   {} threads\n"
                       "  multiply-add, single   [Gflop/s]  {:>11.1f}{:>12.1f}\n"
                       "  multiply-add, double   [Gflop/s]  {:>11.1f}\n"
                       "  memory, triad          [GB/s]     {:>11.1f}{:>12.1f}\n",
                       results.threads, 1e-9 * l.fma_single, 1e-9 * l.fma_single_all,
                       1e-9 * l.fma_double, 1e-9 * l.triad, 1e-9 * l.triad_all);
}

std::string loops_table(const Results& results)
{
    std::string text = "\npair loops, one thread      all terms   forces    rates    lists   hits  "
                       "flop/pair  share of limit\n"
                       "                              [Mpair/s]                     \n";
    for (const LoopRates& r : results.loops) {
        text += fmt::format("  {:<7} h/dp {:<6g} {:>16.0f}{:>9.0f}{:>9.0f}{:>9.0f}{:>7.2f}{:>11.0f}"
                            "{:>15.0f} %\n",
                            name(r.setting.precision), r.setting.smoothing_ratio,
                            1e-6 * r.all_terms, 1e-6 * r.forces, 1e-6 * r.rates, 1e-6 * r.lists,
                            r.hit_share, r.flops, 100 * share_of_limit(r, results.limits));
    }
    return text;
}

std::string stages_table(const StepRates& r)
{
    std::string text =
        fmt::format("\nstages of a step, {}   share  1 thread [ms]  {} threads [ms]  speed-up\n",
                    r.scene, r.threads);
    const double all =
        std::accumulate(r.stages.begin(), r.stages.end(), 0.0,
                        [](double sum, const StageTime& stage) { return sum + stage.one; });
    for (const StageTime& stage : r.stages) {
        text += fmt::format("  {:<24}{:>8.1f} %{:>14.2f}{:>15.2f}{:>11.2f}\n", stage.name,
                            100 * stage.one / all, 1e3 * stage.one, 1e3 * stage.all,
                            stage.one / stage.all);
    }
    text += fmt::format("  serial, by the times of whole steps: {:.1f} %\n", 100 * serial_share(r));
    text += "  bytes per particle:";
    for (const MemoryUse& use : r.memory) {
        text += fmt::format(" {} {:.0f},", use.part,
                            static_cast<double>(use.bytes) / static_cast<double>(r.particles()));
    }
    return text + fmt::format(" together {:.0f}\n", bytes_a_particle(r));
}

std::string steps_table(const std::vector<StepRates>& rows)
{
    std::string text =
        "\ndam break   particles     fluid   builds   Mp-steps/s a core: 1 thread   all    fluid "
        "only   Mpair/s   efficiency   B/particle\n";
    for (const StepRates& r : rows) {
        const double n = 1e-6 * static_cast<double>(r.particles());
        text += fmt::format(
            "  {:<10}{:>9}{:>10}{:>9.3f}{:>29.3f}{:>8.3f}{:>10.3f}{:>12.0f}{:>12.2f}{:>13.0f}\n",
            r.scene, r.particles(), r.fluid, r.builds, n / r.one, n / r.all / r.threads,
            1e-6 * static_cast<double>(r.fluid) / r.one, 1e-6 * r.pairs / r.one, r.efficiency(),
            bytes_a_particle(r));
    }
    return text;
}

} // namespace

std::string to_json(const Results& results, const std::string& build)
{
    ordered_json json{{"build", build},
                      {"extent", results.extent.name},
                      {"instruction_set", name(results.set)},
                      {"threads", results.threads},
                      {"limits", json_of(results.limits)},
                      {"loops", ordered_json::array()},
                      {"steps", ordered_json::array()},
                      {"sizes", ordered_json::array()}};
    for (const LoopRates& rates : results.loops) {
        json["loops"].push_back(json_of(rates, results.limits));
    }
    for (const StepRates& rates : results.steps) {
        json["steps"].push_back(json_of(rates));
    }
    for (const StepRates& rates : results.sizes) {
        json["sizes"].push_back(json_of(rates));
    }
    return json.dump(2) + "\n";
}

std::string table(const Results& results)
{
    std::string text = limits_table(results) + loops_table(results) + steps_table(results.steps);
    for (const StepRates& rates : results.steps) {
        text += stages_table(rates);
    }
    return text + "\ncost against size" + steps_table(results.sizes);
}

} // namespace hyoryu::bench
