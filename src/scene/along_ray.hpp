// SPDX-License-Identifier: MIT
// Where a function whose value changes no faster than the place changes its sign on a line: the
// distance from a surface is one.
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

/// The end of a bracket [from, to] of a ray, in which a value takes the other sign, after the
/// bracket was made `narrow` [m]: regula falsi (Illinois, Dowell and Jarratt 1971), whose places
/// keep from the ends by half of that, so that the bracket closes from both of them.
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

/// The next place on a ray, from s on, where a function whose value changes no faster than the
/// place takes the other sign; `end` if there is none.
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
