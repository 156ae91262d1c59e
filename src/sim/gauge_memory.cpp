// SPDX-License-Identifier: MIT
// State of gauges between rows: impulses and the windows of filters.
#include "hyoryu/core/error.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "hyoryu/sim/simulation.hpp"
#include "state.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

int target_of(const Scene& scene, const std::string& name)
{
    const auto named = [&](const auto& solid) { return solid.name == name; };
    const auto body = std::find_if(scene.bodies.begin(), scene.bodies.end(), named);
    if (body != scene.bodies.end()) {
        return static_cast<int>(body - scene.bodies.begin());
    }
    const auto wall = std::find_if(scene.walls.begin(), scene.walls.end(), named);
    return -1 - static_cast<int>(wall - scene.walls.begin());
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.size() % 2 == 1 ? *middle
                                  : (*middle + *std::max_element(values.begin(), middle)) / 2;
}

void forget_before(FilterMemory& memory, double time)
{
    const auto kept = std::upper_bound(memory.times.begin(), memory.times.end(), time);
    const auto count = kept - memory.times.begin();
    memory.times.erase(memory.times.begin(), kept);
    memory.values.erase(memory.values.begin(), memory.values.begin() + count);
}

// A row and the one before it: the reading stands for the time between them.
struct RowTimes {
    double before = 0, now = 0; // [s]
};

// Mean of all readings so far with the weights exp(-age/window) over the time that each stands for:
// the sum of x_k (exp(-(t - t_k)/w) - exp(-(t - t_k-1)/w)), divided by that of the weights. In a
// checkpoint of an earlier version the weight is missing; it counted as 1.
double exponential(FilterMemory& memory, const RowTimes& row, double value)
{
    double mean = value;
    double weight = -std::expm1(-(row.now - row.before) / memory.window);
    if (!memory.values.empty()) {
        const double before = memory.values.size() > 1 ? memory.values[1] : 1.0;
        const double share = weight;
        weight += before * std::exp(-(row.now - memory.times.front()) / memory.window);
        if (weight > 0) {
            mean = memory.values.front() + share / weight * (value - memory.values.front());
        }
    }
    memory.times = {row.now, row.now};
    memory.values = {mean, weight};
    return mean;
}

// A sample that is not a number (a dry gauge) is not stored.
double filtered(FilterMemory& memory, const RowTimes& row, double value)
{
    const bool wet = !std::isnan(value);
    if (memory.filter == GaugeFilter::exponential) {
        return wet ? exponential(memory, row, value) : value;
    }
    forget_before(memory, row.now - memory.window);
    if (wet) {
        memory.times.push_back(row.now);
        memory.values.push_back(value);
    }
    if (memory.values.empty()) {
        return not_a_number;
    }
    if (memory.filter == GaugeFilter::median) {
        return median(memory.values);
    }
    return std::accumulate(memory.values.begin(), memory.values.end(), 0.0) /
           static_cast<double>(memory.values.size());
}

// Before the first step nothing is known of forces: their filters begin after it.
bool is_known(const Simulation& sim, const Gauge& gauge)
{
    return gauge.type != GaugeType::force || sim.clock.step > 0;
}

} // namespace

GaugeMemory make_gauge_memory(const Scene& scene)
{
    GaugeMemory memory;
    for (const Gauge& gauge : scene.gauges) {
        if (gauge.type == GaugeType::force) {
            memory.forces.push_back({.target = target_of(scene, gauge.on)});
        }
        for (std::size_t k = 0; k < filtered_columns(gauge); ++k) {
            memory.filters.push_back({.filter = gauge.filter, .window = gauge.window});
        }
    }
    return memory;
}

std::vector<double> next_gauge_row(Simulation& sim)
{
    const std::vector<double> raw = read_gauges(sim);
    std::vector<double> row;
    const RowTimes times{sim.gauges.last_row, sim.clock.time};
    auto memory = sim.gauges.filters.begin();
    std::size_t first = 0;
    for (const Gauge& gauge : sim.scene.gauges) {
        const bool known = is_known(sim, gauge);
        const std::size_t count = raw_columns(gauge, sim.scene.dimensions).size();
        row.insert(row.end(), raw.begin() + static_cast<std::ptrdiff_t>(first),
                   raw.begin() + static_cast<std::ptrdiff_t>(first + count));
        for (std::size_t k = 0; k < filtered_columns(gauge); ++k) {
            FilterMemory& own = *memory++;
            row.push_back(known ? filtered(own, times, raw[first + k]) : raw[first + k]);
        }
        first += count;
    }
    for (GaugedForce& force : sim.gauges.forces) {
        force.contact_at_row = force.contact_impulse;
    }
    sim.gauges.last_row = sim.clock.time;
    return row;
}

FilterSamples samples_of(const GaugeMemory& memory)
{
    FilterSamples samples;
    for (const FilterMemory& filter : memory.filters) {
        samples.counts.push_back(static_cast<std::int64_t>(filter.times.size()));
        samples.times.insert(samples.times.end(), filter.times.begin(), filter.times.end());
        samples.values.insert(samples.values.end(), filter.values.begin(), filter.values.end());
    }
    return samples;
}

void take_samples(GaugeMemory& memory, const FilterSamples& samples)
{
    auto left = static_cast<std::int64_t>(samples.times.size());
    auto time = samples.times.begin();
    auto value = samples.values.begin();
    for (std::size_t k = 0; k < memory.filters.size(); ++k) {
        const std::int64_t count = samples.counts[k];
        if (count < 0 || count > left || samples.values.size() != samples.times.size()) {
            throw IoError(
                "the samples of the gauges in the checkpoint do not fit their filters: it is "
                "damaged");
        }
        memory.filters[k].times.assign(time, time + count);
        memory.filters[k].values.assign(value, value + count);
        time += count;
        value += count;
        left -= count;
    }
    if (left != 0) {
        throw IoError("the checkpoint has more samples of gauges than their filters");
    }
}

} // namespace hyoryu
