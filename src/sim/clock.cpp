// SPDX-License-Identifier: MIT
#include "hyoryu/sim/clock.hpp"

#include "rounding.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Rows that are not spaced in time are due after every step.
bool row_due(double time, std::int64_t number, double every)
{
    return every <= 0 || time >= static_cast<double>(number) * every - rounding_of_times * every;
}

} // namespace

bool finished(const Clock& clock, const Scene& scene)
{
    return clock.time >= scene.time.end * (1 - rounding_of_times);
}

bool frame_due(const Clock& clock, const Scene& scene)
{
    const double every = scene.output.every;
    const double frame = static_cast<double>(clock.frame - clock.frame_offset) * every;
    return clock.time >= frame - rounding_of_times * every;
}

bool history_due(const Clock& clock, const Scene& scene)
{
    return row_due(clock.time, clock.history, scene.output.history_every);
}

bool gauge_due(const Clock& clock, const Scene& scene)
{
    return row_due(clock.time, clock.gauge, scene.output.gauge_every);
}

NextStep next_step(const Clock& clock, const Scene& scene, const TimeLimit& limit)
{
    if (scene.time.step) {
        const double end = static_cast<double>(clock.step + 1) * *scene.time.step;
        const double last = std::min(end, scene.time.end);
        return {end > scene.time.end * (1 + rounding_of_times) ? last - clock.time
                                                               : *scene.time.step,
                last, "fixed"};
    }
    // A frame that is due now has been or will be written at this time; the next one is the goal.
    const auto due = frame_due(clock, scene) ? clock.frame + 1 : clock.frame;
    const double frame = static_cast<double>(due - clock.frame_offset) * scene.output.every;
    const double goal = std::min(frame, scene.time.end);
    const double rest = goal - clock.time;
    const double dt = clock.share * limit.dt;
    if (dt >= rest) {
        return {rest, goal, "frame"};
    }
    if (dt > rest / 2) {
        return {rest / 2, clock.time + rest / 2, "frame"};
    }
    return {dt, clock.time + dt, std::string(limit.name)};
}

} // namespace hyoryu
