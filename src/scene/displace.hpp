// SPDX-License-Identifier: MIT
// What bodies displace of the fluid that a scene fills in.
#pragma once

#include "hyoryu/scene/fill.hpp"

namespace hyoryu {

/// Height along -g, or along z without gravity [m].
double height(const Scene& scene, const Vec3& p);

/// Takes out as many fluid particles as the bodies displace, everywhere about their surfaces: an
/// excess of a quarter of a layer would start the water with a jolt. What stays of the cells that
/// they cut goes to their open part: inside, it would be pressed through whatever a body touches
/// there. Bodies that may cut a cell together count as one: between two that stand on each other
/// is no open part.
void take_out_bodies(const Scene& scene, Filling& filling);

} // namespace hyoryu
