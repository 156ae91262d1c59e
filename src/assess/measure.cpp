// SPDX-License-Identifier: MIT
// The measures of benchmarks: each reduces the samples of a run to one number.
#include "hyoryu/assess/measure.hpp"

#include "hyoryu/assess/fit.hpp"
#include "hyoryu/assess/reflection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace hyoryu {

namespace {

/// The value at a time between two rows; nothing outside of them.
std::optional<double> interpolate(const Samples& s, double time)
{
    // A row that is later by rounding of the clock is still that row.
    const double last = s.t.back();
    const double slack = 1e-12 * std::max(1.0, std::abs(last));
    if (time < s.t.front() - slack || time > last + slack) {
        return std::nullopt;
    }
    const auto above = std::lower_bound(s.t.begin(), s.t.end(), time);
    const auto k = static_cast<std::size_t>(above - s.t.begin());
    if (above == s.t.end()) {
        return s.values.back();
    }
    if (k == 0) {
        return s.values.front();
    }
    const double share = (time - s.t[k - 1]) / (s.t[k] - s.t[k - 1]);
    return s.values[k - 1] + share * (s.values[k] - s.values[k - 1]);
}

Measured at_time(const Samples& s, double time)
{
    if (const auto value = interpolate(s, time)) {
        return {*value, ""};
    }
    return {not_a_number, fmt::format("t = {} s is outside the time range of the rows, {} to {} s",
                                      time, s.t.front(), s.t.back())};
}

struct Extremum {
    double t = 0;
    double value = 0;
};

/// The apex of the parabola through three rows.
Extremum apex(const Samples& s, std::size_t k)
{
    const double a = s.t[k - 1] - s.t[k];
    const double b = s.t[k + 1] - s.t[k];
    const double slope_a = (s.values[k - 1] - s.values[k]) / a;
    const double slope_b = (s.values[k + 1] - s.values[k]) / b;
    const double curvature = (slope_b - slope_a) / (b - a);
    const double slope = slope_a - curvature * a;
    const double shift = -slope / (2 * curvature);
    return {s.t[k] + shift, s.values[k] + (slope + curvature * shift) * shift};
}

/// The `index`-th local maximum; `sign` -1: minimum.
std::optional<Extremum> extremum(const Samples& s, int index, double sign)
{
    int seen = 0;
    for (std::size_t k = 1; k + 1 < s.values.size(); ++k) {
        const double value = sign * s.values[k];
        if (value > sign * s.values[k - 1] && value >= sign * s.values[k + 1] && ++seen == index) {
            return apex(s, k);
        }
    }
    return std::nullopt;
}

/// Times at which the values pass the level.
std::vector<double> passes(const Samples& s, double level)
{
    std::vector<double> times;
    for (std::size_t k = 1; k < s.values.size(); ++k) {
        const double before = s.values[k - 1] - level;
        const double after = s.values[k] - level;
        if ((before < 0) != (after < 0)) {
            times.push_back(s.t[k - 1] + (s.t[k] - s.t[k - 1]) * before / (before - after));
        }
    }
    return times;
}

Measured too_few(std::size_t passes, double level)
{
    return {not_a_number, fmt::format("it crosses {} only {} times", level, passes)};
}

Measured crossing(const Samples& s, double level, int index)
{
    const std::vector<double> times = passes(s, level);
    const auto k = static_cast<std::size_t>(index);
    return k <= times.size() ? Measured{times[k - 1], ""} : too_few(times.size(), level);
}

double integral(const Samples& s)
{
    double sum = 0;
    for (std::size_t k = 1; k < s.t.size(); ++k) {
        sum += (s.t[k] - s.t[k - 1]) * (s.values[k] + s.values[k - 1]) / 2;
    }
    return sum;
}

Measured period(const Samples& s, double level)
{
    const std::vector<double> times = passes(s, level);
    if (times.size() < 3) {
        return too_few(times.size(), level);
    }
    return {2 * (times.back() - times.front()) / static_cast<double>(times.size() - 1), ""};
}

/// The farthest point from the level between each two passes.
std::vector<Extremum> swings(const Samples& s, double level)
{
    const std::vector<double> times = passes(s, level);
    std::vector<Extremum> all;
    for (std::size_t pass = 1; pass < times.size(); ++pass) {
        Extremum farthest;
        for (std::size_t k = 0; k < s.t.size(); ++k) {
            const double distance = std::abs(s.values[k] - level);
            if (s.t[k] > times[pass - 1] && s.t[k] < times[pass] && distance > farthest.value) {
                farthest = {s.t[k], distance};
            }
        }
        if (farthest.value > 0) {
            all.push_back(farthest);
        }
    }
    return all;
}

Measured decay(const Samples& s, double level)
{
    const std::vector<Extremum> all = swings(s, level);
    if (all.size() < 2) {
        return {not_a_number, "fewer than two extrema"};
    }
    std::vector<double> t, y;
    for (const Extremum& e : all) {
        t.push_back(e.t);
        y.push_back(std::log(e.value));
    }
    return {-fit_line(t, y).slope, ""};
}

double mean(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A wave of height H has the standard deviation H / (2 sqrt 2).
double height_of_waves(const std::vector<double>& values)
{
    const double level = mean(values);
    double squares = 0;
    for (const double value : values) {
        squares += (value - level) * (value - level);
    }
    return std::sqrt(8 * squares / static_cast<double>(values.size()));
}

double largest_gain(const std::vector<double>& values)
{
    double lowest = values.front();
    double gain = 0;
    for (const double value : values) {
        lowest = std::min(lowest, value);
        gain = std::max(gain, value - lowest);
    }
    return gain;
}

Measured number_of_extremum(const Quantity& quantity, const Samples& s)
{
    const double sign = quantity.measure == Measure::trough ? -1 : 1;
    const auto found = extremum(s, quantity.index, sign);
    if (!found) {
        return {not_a_number, fmt::format("there is no {} number {}", sign > 0 ? "peak" : "trough",
                                          quantity.index)};
    }
    return {quantity.measure == Measure::peak_time ? found->t : found->value, ""};
}

Measured row_of(const Quantity& quantity, const Samples& s)
{
    const auto row = static_cast<std::size_t>(quantity.index) - 1;
    if (row >= s.values.size()) {
        return {not_a_number, fmt::format("there are only {} rows", s.values.size())};
    }
    return {s.values[row], ""};
}

Measured error_of(Measure measure, const std::vector<double>& differences)
{
    double squares = 0;
    double largest = 0;
    for (const double d : differences) {
        if (std::isnan(d)) {
            return {not_a_number, "some values or expected values are not numbers"};
        }
        squares += d * d;
        largest = std::max(largest, std::abs(d));
    }
    const auto n = static_cast<double>(differences.size());
    return {measure == Measure::rms_error ? std::sqrt(squares / n) : largest, ""};
}

/// Values of a run at the times of other rows, or why it has none there.
struct ValuesAt {
    std::vector<double> values;
    std::string why;
};

ValuesAt values_at(const Samples& run, const Samples& rows, const char* of)
{
    if (run.values.empty() || rows.values.empty()) {
        return {{}, "no row matches"};
    }
    if (std::ranges::adjacent_find(rows.t) != rows.t.end()) {
        return {{},
                fmt::format("two rows of the {} have the same time: check that it has a column "
                            "`time`",
                            of)};
    }
    ValuesAt found;
    for (const double time : rows.t) {
        const auto value = interpolate(run, time);
        if (!value) {
            return {{}, fmt::format("the run has no value at t = {} s of the {}", time, of)};
        }
        found.values.push_back(*value);
    }
    return found;
}

Measured measured(const Quantity& quantity, MadeRun& made)
{
    if (quantity.band) {
        return share_within(quantity, made.scope, made.files);
    }
    if (quantity.waves) {
        return reflection(quantity, made.scope, made.files);
    }
    const auto of = [&](const std::string& value) {
        Series series = quantity.series;
        series.value = value;
        return measure(quantity, made.scope, samples(series, made.scope, made.files));
    };
    const Measured own = of(quantity.series.value);
    if (quantity.since.empty()) {
        return own;
    }
    const Measured start = of(quantity.since);
    return {own.value - start.value, own.why.empty() ? start.why : own.why};
}

/// The reference of the run over time: the same quantity in another run, or a file.
std::optional<Samples> reference_of(const Quantity& quantity, const Expectation& expected,
                                    MadeRun& made, MadeRun* other)
{
    if (other != nullptr) {
        return samples(expanded(quantity.series, other->run, other->scope), other->scope,
                       other->files);
    }
    return expected.reference
               ? std::optional(samples(expanded(*expected.reference, made.run, made.scope),
                                       made.scope, made.files))
               : std::nullopt;
}

} // namespace

Samples within(const Quantity& quantity, const Scope& scope, const Samples& all)
{
    const double infinite = std::numeric_limits<double>::infinity();
    const double from = quantity.from.empty() ? -infinite : evaluate(quantity.from, scope);
    const double until = quantity.until.empty() ? infinite : evaluate(quantity.until, scope);
    Samples kept;
    for (std::size_t k = 0; k < all.t.size(); ++k) {
        if (all.t[k] >= from && all.t[k] <= until) {
            kept.t.push_back(all.t[k]);
            kept.values.push_back(all.values[k]);
        }
    }
    return kept;
}

Measured measure(const Quantity& quantity, const Scope& scope, const Samples& samples)
{
    const Samples s = within(quantity, scope, samples);
    if (quantity.measure == Measure::count) {
        return {static_cast<double>(s.values.size()), ""};
    }
    if (s.values.empty()) {
        return {not_a_number, "no row matches"};
    }
    const std::vector<double>& values = s.values;
    const auto [min, max] = std::ranges::minmax_element(values);
    const auto level = [&] {
        return quantity.level.empty() ? mean(values) : evaluate(quantity.level, scope);
    };
    switch (quantity.measure) {
    case Measure::first:
        return {values.front(), ""};
    case Measure::last:
        return {values.back(), ""};
    case Measure::min:
        return {*min, ""};
    case Measure::max:
        return {*max, ""};
    case Measure::range:
        return {*max - *min, ""};
    case Measure::growth:
        return {*std::ranges::max_element(values) / values.front(), ""};
    case Measure::drift:
        return {values.back() - values.front(), ""};
    case Measure::gain:
        return {largest_gain(values), ""};
    case Measure::mean:
        return {mean(values), ""};
    case Measure::sum:
        return {std::accumulate(values.begin(), values.end(), 0.0), ""};
    case Measure::integral:
        return {integral(s), ""};
    case Measure::at:
        return at_time(s, evaluate(quantity.time, scope));
    case Measure::row:
        return row_of(quantity, s);
    case Measure::peak:
    case Measure::peak_time:
    case Measure::trough:
        return number_of_extremum(quantity, s);
    case Measure::crossing:
        return crossing(s, level(), quantity.index);
    case Measure::period:
        return period(s, level());
    case Measure::decay:
        return decay(s, level());
    case Measure::height:
        return {height_of_waves(values), ""};
    default:
        return {not_a_number, "does not measure a single series"};
    }
}

Measured error_from(const Quantity& quantity, const std::string& expected, const Scope& scope,
                    RunFiles& files)
{
    Series difference = quantity.series;
    difference.value = fmt::format("({}) - ({})", quantity.series.value, expected);
    const Samples s = within(quantity, scope, samples(difference, scope, files));
    return s.values.empty() ? Measured{not_a_number, "no row matches"}
                            : error_of(quantity.measure, s.values);
}

Measured error_from(const Quantity& quantity, const Samples& reference, const Scope& scope,
                    RunFiles& files)
{
    const Samples right = within(quantity, scope, reference);
    ValuesAt found = values_at(samples(quantity.series, scope, files), right, "reference");
    for (std::size_t k = 0; k < found.values.size(); ++k) {
        found.values[k] -= right.values[k];
    }
    return found.why.empty() ? error_of(quantity.measure, found.values)
                             : Measured{not_a_number, found.why};
}

bool is_error_measure(Measure measure)
{
    return measure == Measure::rms_error || measure == Measure::largest_error;
}

Measured share_within(const Quantity& quantity, const Scope& scope, RunFiles& files)
{
    const Samples lower = within(quantity, scope, samples(quantity.band->lower, scope, files));
    Series above = quantity.band->lower;
    above.value = quantity.band->upper;
    const Samples upper = within(quantity, scope, samples(above, scope, files));
    const ValuesAt found = values_at(samples(quantity.series, scope, files), lower, "band");
    double inside = 0;
    for (std::size_t k = 0; k < found.values.size(); ++k) {
        const double value = found.values[k];
        inside += value >= lower.values[k] && value <= upper.values[k] ? 1 : 0;
    }
    return found.why.empty() ? Measured{inside / static_cast<double>(lower.t.size()), ""}
                             : Measured{not_a_number, found.why};
}

Compared compare(const Quantity& quantity, const Expectation& expected, MadeRun& made,
                 MadeRun* other)
{
    Quantity own = quantity;
    own.series = expanded(quantity.series, made.run, made.scope);
    if (own.band) {
        own.band->lower = expanded(own.band->lower, made.run, made.scope);
    }
    const std::optional<Samples> reference = reference_of(quantity, expected, made, other);
    if (is_error_measure(own.measure)) {
        const Measured error = reference
                                   ? error_from(own, *reference, made.scope, made.files)
                                   : error_from(own, expected.formula, made.scope, made.files);
        return {error.value, 0, error.why};
    }
    const Measured got = measured(own, made);
    Measured right{not_a_number, ""};
    if (reference) {
        right = measure(quantity, other != nullptr ? other->scope : made.scope, *reference);
        right.why = right.why.empty() ? "" : "reference: " + right.why;
    } else if (!expected.formula.empty()) {
        right.value = evaluate(expected.formula, made.scope);
    }
    return {got.value, right.value, got.why.empty() ? right.why : got.why};
}

} // namespace hyoryu
