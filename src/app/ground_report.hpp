// SPDX-License-Identifier: MIT
// What `check` tells of the grounds of a case.
#pragma once

#include "hyoryu/scene/scene.hpp"

#include <string>

namespace hyoryu {

/// Lines on each terrain: window, extremes, differences of grid and surface, steep cells; empty
/// without terrain. Reads the grids again.
std::string ground_text(const Scene& scene);

} // namespace hyoryu
