// SPDX-License-Identifier: MIT
// Bodies in the fluid of several processes.
#pragma once

#include "fill_region.hpp"

namespace hyoryu {

/// Takes out the fluid that bodies displace, and moves the rest off them. One group of bodies after
/// the other takes what the ones before have left: several processes do all of it, each with the
/// fluid about all bodies, and keep what is in their regions. `region`: null for one process.
void displace_by_bodies(const Scene& scene, const FillRegion* region, Filling& filling);

} // namespace hyoryu
