// SPDX-License-Identifier: MIT
// Bodies in the fluid of several processes.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Removes the fluid that bodies displace, and moves the rest off their surfaces. Groups of bodies
/// are processed in sequence, since each one removes fluid that the earlier ones have left.
/// Therefore every process computes the fluid near all bodies and keeps the particles of its own
/// region. `region`: null for one process.
void displace_by_bodies(const Scene& scene, const FillRegion* region, Filling& filling);

} // namespace hyoryu
