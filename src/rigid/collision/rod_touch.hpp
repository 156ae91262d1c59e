// SPDX-License-Identifier: MIT
// Gap functions of the side and the rims of a rod.
#pragma once

#include "feature.hpp"
#include "tolerances.hpp"

#include <array>
#include <cmath>

namespace hyoryu {

/// A touch, and the distance of its point past the ends of the touching features [m].
struct RodTouch {
    Touch touch;
    double past = 0;
};

/// The touch of rim_face, cap_cap, rod_corner, side_line, rim_line and rim_rim; the edges
/// and corners of a mesh are its creases and corners.
RodTouch rod_touch(const Feature& feature, const Configuration& at);

/// The signed distance of a rod and a triangle [m]: the largest distance along the normals of the
/// triangle, of the caps, and of the pairs of features that can be nearest.
double rod_triangle_distance(const PlacedSolid& rod, const std::array<Vec3, 3>& triangle);

/// The point of rim i of a rod nearest to a plane of unit normal n.
Vec3 low_point(const PlacedSolid& rod, int i, const Vec3& n);

/// Calls put(feature) for the points of a rod that may touch a plane or patch: that of each rim
/// nearest to it, and the corners of the cap on which the rod stands, if it does. `upright`: the
/// cosine of its axis with the normal.
void for_low_features(Feature feature, const Solid& rod, double upright, const auto& put)
{
    feature.kind = FeatureKind::rim_low;
    for (feature.i = 0; feature.i < 2; ++feature.i) {
        put(feature);
    }
    if (std::abs(upright) > standing) {
        feature.kind = FeatureKind::corner_plane;
        for (const int corner : rod.faces[upright > 0 ? 0 : 1].corners) {
            feature.i = corner;
            put(feature);
        }
    }
}

} // namespace hyoryu
