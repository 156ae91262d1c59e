// SPDX-License-Identifier: MIT
// The sections of the page, each an HTML fragment with its heading.
#pragma once

#include "results.hpp"

#include <optional>
#include <string>

namespace hyoryu {

std::string case_section(const RunResults& run);
std::string plan_section(const RunResults& run);
std::string run_section(const RunResults& run);
std::string picture_section(const RunResults& run);
std::string cost_section(const RunResults& run);
/// Empty for a run of one process.
std::string process_section(const RunResults& run);
std::string conservation_section(const RunResults& run);
std::string gauge_section(const RunResults& run);
std::string trajectory_section(const RunResults& run);
/// `stiffness`: of all impacts [N/m], instead of the values of the case.
std::string impact_section(const RunResults& run, std::optional<double> stiffness);

/// Four digits, or a dash for NaN.
std::string readable(double value);

} // namespace hyoryu
