// SPDX-License-Identifier: MIT
#include "machine_load.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/core/timer.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace hyoryu {

double seconds_without_core()
{
    constexpr double nanosecond = 1e-9;
    double total = 0;
    std::error_code fault; // threads may end while they are looked at
    const std::filesystem::directory_iterator end;
    for (std::filesystem::directory_iterator at("/proc/self/task", fault); !fault && at != end;
         at.increment(fault)) {
        // Time on a core, time without one, turns on a core: Documentation/scheduler/sched-stats.
        std::ifstream file(at->path() / "schedstat");
        double on_core = 0, without = 0;
        if (file >> on_core >> without) {
            total += nanosecond * without;
        }
    }
    return total;
}

CoreWatch::CoreWatch() : waited_(seconds_without_core()), start_(steady_seconds()) {}

double CoreWatch::waiting() const
{
    const double passed = steady_seconds() - start_;
    const double waited = seconds_without_core() - waited_;
    return passed > 0 ? std::clamp(waited / (passed * thread_count()), 0.0, 1.0) : 0;
}

} // namespace hyoryu
