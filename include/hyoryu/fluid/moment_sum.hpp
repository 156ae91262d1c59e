// SPDX-License-Identifier: MIT
// The moments of the particles about one, of which corrected gradients are made.
#pragma once

#include "hyoryu/core/sweep.hpp"

namespace hyoryu {

/// Adds one pair to M_i = -sum_j V_j F r r^T [1]: `step` is V_j F r. The diagonal goes to
/// `Moments`, yz, xz and xy to `MixedMoments`.
template <class N>
void add_moments(const Vec<N>& step, const Vec<N>& r, auto& sum)
{
    sum[field::moments] += Vec<N>{-(step.x * r.x), -(step.y * r.y), -(step.z * r.z)};
    sum[field::mixed_moments] += Vec<N>{-(step.y * r.z), -(step.x * r.z), -(step.x * r.y)};
}

} // namespace hyoryu
