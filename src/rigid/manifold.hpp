// SPDX-License-Identifier: MIT
// The contact points of two polytopes that touch along a known axis.
#pragma once

#include "narrow_phase.hpp"
#include "separation.hpp"

namespace hyoryu {

/// The convex parts of a pair that meet: the solids themselves, or parts of compounds.
struct PartPair {
    Placed a;
    Placed b;
};

/// The face of a or b that the axis names, and the face of the other that looks most against it:
/// appends the corners of their overlap that are none of the candidates from `first` on. The
/// overlap of two convex polygons has as corners: the corners of each within the other,
/// and the crossings of their edges.
void add_overlap(const Pair& pair, const PartPair& parts, const Separation& axis,
                 const Configuration& at, std::size_t first, std::vector<Candidate>& found);

/// Appends the overlap of the two faces that meet along the axis, or the pair of edges.
void add_manifold(const Pair& pair, const PartPair& parts, const Separation& axis,
                  const Configuration& at, std::vector<Candidate>& found);

} // namespace hyoryu
