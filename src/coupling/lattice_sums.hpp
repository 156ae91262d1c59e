// SPDX-License-Identifier: MIT
// Kernel sums of a regular lattice of fluid particles in front of a flat face. The joints compare
// them with the actual sums to find the amount of water at a rim or in a gap.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

#include <array>

namespace hyoryu {

/// Sums W over rows of the lattice of fluid particles as a solid particle sees them [1/m^d].
struct LatticeSums {
    static constexpr int steps = 8;
    /// Of a row in the middle between faces 1/2, 1/2 + 1/8, ... 2 spacings apart.
    std::array<double, 3 * steps / 2 + 1> between{};
    double rim = 0; // of half a row that begins a spacing away, beside the particle
    // Of all half rows of water beside the particle whose surface is a spacing below it. A rim with
    // this sum or less is dry: the extrapolated pressure of an impact below does not act there.
    double below = 0;
    // Where the face goes on beyond the rim: of the first row of water below the particle, and of
    // all rows of water whose surface is a spacing below the face.
    double first = 0;
    double under = 0;

    // Across the common edge of two faces in one plane, back to back: force of the fluid before one
    // of them on the solid behind the other, over p, the length of the edge and the spacing; the
    // fluid begins 0, 1/8, ... 2 spacings from the solid.
    std::array<double, 2 * steps + 1> across{};

    // Of what lies beyond a rim, as a solid particle 0, 1/4, ... 3 spacings inside of it sees it,
    // over a floor 1/2, 3/4, ... 2 spacings below the face.
    static constexpr int insides = 13;
    static constexpr int floors = 7;
    using BeyondRim = std::array<std::array<double, floors>, insides>;
    BeyondRim fluid_beyond{}; // all fluid
    BeyondRim row_beyond{};   // the part of a row in the middle of the gap

    // Force of one row of fluid at the pressure p in the middle of gaps of 1/2, ... 1 spacings on
    // one of the faces, over p times its area.
    std::array<double, steps + 1> pushes{};
    // The same of the films between the faces at this pressure.
    std::array<double, steps + 1> films{};

    /// Sum of W over a row in the middle between faces `width` spacings apart; a width below 1/2
    /// counts as 1/2.
    double row(double width) const;
    /// Part beyond a rim of the sums for a solid particle `inside` spacings within it and a floor
    /// `width` spacings below the face; none from 3 on.
    static double beyond(const BeyondRim& sums, double inside, double width);
    /// Share of its pressure that a row in the middle between faces transmits to them, with the
    /// films that are kept there: all of it from a width of 1 on, none below 1/4.
    double transmitted(double width) const;
    /// `across` for fluid that begins `apart` spacings from the solid; none from 2 on.
    double across_edge(double apart) const;
};

/// The sums for the kernel, spacing and dimensions of a fluid, which are constant during a run.
LatticeSums lattice_sums(const Fluid& fluid);

} // namespace hyoryu
