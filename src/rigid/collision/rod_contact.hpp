// SPDX-License-Identifier: MIT
// Contacts of two convex solids of which one or both are rods.
#pragma once

#include "manifold.hpp"

namespace hyoryu {

/// The signed distance of the two [m]: the largest distance along the normal of a face or of a pair
/// of features that can be nearest. Returns early with a face that separates by more than `enough`.
double rod_distance(const BodyPair& pair, const PartPair& parts, const Configuration& at,
                    double enough);

/// Appends the features that face each other if the solids are not more than `near` apart: rim
/// points above a face, and pairs of curves whose normal is a best separating axis. Those that
/// another part of a compound covers are appended to `covered`.
void add_rod_contacts(const BodyPair& pair, const PartPair& parts, const Configuration& at,
                      double near, std::vector<Candidate>& found, std::vector<Candidate>& covered);

} // namespace hyoryu
