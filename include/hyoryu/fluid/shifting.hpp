// SPDX-License-Identifier: MIT
// Particle shifting: evens out the places of the particles of confined flows.
#pragma once

#include "hyoryu/fluid/stage.hpp"

namespace hyoryu {

/// S_i = sum_j V_j [1 + 0.2 (W/W(dp))^4] F r, which points to where particles are dense; each is
/// moved by -C h |v|max dt S_i, at most 0.05 dp. At a free surface the sum points inwards and the
/// fluid would swell. Source: Sun, Colagrossi, Marrone & Zhang (2017), eq. 17, without a change of
/// velocity.
struct Shifting {
    static constexpr std::string_view name = "shifting";
    using Stage = stage::Crowding;
    using Reads = Fields<Volume>;
    using Writes = Fields<ShiftGradient>;
    real coefficient = 8; // C [1]
    real w_scale = 0;     // 1/W(dp) [m^d]

    template <class N>
    void operator()(const Pair<N>& ij, const auto&, const auto& j, auto& sum) const
    {
        const N w = sq(N(ij.w * w_scale));
        sum[field::shift_gradient] += (j[field::volume] * (1 + 0.2 * (w * w))) * ij.f * ij.r;
    }
};

} // namespace hyoryu
