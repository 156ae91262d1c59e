// SPDX-License-Identifier: MIT
// Whether other work holds the cores while something is timed.
#pragma once

namespace hyoryu {

/// Seconds that the threads of this process have waited for a core so far, although they had work,
/// by the kernel's own count (`schedstat`); 0 where it keeps none [s].
double seconds_without_core();

/// Measures from its construction on.
class CoreWatch {
public:
    CoreWatch();
    /// Share of the time since then in which a thread waited for a core, averaged over the threads
    /// of the solver [1].
    double waiting() const;

private:
    double waited_;
    double start_;
};

/// From this share on times are reported as those of a busy machine [1].
inline constexpr double noteworthy_waiting = 0.05;
/// From that factor on by which stalls lengthen steps.
inline constexpr double noteworthy_slowdown = 1.15;

} // namespace hyoryu
