// SPDX-License-Identifier: MIT
// The weight of the moving particle semi-implicit method as a kernel.
#pragma once

#include "hyoryu/core/kernel.hpp"

namespace hyoryu {

/// The weight of MPS, w = re/r - 1, written as W = w/(n0 V0) and F = -d w/(n0 V0 r^2): with these
/// every operator of MPS is one of SPH (Souto-Iglesias, Macia, Gonzalez & Cercos-Pita 2013).
/// r^2 + (dp/2)^2 stands for r^2 in the two quotients, since a pair at a tenth of a spacing would
/// otherwise weigh a thousand times one at a spacing and ask for as short a step. W and F are
/// scaled so that sum W V0 = 1 over the neighbours and -sum F x^2 V0 = 1 on the particle lattice,
/// V0 its cell. Source: Koshizuka & Oka (1996).
struct MpsKernel {
    real support = 2;   // re [m]
    real w_scale = 0;   // [1/m^d]
    real f_scale = 0;   // [1/m^d]
    real softening = 0; // (dp/2)^2 [m2]

    template <class N>
    Pair<N> operator()(const Vec<N>& r) const
    {
        const N distance_squared = dot(r, r);
        const N distance = square_root(distance_squared);
        const N bounded = distance_squared + softening;
        const N w = positive(N(support - distance)) / square_root(bounded);
        return {r, distance, distance_squared, w_scale * w, f_scale * w / bounded};
    }
};

/// The weight of radius `support` on a lattice of the given spacing.
MpsKernel make_mps_kernel(real support, real spacing, int dimensions);

} // namespace hyoryu
