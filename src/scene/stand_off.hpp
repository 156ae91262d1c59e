// SPDX-License-Identifier: MIT
// Fluid at its distance from bodies.
#pragma once

#include "hyoryu/scene/fill.hpp"

namespace hyoryu {

/// Moves the fluid that is clearly nearer to a body than half a spacing to that distance from walls
/// and bodies. What it would crowd there gives way: pairs nearer than seven eighths of a spacing
/// move apart, as far as two and a half spacings around (position-based dynamics, Mueller et al.
/// 2007). The water is what it was, and where none is too near nothing moves.
void stand_off_bodies(const Scene& scene, Filling& filling);

} // namespace hyoryu
