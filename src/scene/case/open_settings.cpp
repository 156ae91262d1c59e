// SPDX-License-Identifier: MIT
#include "hyoryu/scene/open_settings.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A list of a series at a time; none where it is empty.
std::optional<double> value_at(const OpenSeries& series, const std::vector<double>& values,
                               double time)
{
    if (values.empty()) {
        return std::nullopt;
    }
    const auto after = std::ranges::upper_bound(series.times, time);
    if (after == series.times.begin()) {
        return values.front();
    }
    if (after == series.times.end()) {
        return values.back();
    }
    const auto k = at(after - series.times.begin());
    const double part = (time - series.times[k - 1]) / (series.times[k] - series.times[k - 1]);
    return values[k - 1] + part * (values[k] - values[k - 1]);
}

// The same between the stations of a window.
std::optional<double> between(const std::vector<OpenSeries>& stations, double along, double time,
                              std::vector<double> OpenSeries::*values)
{
    const auto after = std::ranges::upper_bound(stations, along, {}, &OpenSeries::at);
    const OpenSeries& high = after == stations.end() ? stations.back() : *after;
    const OpenSeries& low = after == stations.begin() ? stations.front() : *(after - 1);
    const auto a = value_at(low, low.*values, time);
    const auto b = value_at(high, high.*values, time);
    if (!a || !b || high.at == low.at) {
        return a;
    }
    const double part = std::clamp((along - low.at) / (high.at - low.at), 0.0, 1.0);
    return *a + part * (*b - *a);
}

} // namespace

double OpenSettings::width(int dimensions) const
{
    return dimensions == 2 ? 1 : max[1 - axis()] - min[1 - axis()];
}

AskedFlow asked_at(const OpenSettings& open, double along, double time, const StillWater& still,
                   int dimensions)
{
    AskedFlow asked{.still = still.depth};
    if (open.kind == OpenKind::outflow) {
        asked.free = true;
        return asked;
    }
    asked.level = open.level;
    asked.velocity = open.velocity;
    asked.discharge = open.discharge;
    if (!open.series.empty()) {
        asked.level = between(open.series, along, time, &OpenSeries::levels);
        asked.velocity = between(open.series, along, time, &OpenSeries::velocities);
        asked.discharge = between(open.series, along, time, &OpenSeries::discharges);
    }
    if (open.kind == OpenKind::absorb) {
        asked.level = asked.level.value_or(still.level);
        asked.velocity = asked.velocity.value_or(0);
    }
    if (asked.discharge) {
        *asked.discharge /= open.width(dimensions);
    }
    return asked;
}

double fastest_asked(const OpenSettings& open, double bed, double still, double gravity,
                     int dimensions)
{
    double fastest = 0;
    const auto look = [&](std::optional<double> level, std::optional<double> velocity,
                          std::optional<double> discharge) {
        double h = std::max(level.value_or(bed) - bed, 0.0);
        double u = velocity.value_or(0);
        if (discharge) { // at the critical depth
            const double q = std::abs(*discharge) / open.width(dimensions);
            h = std::cbrt(q * q / gravity);
            u = h > 0 ? q / h : 0;
        } else if (level && !velocity) {
            u = 2 * std::sqrt(gravity * h) - 2 * std::sqrt(gravity * std::max(still - bed, 0.0));
        }
        fastest = std::max(fastest, std::sqrt(u * u + 2 * gravity * h));
    };
    look(open.level, open.velocity, open.discharge);
    for (const OpenSeries& series : open.series) {
        for (std::size_t k = 0; k < series.times.size(); ++k) {
            const auto of = [&](const std::vector<double>& values) {
                return values.empty() ? std::nullopt : std::optional(values[k]);
            };
            look(of(series.levels), of(series.velocities), of(series.discharges));
        }
    }
    return fastest;
}

std::optional<double> highest_asked(const OpenSettings& open)
{
    std::optional<double> highest = open.level;
    for (const OpenSeries& series : open.series) {
        for (const double level : series.levels) {
            highest = std::max(highest.value_or(level), level);
        }
    }
    return highest;
}

} // namespace hyoryu
