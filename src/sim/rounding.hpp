// SPDX-License-Identifier: MIT
// Rounding errors of the clock.
#pragma once

namespace hyoryu {

/// Rounding of a sum of steps, as a share of the time between outputs [1].
inline constexpr double rounding_of_times = 1e-9;

} // namespace hyoryu
