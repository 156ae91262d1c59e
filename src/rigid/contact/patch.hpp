// SPDX-License-Identifier: MIT
// Friction of flat patches: where the friction of each contact of a face acts.
//
// The corners of a face carry its weight, and say when it tips. Its friction is spread over the
// face, which resists a turn about the normal less than friction at the corners would. With the
// uniform pressure p over the patch A the moment of a pure turn is mu p times the integral of |r|
// over A (Contensou 1963, "Couplage entre frottement de glissement et frottement de pivotement").
// The friction of each contact acts at a point moved towards the centre of pressure o,
//     q_k = o + s (r_k - o),   s = mean of |r - c| over A / mean of |r_k - c|,   c the centroid,
// with the friction of its own normal force: exact for a slide, whose friction goes through o, and
// for a turn under equal forces. A load off the centre weighs the points as it weighs the corners,
// so that the moment of a turn follows the pressure. Limits: while a square slides and turns at
// once its friction is that of four points and not of the integral: force within 4 % of mu N where
// it slides along a side, up to 22 % where the centre about which it turns lies on a diagonal, next
// to a friction point. An impact rubs at its contact points.
#pragma once

#include "hyoryu/core/types.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// How the friction points of a patch follow from its contact points.
struct PatchRule {
    double scale = 1;            // s [1]
    std::vector<double> weights; // the centroid is the sum of these times the points; sum 1 [1]
};

/// The points at the corners of the hull of points in one plane with the unit normal `n`, by their
/// indices, counter-clockwise; those on its sides are left out. If there are more than `most`, only
/// those outermost in eight directions are kept; the first of these is the direction `along`,
/// perpendicular to n.
std::vector<int> outermost(std::span<const Vec3> points, const Vec3& n, const Vec3& along,
                           std::size_t most);

/// The area that the contacts of a patch bound: their hull, or the disc on whose rim they lie.
enum class PatchForm { hull, disc };

/// The rule of a patch of contacts at these points [m], in one plane with the unit normal `n`.
/// `hull`: the corners of their hull by their indices, counter-clockwise about `n`. Points on one
/// line count as a line of uniform pressure; a single point is its own friction point.
PatchRule patch_rule(std::span<const Vec3> points, std::span<const int> hull, const Vec3& n,
                     PatchForm form);

} // namespace hyoryu
