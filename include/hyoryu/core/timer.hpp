// SPDX-License-Identifier: MIT
// CPU time of a thread, a steady clock, and wall time by named stage of a step.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// CPU time of this thread [s]: time that other work takes on the core does not count.
double thread_seconds();

/// The steady clock of this machine [s]; only differences count.
double steady_seconds();

/// Seconds by stage, in the order in which the stages were first met.
class StageTimer {
public:
    struct Stage {
        std::string name;
        double seconds = 0;
        long long calls = 0;
    };

    /// Ends the running stage, if any, and starts this one; an empty name starts none.
    void begin(std::string_view name);
    void end() { begin({}); }
    const std::vector<Stage>& stages() const { return stages_; }

private:
    using Clock = std::chrono::steady_clock;
    std::vector<Stage> stages_;
    std::optional<std::size_t> running_; // no pointer: a copy goes on with stages of its own
    Clock::time_point since_;
};

} // namespace hyoryu
