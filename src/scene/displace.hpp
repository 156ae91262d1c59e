// SPDX-License-Identifier: MIT
// What bodies displace of the fluid that a scene fills in.
#pragma once

#include "hyoryu/scene/fill.hpp"

namespace hyoryu {

/// Height along -g, or along z without gravity [m].
double height(const Scene& scene, const Vec3& p);

/// Takes out as many fluid particles as the body displaces, everywhere about its surface: an excess
/// of a quarter of a layer would start the water with a jolt. What stays of the cells that it cuts
/// goes to their open part: inside, it would be pressed through whatever the body touches there.
void take_out(const Scene& scene, const BodySettings& body, Filling& filling);

} // namespace hyoryu
