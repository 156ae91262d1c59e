// SPDX-License-Identifier: MIT
// The datasets of a state that depend on the output settings (see carry_over.hpp).
#pragma once

#include "hyoryu/core/state.hpp"
#include "hyoryu/sim/clock.hpp"
#include "hyoryu/sim/gauges.hpp"

#include <numeric>

namespace hyoryu {

/// Clock: a Clock, constant for a writer.
template <class State, class Clock>
void describe_clock(State& state, Clock& clock)
{
    state("clock/time", "s", clock.time);
    state("clock/step", "", clock.step);
    state("clock/dt", "s", clock.dt);
    state("clock/frame", "", clock.frame);
    state("clock/frame_offset", "", clock.frame_offset);
    state("clock/history", "", clock.history);
    state("clock/gauge", "", clock.gauge);
    state("clock/share", "", clock.share);
}

/// The samples of all filters, one after another.
struct FilterSamples {
    std::vector<std::int64_t> counts; // of each filter
    std::vector<double> times;        // [s]
    std::vector<double> values;       // in the units of their columns
};
FilterSamples samples_of(const GaugeMemory& memory);
/// Throws IoError if the samples do not fit the filters.
void take_samples(GaugeMemory& memory, const FilterSamples& samples);

/// Memory: a GaugeMemory made for the scene, constant for a writer.
template <class State, class Memory>
void describe_gauges(State& state, Memory& memory)
{
    state("gauges/last_row", "s", memory.last_row);
    state.each("gauges/pressure_force", "N", memory.forces, &GaugedForce::pressure);
    state.each("gauges/viscous_force", "N", memory.forces, &GaugedForce::viscous);
    state.each("gauges/fluid_impulse", "N s", memory.forces, &GaugedForce::fluid_impulse);
    state.each("gauges/contact_impulse", "N s", memory.forces, &GaugedForce::contact_impulse);
    state.each("gauges/contact_at_row", "N s", memory.forces, &GaugedForce::contact_at_row);
    FilterSamples samples = samples_of(memory);
    state.values("gauges/samples", "", std::span(samples.counts));
    state.list("gauges/sample_times", "s", samples.times);
    state.list("gauges/sample_values", "", samples.values);
    if constexpr (State::reads) {
        take_samples(memory, samples);
    }
}

} // namespace hyoryu
