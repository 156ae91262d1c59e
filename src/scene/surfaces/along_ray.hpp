// SPDX-License-Identifier: MIT
// Sign changes along a line of a function with Lipschitz constant 1, such as the distance from a
// surface. The bracket is closed by regula falsi.
#pragma once

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

/// A line from a point along an axis.
struct AxisRay {
    Vec3 from{0, 0, 0};
    Vec3 along{0, 0, 1};
    Vec3 at(double s) const { return from + s * along; }
};

/// Narrows a bracket [from, to] of a sign change on a ray to `narrow` [m] and returns its far end,
/// by regula falsi (Illinois, Dowell and Jarratt 1971). Trial places keep half of `narrow` from
/// both ends, so that the bracket closes from both sides.
double narrowed(const AxisRay& ray, double from, double to, double narrow, const auto& value)
{
    constexpr int most = 40; // a bracket as narrow as the numbers are fine shrinks no more
    double low = value(ray.at(from));
    double high = value(ray.at(to));
    const bool positive = low > 0;
    int kept = 0; // which end was kept the last time
    for (int k = 0; k < most && to - from > narrow; ++k) {
        const double falsi = from + (to - from) * low / (low - high);
        const double s = std::clamp(falsi, from + narrow / 2, to - narrow / 2);
        const double v = value(ray.at(s));
        const bool is_before = (v > 0) == positive;
        (is_before ? from : to) = s;
        (is_before ? low : high) = v;
        const int keeps = is_before ? 1 : -1;
        if (keeps == kept) {
            (is_before ? high : low) /= 2;
        }
        kept = keeps;
    }
    return to;
}

/// The next place on a ray, from s on, at which a function with Lipschitz constant 1 changes its
/// sign; `end` if there is none.
double next_change(const AxisRay& ray, double s, double end, double least, const auto& value)
{
    constexpr double narrow = 1e-10; // of the least step
    const bool positive = value(ray.at(s)) > 0;
    double before = s;
    while (s < end) {
        const double v = value(ray.at(s));
        if ((v > 0) != positive) {
            return narrowed(ray, before, s, narrow * least, value);
        }
        before = s;
        s += std::max(std::abs(v), least);
    }
    return end;
}

} // namespace hyoryu
