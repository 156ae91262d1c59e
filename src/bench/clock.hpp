// SPDX-License-Identifier: MIT
// Clocks of the benchmark.
#pragma once

#include "hyoryu/core/timer.hpp"

#include <algorithm>
#include <vector>

namespace hyoryu::bench {

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
        const double start = steady_seconds();
        call();
        best = std::min(best, steady_seconds() - start);
    }
    return best;
}

} // namespace hyoryu::bench
