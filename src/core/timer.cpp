// SPDX-License-Identifier: MIT
#include "hyoryu/core/timer.hpp"

#include <algorithm>

namespace hyoryu {

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
