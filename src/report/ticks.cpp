// SPDX-License-Identifier: MIT
#include "hyoryu/report/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hyoryu {

namespace {

/// Round-off that a multiple of the step may have at the end of a range [steps].
constexpr double slack = 1e-9;

/// Multiples of powers of ten within the range, of each `stride`-th decade.
std::vector<double> marks_in_decades(const Range& range, const std::vector<double>& multiples,
                                     int stride)
{
    std::vector<double> marks;
    const int last = static_cast<int>(std::floor(std::log10(range.high)));
    for (int decade = static_cast<int>(std::floor(std::log10(range.low))); decade <= last;
         ++decade) {
        for (const double multiple : multiples) {
            const double mark = multiple * std::pow(10, decade);
            if (decade % stride == 0 && mark >= range.low && mark <= range.high) {
                marks.push_back(mark);
            }
        }
    }
    return marks;
}

// An axis shorter than a decade has multiples of a step.
std::vector<double> logarithmic_ticks(const Range& range, int at_most)
{
    if (range.high < 4 * range.low) {
        return ticks(range, tick_step(range, at_most));
    }
    const auto fits = [&](const std::vector<double>& marks) {
        return marks.size() <= static_cast<std::size_t>(at_most);
    };
    for (const std::vector<double>& multiples :
         {std::vector<double>{1, 1.5, 2, 3, 4, 5, 7}, {1, 2, 5}, {1, 3}}) {
        const std::vector<double> marks = marks_in_decades(range, multiples, 1);
        if (fits(marks)) {
            return marks;
        }
    }
    int stride = 1;
    while (!fits(marks_in_decades(range, {1}, stride))) {
        ++stride;
    }
    return marks_in_decades(range, {1}, stride);
}

} // namespace

Range range_of(std::span<const std::vector<double>* const> columns)
{
    Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const std::vector<double>* column : columns) {
        for (const double value : *column) {
            if (std::isfinite(value)) {
                range.low = std::min(range.low, value);
                range.high = std::max(range.high, value);
            }
        }
    }
    if (range.low > range.high) {
        return {0, 1};
    }
    // A range that is only round-off of its numbers has no ticks of its own.
    const double largest = std::max(std::abs(range.low), std::abs(range.high));
    if (range.width() <= 1e-12 * largest) {
        const double half = largest > 0 ? 0.5 * largest : 1;
        return {range.low - half, range.high + half};
    }
    return range;
}

Range padded(const Range& range, double share)
{
    const double more = share * range.width();
    return {range.low - more, range.high + more};
}

double tick_step(const Range& range, int at_most)
{
    const double power = std::pow(10.0, std::floor(std::log10(range.width() / at_most)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0}) {
        const double step = factor * power;
        const double first = std::ceil(range.low / step - slack);
        const double last = std::floor(range.high / step + slack);
        if (last - first + 1 <= at_most) {
            return step;
        }
    }
    return 50 * power;
}

std::vector<double> ticks(const Range& range, double step)
{
    std::vector<double> values;
    const double last = std::floor(range.high / step + slack);
    for (double k = std::ceil(range.low / step - slack); k <= last; ++k) {
        values.push_back(k == 0 ? 0 : k * step); // no negative zero
    }
    return values;
}

int axis_exponent(const Range& range)
{
    const double largest = std::max(std::abs(range.low), std::abs(range.high));
    if (largest == 0 || (largest >= 1e-3 && largest < 1e5)) {
        return 0;
    }
    return 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
}

std::string tick_label(double value, double step, int exponent)
{
    const double unit = std::pow(10.0, exponent);
    const int decimals = static_cast<int>(std::ceil(-std::log10(step / unit) - slack));
    return fmt::format("{:.{}f}", value / unit, std::max(decimals, 0));
}

double Scale::operator()(double value) const
{
    const double share = kind == Kind::logarithmic
                             ? std::log(value / from.low) / std::log(from.high / from.low)
                             : (value - from.low) / from.width();
    return at_low + share * (at_high - at_low);
}

std::vector<Tick> ticks_of(const Scale& scale, int at_most)
{
    std::vector<Tick> marks;
    if (scale.kind == Scale::Kind::logarithmic) {
        for (const double value : logarithmic_ticks(scale.from, at_most)) {
            marks.push_back({value, fmt::format("{:.6g}", value)});
        }
        return marks;
    }
    const double step = tick_step(scale.from, at_most);
    for (const double value : ticks(scale.from, step)) {
        marks.push_back({value, tick_label(value, step, axis_exponent(scale.from))});
    }
    return marks;
}

std::vector<std::size_t> rows_to_draw(const std::vector<double>& x, const std::vector<double>& y,
                                      const Range& range, std::size_t bins)
{
    std::vector<std::size_t> rows;
    const auto bin_of = [&](std::size_t row) {
        const double share = (x[row] - range.low) / range.width();
        return std::floor(share * static_cast<double>(bins));
    };
    for (std::size_t begin = 0; begin < x.size();) {
        std::size_t end = begin;
        std::size_t low = begin, high = begin, gap = begin;
        for (; end < x.size() && bin_of(end) == bin_of(begin); ++end) {
            low = y[end] < y[low] || std::isnan(y[low]) ? end : low;
            high = y[end] > y[high] || std::isnan(y[high]) ? end : high;
            gap = std::isnan(y[end]) ? end : gap;
        }
        end = std::max(end, begin + 1); // a time that is not a number is a group of its own
        std::array<std::size_t, 5> kept{begin, low, high, gap, end - 1};
        std::sort(kept.begin(), kept.end());
        rows.insert(rows.end(), kept.begin(), std::unique(kept.begin(), kept.end()));
        begin = end;
    }
    return rows;
}

} // namespace hyoryu
