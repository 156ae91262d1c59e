// SPDX-License-Identifier: MIT
// Points of an ellipse whose normals go through a given point.
#pragma once

#include "hyoryu/core/types.hpp"

#include <optional>

namespace hyoryu {

/// A point (cosine, beta sine) of the ellipse of half axes 1 and |beta|, and a normal there.
struct Foot {
    Eigen::Vector2d angle{1, 0};
    Eigen::Vector2d normal{1, 0};
};

/// The foot of the point (x, y) on the long side of normal +y of the ellipse (cos t, beta sin t),
/// 0 < t < pi, or past its ends; nothing if there is none, which is with beta < 0 only: this side
/// is then behind the other one, and its normal points inward.
std::optional<Foot> upper_foot(double x, double y, double beta);

} // namespace hyoryu
