// SPDX-License-Identifier: MIT
// Progress of a run: a bar with the remaining time on a terminal, plain lines otherwise, and the
// log.
#pragma once

#include "hyoryu/core/timer.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <filesystem>
#include <fstream>

namespace hyoryu {

enum class Verbosity { quiet, normal };

class Progress {
public:
    /// Shows and writes nothing.
    Progress() = default;
    /// Opens `folder/run.log`, or goes on with it. `from`: simulated time at the start [s].
    Progress(const std::filesystem::path& folder, Verbosity verbosity, double from);

    /// Shows how far the run is, at most a few times a second.
    void update(const Simulation& sim);
    /// A line for the terminal and the log.
    void line(const std::string& text);
    /// Takes the bar away and writes to the log alone: the terminal hears of an error at the end.
    void abandon(const std::string& error);
    /// Ends the bar.
    void end(const Simulation& sim);
    double wall_seconds() const { return steady_seconds() - start_; }

private:
    std::string status(const Simulation& sim) const;
    void show(const Simulation& sim);

    std::ofstream log_;
    Verbosity verbosity_ = Verbosity::quiet;
    bool terminal_ = false;
    double from_ = 0;
    std::int64_t first_step_ = -1;
    double start_ = steady_seconds();
    double shown_ = start_;
};

} // namespace hyoryu
