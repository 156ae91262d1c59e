// SPDX-License-Identifier: MIT
#include "hyoryu/sim/carry_over.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/gauge_columns.hpp"
#include "hyoryu/sim/checkpoint.hpp"
#include "hyoryu/sim/gauges.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

using Numbers = std::vector<double>;

// Rounding of a sum of steps, as a share of the time between outputs.
constexpr double rounding = 1e-9;

Numbers& numbers_at(Snapshot& state, const std::string& name)
{
    const auto found = state.arrays.find(name);
    auto* numbers =
        found == state.arrays.end() ? nullptr : std::get_if<Numbers>(&found->second.values);
    if (numbers == nullptr) {
        throw IoError("the checkpoint has no `" + name + "`: it is damaged");
    }
    return *numbers;
}

// Number of the first multiple of `every` after the time.
double next_after(double time, double every)
{
    return std::floor(time / every + rounding) + 1;
}

bool same_gauge(const Gauge& a, const Gauge& b)
{
    return a.name == b.name && a.type == b.type && a.at == b.at && a.area == b.area &&
           a.normal == b.normal && a.on == b.on && a.axis == b.axis && a.filter == b.filter &&
           a.window == b.window;
}

// Where the memory of each gauge begins among forces and filters.
struct Places {
    std::size_t force = 0;
    std::size_t filter = 0;
};

Places after(const Gauge& gauge, Places places)
{
    places.force += gauge.type == GaugeType::force ? 1 : 0;
    places.filter += filtered_columns(gauge);
    return places;
}

GaugeMemory carried_gauges(const GaugeMemory& memory, const Scene& before, const Scene& now)
{
    GaugeMemory carried = make_gauge_memory(now);
    carried.last_row = memory.last_row;
    Places to;
    for (const Gauge& gauge : now.gauges) {
        Places from;
        for (const Gauge& earlier : before.gauges) {
            if (same_gauge(gauge, earlier)) {
                const Places end = after(gauge, to);
                std::copy_n(memory.forces.begin() + static_cast<std::ptrdiff_t>(from.force),
                            end.force - to.force,
                            carried.forces.begin() + static_cast<std::ptrdiff_t>(to.force));
                std::copy_n(memory.filters.begin() + static_cast<std::ptrdiff_t>(from.filter),
                            end.filter - to.filter,
                            carried.filters.begin() + static_cast<std::ptrdiff_t>(to.filter));
                break;
            }
            from = after(earlier, from);
        }
        to = after(gauge, to);
    }
    return carried;
}

void carry_gauges(Snapshot& state, const Scene& before, const Scene& now, double time)
{
    GaugeMemory memory = make_gauge_memory(before);
    memory.last_row = time;
    double next = 0; // number of the next row
    if (!before.gauges.empty()) {
        const Numbers& numbers = numbers_at(state, gauges_array);
        if (numbers.empty()) {
            throw IoError("the checkpoint has no gauges: it is damaged");
        }
        restore(memory, std::span(numbers).first(numbers.size() - 1));
        next = numbers.back();
    }
    state.arrays.erase(gauges_array);
    if (now.gauges.empty()) {
        return;
    }
    const double every = now.output.gauge_every;
    if (every > 0 && (every != before.output.gauge_every || before.gauges.empty())) {
        next = next_after(time, every);
    }
    Numbers numbers = numbers_of(carried_gauges(memory, before, now));
    numbers.push_back(next);
    state.arrays[gauges_array] = {gauges_array, "", 1, std::move(numbers)};
}

} // namespace

void carry_over(Snapshot& state, const Scene& before, const Scene& now)
{
    Numbers& clock = numbers_at(state, clock_array);
    constexpr std::size_t frame = 3; // in the order of `save`
    constexpr std::size_t history = 4;
    if (clock.size() <= history) {
        throw IoError("the clock of the checkpoint is too short: it is damaged");
    }
    const double time = clock.front();
    if (now.output.every != before.output.every) {
        const double offset = clock[frame] - next_after(time, now.output.every);
        state.arrays[frame_offset_array] = {frame_offset_array, "", 1, Numbers{offset}};
    }
    if (now.output.history_every > 0 && now.output.history_every != before.output.history_every) {
        clock[history] = next_after(time, now.output.history_every);
    }
    carry_gauges(state, before, now, time);
}

} // namespace hyoryu
