// SPDX-License-Identifier: MIT
// Removes the fluid that bodies displace from the filled scene.
#pragma once

#include "hyoryu/scene/fill.hpp"

namespace hyoryu {

/// Height along -g, or along z without gravity [m].
double height(const Scene& scene, const Vec3& p);

/// Takes out as many fluid particles as the bodies displace, everywhere about their surfaces: an
/// excess of a quarter of a layer would start the water with a jolt. Particles that remain of cut
/// cells move to the open part of the cell; inside a body they would be pressed through the solids
/// that it touches. Bodies that may cut a cell together count as one: there is no open part between
/// two bodies that stand on each other. `elsewhere`: bounds of fluid that is not in `filling` and
/// not near a body.
void take_out_bodies(const Scene& scene, const Bounds& elsewhere, Filling& filling);

} // namespace hyoryu
