// SPDX-License-Identifier: MIT
// The exact impulse of one contact with restitution and circular Coulomb friction.
#pragma once

#include "hyoryu/core/types.hpp"

namespace hyoryu {

/// One contact as the solver sees it, in axes (n, t1, t2). Unknowns beyond `size` are zero:
/// 1 without friction, 2 in the plane, 3 in space.
struct Cone {
    Mat3 K = Mat3::Zero();         // inverse mass at the contact [1/kg]
    Mat3 K_inverse = Mat3::Zero(); // of the leading block
    int size = 1;
    double mu = 0;
};

/// Fills K_inverse; a direction in which nothing can move is left out.
void invert(Cone& cone);

struct ConeImpulse {
    Vec3 p{0, 0, 0}; // [N s]
    bool tangential =
        false; // a Painleve configuration: the sticking impulse took the place of sliding
};

/// The impulse p with b_n + (K p)_n = 0, p_n >= 0, |p_t| <= mu p_n, and p_t against the velocity of
/// sliding that is left (Moreau 1988). `b` is the velocity without p, less the wanted normal
/// velocity; `guess` is an earlier impulse, for the direction of sliding.
ConeImpulse cone_impulse(const Cone& cone, const Vec3& b, const Vec3& guess);

/// The same with only one Newton step for the direction of sliding from that of `guess`, for
/// sweeps. The exact impulse is its only fixed point.
ConeImpulse nearer_impulse(const Cone& cone, const Vec3& b, const Vec3& guess);

} // namespace hyoryu
