// SPDX-License-Identifier: MIT
#include "study_figures.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/view/plot.hpp"

#include <fmt/format.h>

#include <cmath>

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

PlotPanel finished(PlotPanel panel)
{
    panel.axes = PlotPanel::Axes::logarithmic;
    panel.x_range = range_of(panel.curves, &PlotCurve::x);
    panel.y_range = range_of(panel.curves, &PlotCurve::y);
    return panel;
}

PlotPanel cost_panel(const StudyResult& result, std::size_t quantity)
{
    PlotPanel panel{.title = "error against cost",
                    .x_axis = "cost [" + result.work_unit + "]",
                    .y_axis = "relative error",
                    .curves = {}};
    for (const StudySeries& series : result.series) {
        if (series.quantity != quantity) {
            continue;
        }
        const StudySweep& sweep = result.study.sweeps[series.sweep];
        PlotCurve curve{.label = sweep.name + (series.others.empty() ? "" : ", " + series.others),
                        .x = {},
                        .y = {},
                        .style = PlotCurve::Style::points};
        for (const std::size_t k : series.runs) {
            curve.x.push_back(result.runs[k].work);
            curve.y.push_back(error_of(result, k, quantity));
        }
        panel.curves.push_back(std::move(curve));
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
    // Errors rise with the number, or fall with it: the legend keeps out of their way.
    if (s.finest == StudySweep::Finest::smallest) {
        panel.legend = PlotPanel::Legend::bottom_right;
    }
    return finished(std::move(panel));
}

std::string file_of(const std::string& quantity)
{
    std::string name;
    for (const unsigned char c : quantity) {
        name += std::isalnum(c) != 0 ? static_cast<char>(std::tolower(c)) : '_';
    }
    return "study_" + name + ".png";
}

} // namespace

StudyPictures draw_study(const StudyResult& result, const std::filesystem::path& folder)
{
    StudyPictures pictures;
    for (std::size_t q = 0; q < result.study.quantities.size(); ++q) {
        Plot plot{.title = result.study.title + ": " + result.study.quantities[q].name,
                  .panels = {cost_panel(result, q)}};
        for (std::size_t s = 0; s < result.study.sweeps.size(); ++s) {
            if (result.study.sweeps[s].numeric()) {
                plot.panels.push_back(sweep_panel(result, q, s));
            }
        }
        const std::string file = file_of(result.study.quantities[q].name);
        // A picture that cannot be made takes nothing from the tables.
        try {
            draw(plot, folder / file);
            pictures.files.push_back(file);
        } catch (const IoError& error) {
            pictures.notes.push_back(fmt::format("{} is not drawn: {}", file, error.what()));
        }
    }
    return pictures;
}

} // namespace hyoryu
