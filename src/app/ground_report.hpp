// SPDX-License-Identifier: MIT
// The report of `check` on the terrains of a case.
#pragma once

#include "hyoryu/scene/scene.hpp"

#include <string>

namespace hyoryu {

/// Lines on each terrain: window, extremes, differences of grid and surface, steep cells; empty
/// without terrain. Reads the grids again.
std::string ground_text(const Scene& scene);

} // namespace hyoryu
