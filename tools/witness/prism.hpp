// SPDX-License-Identifier: MIT
// The solid of a wall of shape prism, from the keys of the resolved case.
#pragma once

#include "scene.hpp"

namespace witness {

/// A closed surface between two heights on a polygon, whose corners' z does not count. An edge that
/// is passed in both directions has no side.
Mesh prism_of(const std::vector<Vec3>& polygon, double bottom, double top);

} // namespace witness
