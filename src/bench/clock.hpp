// SPDX-License-Identifier: MIT
// Clocks of the benchmark.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace hyoryu::bench {

/// CPU time of this thread [s]: time taken by other processes does not count.
inline double thread_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Wall time [s].
inline double wall_seconds()
{
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

/// Median CPU time of a call, over calls that take `least` seconds in all and are five or more.
double median_time(double least, const auto& call)
{
    std::vector<double> times;
    double total = 0;
    call();
    while (times.size() < 5 || total < least) {
        const double start = thread_seconds();
        call();
        times.push_back(thread_seconds() - start);
        total += times.back();
    }
    const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), middle, times.end());
    return *middle;
}

/// Least wall time of several calls.
double best_time(int tries, const auto& call)
{
    double best = 1e300;
    for (int k = 0; k < tries; ++k) {
        const double start = wall_seconds();
        call();
        best = std::min(best, wall_seconds() - start);
    }
    return best;
}

} // namespace hyoryu::bench
