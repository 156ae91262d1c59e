// SPDX-License-Identifier: MIT
// The smoothing kernel: Wendland C2, calibrated on the particle lattice.
#pragma once

#include "hyoryu/core/vec.hpp"

namespace hyoryu {

/// Geometry of the ordered pair i <- j, computed once for all terms of a sweep.
template <class N>
struct Pair {
    Vec<N> r;           // x_i - x_j [m]
    N distance;         // |r| [m]
    N distance_squared; // |r|^2 [m2]
    N w;                // W(r) [1/m^d]
    N f;                // F(r) = W'(r)/r, negative [1/m^(d+2)]
};

/// Wendland C2 of support 2h: W = a (1 - q/2)^4 (2q + 1), F = -5 a / h^2 (1 - q/2)^3, q = r/h,
/// a = 7/(4 pi h^2) in two dimensions, 21/(16 pi h^3) in three (Wendland 1995; Dehnen & Aly 2012).
/// W and F are each scaled so that sum W V = 1 and -sum F x^2 V = 1 on the particle lattice.
struct Kernel {
    real h = 1;       // smoothing length [m]
    real support = 2; // 2h [m]
    real w_scale = 0; // a / S0
    real f_scale = 0; // -5 a / h^2 / A0

    template <class N>
    Pair<N> operator()(const Vec<N>& r) const
    {
        const N distance_squared = dot(r, r);
        const N distance = square_root(distance_squared);
        const N q = distance * (1 / h);
        // Beyond the support the bracket is zero, so far rows and padding contribute exactly
        // nothing.
        const N bracket = positive(N(1 - 0.5 * q));
        const N cube = bracket * bracket * bracket;
        return {r, distance, distance_squared, w_scale * cube * bracket * (2 * q + 1),
                f_scale * cube};
    }
};

/// The kernel of smoothing length h on a lattice of the given spacing.
Kernel make_kernel(real h, real spacing, int dimensions);

} // namespace hyoryu
