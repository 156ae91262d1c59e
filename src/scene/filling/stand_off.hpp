// SPDX-License-Identifier: MIT
// Minimum distances of fluid particles: from bodies, and from each other.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Moves the fluid that is clearly nearer to a body than half a spacing to that distance from walls
/// and bodies. Particles that it would crowd there move away: pairs nearer than seven eighths of a
/// spacing separate, within two and a half spacings (position-based dynamics, Mueller et al. 2007).
/// No particle is added or removed, and without a particle too near nothing moves.
void stand_off_bodies(const Scene& scene, Filling& filling);

/// Moves pairs of fluid particles about surfaces (`fluid_cut`) that are nearer than two fifths of a
/// spacing to three fifths, with the same method, and keeps them off walls and bodies. Several
/// processes all do it for all pairs, which are few. `region`: null for one process.
void part_pairs(const Scene& scene, const FillRegion* region, Filling& filling);

} // namespace hyoryu
