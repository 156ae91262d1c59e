// SPDX-License-Identifier: MIT
// A cell grid of the particles near those whose packing is relaxed, and their pressure force.
#pragma once

#include "hyoryu/core/kernel.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hyoryu {

/// A place in whole numbers of a unit.
using UnitPlace = std::array<std::int32_t, 3>;

/// Fixed-point places: whole numbers of a unit, relative to a middle. Their differences are exact,
/// so that results depend neither on the position of the scene nor on the order of a sum.
struct PackingUnits {
    static constexpr double in_spacings = 0x1p-20; // a unit, unless the points extend too far

    Vec3 middle{0, 0, 0}; // [m]
    double size = 1;      // of a unit [m]

    UnitPlace whole(const Vec3& place) const;
    Vec3 rounded(const Vec3& place) const;
};

/// The units for points within `box`.
PackingUnits packing_units(const Vec3& middle, double spacing, const Vec3& low, const Vec3& high);

/// Points in the cells of a grid, x fastest: those near a place are runs of points, a run for each
/// row of cells along x. Nothing is kept for each pair.
struct PackingGrid {
    UnitPlace origin{0, 0, 0}; // lower corner [units]
    UnitPlace edge{1, 1, 1};   // of the cells [units]
    std::array<double, 3> inverse_edge{1, 1, 1};
    std::array<Index, 3> count{0, 0, 0}; // cells along x, y, z
    std::vector<std::int32_t> start;     // first point of each cell; one more than cells
    std::vector<std::int32_t> order;     // rows of the points, in the order of the cells
    std::vector<std::int32_t> x, y, z; // of the points in that order, then a pack of zeros [units]
    std::vector<float> depth;          // of fluid, in that order [spacings]; else empty
    std::vector<float> cubes;          // of solids, in that order: volume of the cell [spacings^d]
};

/// Sorts places into cells for searches within `reach` [units]. The order within a cell is that of
/// the rows.
PackingGrid packing_grid(std::span<const UnitPlace> places, double reach);

/// Whether cells within `reach` [units] of a place have points.
bool any_within(const PackingGrid& grid, const UnitPlace& place, double reach);

/// The pressure that particles see, lengths in spacings.
struct PackingPressure {
    /// Below this distance the force F r of a pair is divided by distance/`apart` [spacings]. The
    /// force of the kernel alone falls to zero with the distance, so that particles in corners
    /// would end up in one place (pairing, Dehnen & Aly 2012). Below a distance of 1e-3 the divisor
    /// is constant.
    static constexpr float apart = 0.6F;

    Kernel kernel; // of a spacing of 1
    Vec3 down{0, 0, -1};
    double unit = 1;    // [spacings]
    double reach = 1;   // within which points of a grid are looked for [units]
    double volume = 1;  // of a particle of the fluid [spacings^d]
    double deepest = 1; // depth of a particle, about [spacings]
};

/// sum V_j (d_i + d_j) R F r over the fluid and the solids (null: none near) about a place, r = x_i
/// - x_j, in weights of a particle; R = max(1, apart/|r|). A solid has the depth that i sees there,
/// d_i - r . down. Depths below zero count as zero. The sum is of whole numbers: the same in any
/// order.
Vec3 pressure_sum(const PackingGrid& fluid, const PackingGrid* solids,
                  const PackingPressure& pressure, const UnitPlace& place, float depth);

} // namespace hyoryu
