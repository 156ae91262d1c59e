// SPDX-License-Identifier: MIT
// Time, the length of the next step, and when output is due.
#pragma once

#include "hyoryu/fluid/time_limit.hpp"
#include "hyoryu/scene/scene.hpp"

#include <string>

namespace hyoryu {

struct Clock {
    double time = 0; // [s]
    std::int64_t step = 0;
    double dt = 0;                 // of the last step [s]
    std::int64_t frame = 0;        // number of the next frame
    std::int64_t frame_offset = 0; // it is due at (frame - frame_offset) output.every
    std::int64_t history = 0;      // number of the next history row, if they are spaced in time
    std::int64_t gauge = 0;        // likewise of the gauges
    double share = 1;              // of the limits that steps take: halved by every recovery
};

/// The next step.
struct NextStep {
    double dt = 0;     // [s]
    double end = 0;    // time after it, exactly a frame time if it reaches one [s]
    std::string limit; // the limit that set dt: "acoustic", "frame", "fixed" ...
};

/// A fixed step counts time as a multiple of itself; an adaptive one is the clock's share
/// of the shortest limit, shortened to meet the next frame or the end exactly, and halved before a
/// remainder would become tiny.
NextStep next_step(const Clock& clock, const Scene& scene, const TimeLimit& limit);

/// Whether the run is over.
bool finished(const Clock& clock, const Scene& scene);

/// Whether a frame, a row of the histories, or one of the gauges, is due at the present time.
/// Asking does not change that; `frame`, `history` and `gauge` count on when it has been written.
bool frame_due(const Clock& clock, const Scene& scene);
bool history_due(const Clock& clock, const Scene& scene);
bool gauge_due(const Clock& clock, const Scene& scene);

} // namespace hyoryu
