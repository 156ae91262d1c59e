// SPDX-License-Identifier: MIT
#include "hyoryu/core/timer.hpp"

#include <algorithm>
#include <ctime>

namespace hyoryu {

double thread_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double steady_seconds()
{
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

void StageTimer::begin(std::string_view name)
{
    const auto now = Clock::now();
    if (running_) {
        stages_[*running_].seconds += std::chrono::duration<double>(now - since_).count();
        stages_[*running_].calls += 1;
    }
    since_ = now;
    running_.reset();
    if (name.empty()) {
        return;
    }
    const auto found = std::ranges::find(stages_, name, &Stage::name);
    running_ = static_cast<std::size_t>(found - stages_.begin());
    if (found == stages_.end()) {
        stages_.push_back({std::string(name)});
    }
}

} // namespace hyoryu
