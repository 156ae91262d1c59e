// SPDX-License-Identifier: MIT
// Contact candidates of a pair at given poses.
#pragma once

#include "feature.hpp"

#include <compare>

namespace hyoryu {

/// A body and its partner: another body, or -1 - (index of the boundary).
struct BodyPair {
    int a = 0, b = 0;
    auto operator<=>(const BodyPair&) const = default;
};

/// Located impacts need no contacts of polytopes or rods farther apart than this [m].
inline double clearly_apart(const Geometry& geometry)
{
    return 1e-5 * geometry.unit;
}

/// Appends the features of the pair that face each other, in a fixed order. Polytopes and rods more
/// than `near` apart have none.
void find_candidates(const BodyPair& pair, const Configuration& at, double near,
                     std::vector<Candidate>& found);

/// Whether the pair is made of polytopes and rods, or of polytopes and a mesh, which have
/// separating axes.
bool has_axis(const BodyPair& pair, const Geometry& geometry);

/// The signed distance of such a pair [m].
double axis_distance(const BodyPair& pair, const Configuration& at);

} // namespace hyoryu
