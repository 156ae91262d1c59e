// SPDX-License-Identifier: MIT
#include "hyoryu/sim/carry_over.hpp"

#include "hyoryu/scene/gauge_columns.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "rounding.hpp"
#include "state.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Number of the first multiple of `every` after the time.
std::int64_t next_after(double time, double every)
{
    return static_cast<std::int64_t>(std::floor(time / every + rounding_of_times)) + 1;
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

// The number of the next row goes with the clock.
void carry_gauges(Snapshot& state, const Scene& before, const Scene& now, Clock& clock)
{
    GaugeMemory memory = make_gauge_memory(before);
    memory.last_row = clock.time;
    if (!before.gauges.empty()) {
        StateReader reader(state);
        describe_gauges(reader, memory);
    }
    std::erase_if(state.arrays,
                  [](const auto& array) { return array.first.starts_with("gauges/"); });
    if (now.gauges.empty()) {
        clock.gauge = 0;
        return;
    }
    const double every = now.output.gauge_every;
    if (every > 0 && (every != before.output.gauge_every || before.gauges.empty())) {
        clock.gauge = next_after(clock.time, every);
    }
    const GaugeMemory carried = carried_gauges(memory, before, now);
    StateWriter writer(state);
    describe_gauges(writer, carried);
}

} // namespace

void carry_over(Snapshot& state, const Scene& before, const Scene& now)
{
    Clock clock;
    StateReader reader(state);
    describe_clock(reader, clock);
    if (now.output.every != before.output.every) {
        clock.frame_offset = clock.frame - next_after(clock.time, now.output.every);
    }
    if (now.output.history_every > 0 && now.output.history_every != before.output.history_every) {
        clock.history = next_after(clock.time, now.output.history_every);
    }
    carry_gauges(state, before, now, clock);
    StateWriter writer(state);
    describe_clock(writer, clock);
}

} // namespace hyoryu
