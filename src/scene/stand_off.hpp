// SPDX-License-Identifier: MIT
// Fluid at its distance from bodies.
#pragma once

#include "hyoryu/scene/fill.hpp"

namespace hyoryu {

/// Moves the fluid that is clearly nearer to a body than half a spacing to that distance from walls
/// and bodies. Particles that it would crowd there move away: pairs nearer than seven eighths of a
/// spacing separate, within two and a half spacings (position-based dynamics, Mueller et al. 2007).
/// No particle is added or removed, and without a particle too near nothing moves.
void stand_off_bodies(const Scene& scene, Filling& filling);

} // namespace hyoryu
