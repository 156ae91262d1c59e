// SPDX-License-Identifier: MIT
// The pressure between fluid and solids with the corrected gradient.
#pragma once

#include "hyoryu/fluid/gradient.hpp"

namespace hyoryu {

/// F_i = -sum_j V_i V_j (p_j B_i + p_i B_j) F r between a fluid and a solid particle, B = 1 of
/// solids, only where both are under pressure as in `WallPressureForce`: fluid beside a bed has the
/// gradient of a linear pressure, too. The force on the solid is the opposite, bit for bit: one of
/// the two corrections is zero.
struct CorrectedWallForce {
    static constexpr std::string_view name = "corrected_wall_pressure";
    using Reads = CorrectedGradient::Reads;
    using Writes = Fields<Force>;

    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        const N p_i = positive(i[field::pressure]);
        const N p_j = positive(j[field::pressure]);
        const N both = p_i * p_j;
        const Vec<N> of_i =
            times<N>(i[field::gradient_correction], i[field::mixed_correction], ij.r);
        const Vec<N> of_j =
            times<N>(j[field::gradient_correction], j[field::mixed_correction], ij.r);
        const N sum_of_both = where_positive(both, N(p_i + p_j));
        const Vec<N> corrected =
            where_positive(both, p_j) * of_i + where_positive(both, p_i) * of_j;
        sum[field::force] +=
            (-(i[field::volume] * j[field::volume]) * ij.f) * (sum_of_both * ij.r + corrected);
    }
};

} // namespace hyoryu
