// SPDX-License-Identifier: MIT
#include "study_figures.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/view/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace hyoryu {

namespace {

double error_of(const StudyResult& result, std::size_t run, std::size_t quantity)
{
    return result.runs[run].values[quantity].error;
}

// A staircase: dearer settings that are no better than the one to their left do not show.
PlotCurve staircase(const StudyResult& result, std::size_t quantity)
{
    PlotCurve curve{
        .label = "best for the cost", .x = {}, .y = {}, .style = PlotCurve::Style::theory};
    for (const std::size_t k : frontier(result, quantity)) {
        if (!curve.y.empty()) {
            curve.x.push_back(result.runs[k].work);
            curve.y.push_back(curve.y.back());
        }
        curve.x.push_back(result.runs[k].work);
        curve.y.push_back(error_of(result, k, quantity));
    }
    return curve;
}

// The ends of the curves, a little wider; VTK's own choice leaves logarithmic axes too tight.
std::vector<double> range_of(const std::vector<PlotCurve>& curves,
                             std::vector<double> PlotCurve::*values)
{
    constexpr double margin = 1.5;
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const PlotCurve& curve : curves) {
        for (const double v : curve.*values) {
            if (v > 0 && std::isfinite(v)) {
                low = std::min(low, v);
                high = std::max(high, v);
            }
        }
    }
    return high > 0 ? std::vector<double>{low / margin, high * margin} : std::vector<double>{};
}

// Room for the legend above the curves, which would hide them.
void make_room(const std::vector<PlotCurve>& curves, std::vector<double>& range)
{
    constexpr double row = 0.045; // of the height
    const auto rows =
        std::ranges::count_if(curves, [](const PlotCurve& curve) { return !curve.label.empty(); });
    const double share = std::min(0.6, row * static_cast<double>(rows) + 0.03);
    if (!range.empty()) {
        range[1] *= std::pow(range[1] / range[0], share / (1 - share));
    }
}

PlotPanel finished(PlotPanel panel)
{
    panel.axes = PlotPanel::Axes::logarithmic;
    panel.x_range = range_of(panel.curves, &PlotCurve::x);
    panel.y_range = range_of(panel.curves, &PlotCurve::y);
    make_room(panel.curves, panel.y_range);
    return panel;
}

PlotCurve cost_curve(const StudyResult& result, const StudySeries& series)
{
    const StudySweep& sweep = result.study.sweeps[series.sweep];
    PlotCurve curve{.label = series.others.empty() ? sweep.name : series.others,
                    .x = {},
                    .y = {},
                    .style = PlotCurve::Style::marked};
    for (const std::size_t k : series.runs) {
        curve.x.push_back(result.runs[k].work);
        curve.y.push_back(error_of(result, k, series.quantity));
    }
    return curve;
}

// Settings without a scale between them: a point each.
void append_points(const StudyResult& result, const StudySeries& series, PlotPanel& panel)
{
    for (const std::size_t k : series.runs) {
        panel.curves.push_back({.label = result.runs[k].run.run.name,
                                .x = {result.runs[k].work},
                                .y = {error_of(result, k, series.quantity)},
                                .style = PlotCurve::Style::points});
    }
}

PlotPanel cost_panel(const StudyResult& result, std::size_t quantity)
{
    PlotPanel panel{.title = "error against cost",
                    .x_axis = "cost [" + result.work_unit + "]",
                    .y_axis = "relative error",
                    .curves = {}};
    const auto& sweeps = result.study.sweeps;
    // The sweeps of a grid share their runs: the first sweep of numbers shows all of them.
    const bool is_grid = result.study.mode == Study::Mode::grid;
    const auto first = std::ranges::find_if(sweeps, &StudySweep::numeric);
    const auto shown = static_cast<std::size_t>(first - sweeps.begin()) % sweeps.size();
    for (const StudySeries& series : result.series) {
        if (series.quantity != quantity || (is_grid && series.sweep != shown)) {
            continue;
        }
        if (sweeps[series.sweep].numeric()) {
            panel.curves.push_back(cost_curve(result, series));
        } else {
            append_points(result, series, panel);
        }
    }
    panel.curves.push_back(staircase(result, quantity));
    return finished(std::move(panel));
}

PlotPanel sweep_panel(const StudyResult& result, std::size_t quantity, std::size_t sweep)
{
    const StudySweep& s = result.study.sweeps[sweep];
    PlotPanel panel{.title = "error against " + s.label(),
                    .x_axis = s.name,
                    .y_axis = "relative error",
                    .curves = {}};
    for (const StudySeries& series : result.series) {
        if (series.quantity != quantity || series.sweep != sweep) {
            continue;
        }
        PlotCurve curve{
            .label = series.others, .x = {}, .y = {}, .style = PlotCurve::Style::marked};
        if (series.order) {
            curve.label += fmt::format("{}order {:.2f}", curve.label.empty() ? "" : ", ",
                                       series.order->exponent);
        }
        for (const std::size_t k : series.runs) {
            const auto value = static_cast<std::size_t>(result.runs[k].run.value_of[sweep]);
            curve.x.push_back(std::get<double>(s.values[value]));
            curve.y.push_back(error_of(result, k, quantity));
        }
        panel.curves.push_back(std::move(curve));
    }
    return finished(std::move(panel));
}

std::string file_of(const std::string& quantity, std::size_t sheet)
{
    std::string name;
    for (const unsigned char c : quantity) {
        name += std::isalnum(c) != 0 ? static_cast<char>(std::tolower(c)) : '_';
    }
    return sheet == 0 ? fmt::format("study_{}.png", name)
                      : fmt::format("study_{}_{}.png", name, sheet + 1);
}

std::vector<PlotPanel> panels_of(const StudyResult& result, std::size_t quantity)
{
    std::vector<PlotPanel> panels{cost_panel(result, quantity)};
    for (std::size_t s = 0; s < result.study.sweeps.size(); ++s) {
        const StudySweep& sweep = result.study.sweeps[s];
        if (sweep.numeric() && sweep.values.size() > 1) {
            panels.push_back(sweep_panel(result, quantity, s));
        }
    }
    return panels;
}

// Logarithmic axes show what is above zero: without any of it a picture would be blank.
bool shows_anything(const std::vector<PlotPanel>& panels)
{
    return std::ranges::any_of(panels,
                               [](const PlotPanel& panel) { return !panel.y_range.empty(); });
}

} // namespace

StudyPictures draw_study(const StudyResult& result, const std::filesystem::path& folder)
{
    constexpr std::size_t panels_of_a_sheet = 3; // more side by side are too small to read
    StudyPictures pictures;
    for (std::size_t q = 0; q < result.study.quantities.size(); ++q) {
        const std::string& name = result.study.quantities[q].name;
        const std::vector<PlotPanel> panels = panels_of(result, q);
        if (!shows_anything(panels)) {
            pictures.notes.push_back(
                fmt::format("{} is not drawn: no run has an error above zero", file_of(name, 0)));
            continue;
        }
        for (std::size_t at = 0; at < panels.size(); at += panels_of_a_sheet) {
            const auto end = std::min(at + panels_of_a_sheet, panels.size());
            const Plot plot{.title = result.study.title + ": " + name,
                            .panels = {panels.begin() + static_cast<std::ptrdiff_t>(at),
                                       panels.begin() + static_cast<std::ptrdiff_t>(end)}};
            const std::string file = file_of(name, at / panels_of_a_sheet);
            // A picture that cannot be made takes nothing from the tables.
            try {
                draw(plot, folder / file);
                pictures.files.push_back(file);
            } catch (const IoError& error) {
                pictures.notes.push_back(fmt::format("{} is not drawn: {}", file, error.what()));
            }
        }
    }
    return pictures;
}

} // namespace hyoryu
