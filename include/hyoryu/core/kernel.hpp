// SPDX-License-Identifier: MIT
// The smoothing kernel: Wendland C2, or one that is isotropic on strained lattices; calibrated on
// the particle lattice.
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
    N f;                // F(r), negative [1/m^(d+2)]
};

/// Which kernel gradients are made of. W, which takes means, is that of Wendland in either case.
enum class KernelShape {
    wendland, // F = W'/r
    isotropic // F of a kernel whose sum F r r^T stays isotropic as the particles are strained
};

/// The highest frequency of sound among particles on a lattice, and their largest decay rate by
/// diffusion, over those with the kernel of Wendland [1]: steps are shorter by as much. Sums over
/// square and cubic lattices at a smoothing length of 1.5 spacings, ours.
constexpr double sound_frequency(KernelShape shape)
{
    return shape == KernelShape::isotropic ? 1.065 : 1;
}
constexpr double diffusion_rate(KernelShape shape)
{
    return shape == KernelShape::isotropic ? 1.14 : 1;
}

/// Support 2h, q = r/h, b = 1 - q/2.
/// Wendland C2: W = a b^4 (2q + 1), F = -5 a / h^2 b^3, a = 7/(4 pi h^2) in two dimensions,
/// 21/(16 pi h^3) in three (Wendland 1995; Dehnen & Aly 2012).
/// Isotropic: W as Wendland's, F proportional to b^3 (1 - 6 b + 23.4 b^2 - 31.1 b^3 + 13.9 b^4).
/// With the moments M = -sum V F r r^T of a lattice that is shortened by a strain s along x and
/// stretched along z, M_xx - M_zz = 2 kappa s resists the strain as an elastic body would, at any
/// spacing. At h = 1.5 spacings and s up to 0.2 kappa is 0.012 to 0.022 in a square lattice and
/// -0.009 to 0.008 in a cubic one; with Wendland's F 0.05 to 0.086 and 0.06 to 0.07. Particles form
/// pairs under a kernel whose Fourier transform is negative somewhere (Dehnen & Aly 2012): this
/// one's, by W' = F r, is nowhere below 0.6 of Wendland's, in two and three dimensions. Of the
/// polynomials of fourth degree for which that holds it has nearly the least kappa, found by
/// linear programming. Ours; docs/accuracy.md.
/// W and F are each scaled so that sum W V = 1 and -sum F x^2 V = 1 on the particle lattice.
struct Kernel {
    real h = 1;       // smoothing length [m]
    real support = 2; // 2h [m]
    real w_scale = 0; // a / S0
    real f_scale = 0; // of b^3, negative
    KernelShape shape = KernelShape::wendland;

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
        N f = f_scale * cube;
        if (shape == KernelShape::isotropic) [[unlikely]] { // which costs Wendland's nothing
            const N bend = bracket * (-6 + bracket * (23.4 + bracket * (-31.1 + 13.9 * bracket)));
            f = f_scale * (1 + bend) * cube;
        }
        return {r, distance, distance_squared, w_scale * cube * bracket * (2 * q + 1), f};
    }
};

/// The kernel of smoothing length h on a lattice of the given spacing.
Kernel make_kernel(real h, real spacing, int dimensions, KernelShape shape = KernelShape::wendland);

} // namespace hyoryu
