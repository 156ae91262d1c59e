// SPDX-License-Identifier: MIT
// Checks of the shape, the centre of mass and the moments of inertia of a body.
#pragma once

#include "hyoryu/scene/scene.hpp"

#include <string>

namespace hyoryu {

/// The fault of `body.centre_of_mass`: it lies outside the convex hull of the shape. Empty if there
/// is none, or if the shape has no volume, which is reported separately.
std::string centre_fault(const BodySettings& body, int dimensions);

/// The fault of `body.inertia`: a moment that is not above zero, that exceeds the sum of the other
/// two, or that exceeds m r^2 with all mass at the farthest point r of the shape. Empty if none.
std::string inertia_fault(const BodySettings& body, int dimensions);

/// The fault of the shape of a body: it is thinner than a micrometre (our own limit), so that its
/// moments of inertia are lost in round-off. Empty if there is none.
std::string extent_fault(const BodySettings& body, int dimensions);

} // namespace hyoryu
