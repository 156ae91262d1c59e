// SPDX-License-Identifier: MIT
// Wave makers.
#pragma once

#include "hyoryu/core/motion.hpp"

namespace hyoryu {

/// The path of a piston along +x that makes a solitary wave of that height [m] in water of that
/// depth [m]: the paddle moves with the mean velocity of the first-order Boussinesq wave before it,
///   x(t) = H/(k d) tanh(k (c t - x)) + const,  k = sqrt(3 H / (4 d^3)),  c = sqrt(g (d + H)).
/// It begins at time 0 at rest and is cut where tanh is 0.999: stroke sqrt(16 H d / 3), duration
/// 2 (3.80 + H/d) / (k c). Source: Goring (1978), Tsunamis - the propagation of long waves onto a
/// shelf, Caltech report KH-R-38, ch. 3.
Motion solitary_piston(double height, double depth, double gravity);

} // namespace hyoryu
