// SPDX-License-Identifier: MIT
#include "hyoryu/core/timer.hpp"

namespace hyoryu {

void StageTimer::begin(std::string_view name)
{
    const auto now = Clock::now();
    if (running_ != nullptr) {
        running_->seconds += std::chrono::duration<double>(now - since_).count();
        running_->calls += 1;
    }
    since_ = now;
    running_ = nullptr;
    if (name.empty()) {
        return;
    }
    for (Stage& stage : stages_) {
        if (stage.name == name) {
            running_ = &stage;
            return;
        }
    }
    stages_.push_back({std::string(name)});
    running_ = &stages_.back();
}

} // namespace hyoryu
