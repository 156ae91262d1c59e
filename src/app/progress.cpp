// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include "plan_report.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace hyoryu {

namespace {

constexpr double terminal_interval = 0.2; // [s]
constexpr double line_interval = 10;      // [s]
constexpr int bar_width = 24;

// A terminal that is gone must not end a run: fmt::print would throw.
void tell(const std::string& text)
{
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

// The log file. Throws unless it is a regular file: opening a pipe would block for ever.
std::filesystem::path log_file(const std::filesystem::path& folder)
{
    const std::filesystem::path file = folder / "run.log";
    std::error_code fault;
    if (std::filesystem::exists(file, fault) && !std::filesystem::is_regular_file(file, fault)) {
        throw IoError(fmt::format("cannot write `{}`: it is not a file", file.string()));
    }
    return file;
}

} // namespace

Progress::Progress(const std::filesystem::path& folder, Verbosity verbosity, double from)
    : log_(log_file(folder), std::ios::app), verbosity_(verbosity),
      terminal_(isatty(STDERR_FILENO) == 1), from_(from)
{
}

std::string Progress::status(const Simulation& sim) const
{
    const double end = sim.scene.time.end;
    const double wall = wall_seconds();
    const auto steps = static_cast<double>(sim.clock.step - std::max<std::int64_t>(first_step_, 0));
    const double done = end > from_ ? (sim.clock.time - from_) / (end - from_) : 1;
    const double eta = done > 0 ? wall * (1 - done) / done : 0;
    const auto n = static_cast<double>(sim.plan.counts.particles());
    std::string text = fmt::format("{:3.0f} %  t = {:.4f} / {} s  step {}",
                                   100 * sim.clock.time / end, sim.clock.time, end, sim.clock.step);
    if (n > 0) {
        text +=
            fmt::format("  {:.0f} particles  {:.2f} M particle-steps/s", n, n * steps / wall / 1e6);
    }
    return text + fmt::format("  ETA {}", readable_seconds(eta));
}

void Progress::show(const Simulation& sim)
{
    if (terminal_) {
        const int filled =
            static_cast<int>(bar_width * std::min(sim.clock.time / sim.scene.time.end, 1.0));
        tell(fmt::format("\r\x1b[K[{}{}] {}", std::string(static_cast<std::size_t>(filled), '#'),
                         std::string(static_cast<std::size_t>(bar_width - filled), '.'),
                         status(sim)));
    } else {
        tell(status(sim) + "\n");
        log_ << status(sim) << '\n';
    }
}

void Progress::update(const Simulation& sim)
{
    if (first_step_ < 0) {
        first_step_ = sim.clock.step;
    }
    const double now = steady_seconds();
    const double interval = terminal_ ? terminal_interval : line_interval;
    if (verbosity_ == Verbosity::normal && now - shown_ >= interval) {
        shown_ = now;
        show(sim);
    }
}

void Progress::line(const std::string& text)
{
    if (verbosity_ == Verbosity::normal) {
        tell(fmt::format("{}{}\n", terminal_ ? "\r\x1b[K" : "", text));
    }
    log_ << text << '\n';
    log_.flush();
}

void Progress::abandon(const std::string& error)
{
    if (verbosity_ == Verbosity::normal && terminal_) {
        tell("\r\x1b[K");
    }
    log_ << error << '\n';
    log_.flush();
}

void Progress::end(const Simulation& sim)
{
    if (verbosity_ == Verbosity::normal) {
        show(sim);
        if (terminal_) {
            tell("\n");
        }
    }
    log_ << status(sim) << '\n';
    log_.flush();
}

} // namespace hyoryu
