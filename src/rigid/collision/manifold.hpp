// SPDX-License-Identifier: MIT
// The contact points of two polytopes that touch along a known axis.
#pragma once

#include "narrow_phase.hpp"
#include "separation.hpp"

namespace hyoryu {

/// The convex parts of a pair that meet: the solids themselves, or parts of compounds.
struct PartPair {
    PlacedSolid a;
    PlacedSolid b;
};

/// Appends the corners of the overlap of the two faces that meet along the axis, or the pair of
/// edges. The overlap of two convex polygons has as corners: the corners of each within the other,
/// and the crossings of their edges.
void add_manifold(const BodyPair& pair, const PartPair& parts, const Separation& axis,
                  const Configuration& at, std::vector<Candidate>& found);

} // namespace hyoryu
