// SPDX-License-Identifier: MIT
// Which shapes, centres of mass and moments of inertia a body can have.
#pragma once

#include "hyoryu/scene/scene.hpp"

#include <string>

namespace hyoryu {

/// Why `body.centre_of_mass` cannot be: it lies outside the convex hull of the shape. Empty if it
/// can, or if the shape has no volume, which is a mistake of its own.
std::string centre_fault(const BodySettings& body, int dimensions);

/// Why `body.inertia` cannot be: a moment that is not above zero, that exceeds the sum of the other
/// two, or that exceeds m r^2 with all mass at the farthest point r of the shape. Empty if it can.
std::string inertia_fault(const BodySettings& body, int dimensions);

/// Why the shape of a body cannot be: it is thinner than a micrometre, so that its moments of
/// inertia drown in rounding. Empty if it can. Ours.
std::string extent_fault(const BodySettings& body, int dimensions);

} // namespace hyoryu
