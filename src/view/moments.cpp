// SPDX-License-Identifier: MIT
// Finds the frames of a run and measures their extent and ranges.
#include "moments.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/io/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t frames_surveyed = 16;
constexpr std::size_t points_surveyed = 20000; // of a frame
constexpr double outliers = 0.002;             // share of points at each end that a bound ignores

void add_series(const fs::path& results, const std::string& name, fs::path Moment::*member,
                std::map<std::string, Moment>& moments)
{
    const fs::path series = results / (name + ".hdf.series");
    if (!fs::exists(series)) {
        return;
    }
    for (const SeriesEntry& entry : read_series(series)) {
        Moment& moment = moments[frame_number(entry)];
        moment.time = entry.time;
        moment.number = frame_number(entry);
        moment.*member = results / entry.file;
    }
}

std::vector<Moment> nearest(const std::vector<Moment>& all, const std::vector<double>& times)
{
    std::vector<Moment> chosen;
    for (const double time : times) {
        chosen.push_back(all[nearest_in_time(all, time)]);
    }
    return chosen;
}

/// Numbers at a constant stride, so that at most `points_surveyed` remain.
std::vector<float> thinned(std::span<const float> values, std::size_t offset, std::size_t stride)
{
    const std::size_t step = stride * (1 + values.size() / stride / points_surveyed);
    std::vector<float> result;
    for (std::size_t i = offset; i < values.size(); i += step) {
        result.push_back(values[i]);
    }
    return result;
}

double quantile(std::vector<float>& values, double share)
{
    const double place = share * static_cast<double>(values.size() - 1);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(values.begin(), middle, values.end());
    return static_cast<double>(*middle);
}

/// Bounds without the few particles that a splash throws far away.
Box bounds_of(std::span<const float> points)
{
    Box box;
    if (points.empty()) {
        return box;
    }
    Vec3 low;
    Vec3 high;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<float> values = thinned(points, static_cast<std::size_t>(axis), 3);
        low[axis] = quantile(values, outliers);
        high[axis] = quantile(values, 1 - outliers);
    }
    return {low, high};
}

Box all_of(std::span<const float> points)
{
    Box box;
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
        box.extend(Eigen::Vector3f(points[i], points[i + 1], points[i + 2]).cast<double>());
    }
    return box;
}

/// Median distance of some points to their nearest neighbours.
double spacing_of(std::span<const float> points)
{
    constexpr std::size_t probes = 101;
    const std::size_t count = points.size() / 3;
    const auto point = [&](std::size_t i) {
        return Eigen::Vector3f(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
    };
    std::vector<float> distances;
    for (std::size_t i = 0; i < count; i += 1 + count / probes) {
        float best = std::numeric_limits<float>::max();
        for (std::size_t j = 0; j < count; ++j) {
            best = j == i ? best : std::min(best, (point(j) - point(i)).squaredNorm());
        }
        distances.push_back(std::sqrt(best));
    }
    return count > 1 ? quantile(distances, 0.5) : 0.0;
}

/// The particle size from its volume where the run wrote volumes; else from the distances.
double spacing_of(const Cloud& cloud, bool flat)
{
    std::vector<float> volumes = magnitudes(cloud, "Volume");
    if (volumes.empty()) {
        return spacing_of(cloud.points);
    }
    const double volume = quantile(volumes, 0.5);
    return flat ? std::sqrt(volume) : std::cbrt(volume);
}

/// Two significant digits upwards: a scale that a reader can divide in his head.
double rounded_up(double value)
{
    if (!(value > 0)) {
        return 1;
    }
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1);
    return std::ceil(value / unit) * unit;
}

const Column* find_column(const std::vector<Column>& columns, const std::string& name)
{
    const auto found = std::ranges::find(columns, name, &Column::name);
    return found == columns.end() ? nullptr : &*found;
}

void survey_colour(const Cloud& fluid, const std::string& colour, std::vector<float>& sample,
                   Survey& survey)
{
    const std::vector<float> values = magnitudes(fluid, colour);
    const std::vector<float> some = thinned(values, 0, 1);
    sample.insert(sample.end(), some.begin(), some.end());
    if (const Column* column = find_column(fluid.columns, colour)) {
        survey.unit = column->unit;
    }
}

void survey_moment(const Moment& moment, const std::string& colour, std::vector<float>& sample,
                   Survey& survey)
{
    if (!moment.fluid.empty()) {
        const Cloud fluid = read_frame(moment.fluid);
        survey.inner.extend(bounds_of(fluid.points));
        survey_colour(fluid, colour, sample, survey);
    }
    if (!moment.surfaces.empty()) {
        survey.inner.extend(all_of(read_surface(moment.surfaces).points));
    } else if (!moment.bodies.empty()) {
        survey.inner.extend(all_of(read_frame(moment.bodies).points));
    }
}

void choose_range(std::vector<float>& sample, Survey& survey)
{
    constexpr double foam = 0.98; // the fastest two percent share the last colour
    if (sample.empty()) {
        return;
    }
    survey.colour_max = rounded_up(quantile(sample, foam));
    const double low = quantile(sample, 1 - foam);
    survey.colour_min = low < 0 ? -rounded_up(-low) : 0.0;
}

int digits_between(const std::vector<Moment>& moments)
{
    double gap = 1;
    for (std::size_t k = 1; k < moments.size(); ++k) {
        gap = std::min(gap, std::abs(moments[k].time - moments[k - 1].time));
    }
    return std::clamp(static_cast<int>(std::ceil(-std::log10(std::max(gap, 1e-6)) - 1e-6)), 2, 6);
}

} // namespace

std::vector<std::int32_t> indices_in(const std::vector<Column>& columns, const std::string& name)
{
    const Column* column = find_column(columns, name);
    const auto* values =
        column == nullptr ? nullptr : std::get_if<std::vector<std::int32_t>>(&column->values);
    return values == nullptr ? std::vector<std::int32_t>{} : *values;
}

std::vector<float> magnitudes(const Cloud& cloud, const std::string& name)
{
    const Column* column = find_column(cloud.columns, name);
    if (column == nullptr) {
        return {};
    }
    const auto width = static_cast<std::size_t>(column->components);
    return std::visit(
        [&](const auto& values) {
            std::vector<float> result;
            result.reserve(values.size() / width);
            for (std::size_t row = 0; row + width <= values.size(); row += width) {
                double sum = 0;
                for (std::size_t k = row; k < row + width; ++k) {
                    sum += sq(static_cast<double>(values[k]));
                }
                const double value = width > 1 ? std::sqrt(sum) : static_cast<double>(values[row]);
                result.push_back(static_cast<float>(value));
            }
            return result;
        },
        column->values);
}

std::vector<Moment> moments_of(const fs::path& results, const std::vector<double>& times)
{
    std::map<std::string, Moment> by_number;
    add_series(results, "fluid", &Moment::fluid, by_number);
    add_series(results, "bodies", &Moment::bodies, by_number);
    add_series(results, "surfaces", &Moment::surfaces, by_number);
    add_series(results, "structures", &Moment::structures, by_number);
    std::vector<Moment> moments;
    for (const auto& [number, moment] : by_number) {
        moments.push_back(moment);
    }
    if (moments.empty()) {
        throw CaseError(fmt::format("`{}` contains no frames to render", results.string()),
                        "give a folder written by `hyoryu run`");
    }
    return times.empty() ? moments : nearest(moments, times);
}

Survey survey_of(const std::vector<Moment>& moments, const Surface& structures,
                 const std::string& colour)
{
    Survey survey;
    std::vector<float> sample;
    Box around = all_of(structures.points);
    const std::size_t step = 1 + (moments.size() - 1) / frames_surveyed;
    for (std::size_t k = 0; k < moments.size(); k += step) {
        survey_moment(moments[k], colour, sample, survey);
        if (!moments[k].structures.empty()) {
            around.extend(all_of(read_surface(moments[k].structures).points));
        }
    }
    choose_range(sample, survey);
    survey.time_digits = digits_between(moments);
    survey.flat = survey.inner.isEmpty() || survey.inner.sizes().y() == 0;
    const Moment& first = moments.front();
    if (!first.fluid.empty()) {
        survey.spacing = spacing_of(read_frame(first.fluid), survey.flat);
    } else if (!first.bodies.empty()) {
        survey.spacing = spacing_of(read_frame(first.bodies), survey.flat);
    }
    survey.bounds = survey.inner;
    survey.bounds.extend(around);
    if (survey.bounds.isEmpty()) {
        throw IoError("the frames contain neither fluid nor bodies");
    }
    return survey;
}

} // namespace hyoryu
