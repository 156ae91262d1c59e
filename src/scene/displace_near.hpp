// SPDX-License-Identifier: MIT
// Bodies in the fluid of several processes.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Removes the fluid that bodies displace, and moves the rest off their surfaces. Groups of bodies
/// follow each other, since each takes from what the ones before have left. Several processes
/// therefore all do the same with the fluid near all bodies, and keep the particles of their
/// regions. `region`: null for one process.
void displace_by_bodies(const Scene& scene, const FillRegion* region, Filling& filling);

} // namespace hyoryu
