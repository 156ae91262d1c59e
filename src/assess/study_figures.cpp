// SPDX-License-Identifier: MIT
// The error against the cost and against each number that is swept.
#include "hyoryu/assess/study_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace hyoryu {

namespace {

using Style = ChartLine::Style;

/// Adds a run to a line: its cost, or its value of the sweep, and its error.
void append(ChartLine& line, double x, const StudyResult& result, std::size_t run,
            std::size_t quantity)
{
    line.x.push_back(x);
    line.y.push_back(result.runs[run].values[quantity].error);
}

// A staircase: settings that cost more without being more accurate are omitted.
ChartLine staircase(const StudyResult& result, std::size_t quantity)
{
    ChartLine line{.label = "best for the cost", .x = {}, .y = {}, .style = Style::theory};
    for (const std::size_t k : frontier(result, quantity)) {
        if (!line.y.empty()) {
            line.x.push_back(result.runs[k].work);
            line.y.push_back(line.y.back());
        }
        append(line, result.runs[k].work, result, k, quantity);
    }
    return line;
}

Chart chart_of(const std::string& against, const std::string& x_axis)
{
    return {.title = "error against " + against,
            .x_axis = x_axis,
            .y_axis = "relative error",
            .lines = {},
            .width = 440,
            .height = 340,
            .axes = Scale::Kind::logarithmic};
}

// A line for numbers; settings without a scale between them are a point each.
void append_costs(const StudyResult& result, const StudySeries& series, Chart& chart)
{
    const StudySweep& sweep = result.study.sweeps[series.sweep];
    ChartLine line{.label = series.others.empty() ? sweep.name : series.others,
                   .x = {},
                   .y = {},
                   .style = Style::marked};
    for (const std::size_t k : series.runs) {
        append(line, result.runs[k].work, result, k, series.quantity);
        if (!sweep.numeric()) {
            line.label = result.runs[k].run.run.name;
            line.style = Style::points;
            chart.lines.push_back(std::exchange(line, {}));
        }
    }
    if (sweep.numeric()) {
        chart.lines.push_back(std::move(line));
    }
}

Chart cost_chart(const StudyResult& result, std::size_t quantity)
{
    Chart chart = chart_of("cost", "cost [" + result.work_unit + "]");
    const auto& sweeps = result.study.sweeps;
    // The sweeps of a grid share their runs: the first sweep of numbers shows all of them.
    const bool is_grid = result.study.mode == Study::Mode::grid;
    const auto first = std::ranges::find_if(sweeps, &StudySweep::numeric);
    const auto shown = static_cast<std::size_t>(first - sweeps.begin()) % sweeps.size();
    for (const StudySeries& series : result.series) {
        if (series.quantity == quantity && (!is_grid || series.sweep == shown)) {
            append_costs(result, series, chart);
        }
    }
    chart.lines.push_back(staircase(result, quantity));
    return chart;
}

Chart sweep_chart(const StudyResult& result, std::size_t quantity, std::size_t sweep)
{
    const StudySweep& s = result.study.sweeps[sweep];
    Chart chart = chart_of(s.label(), s.name);
    for (const StudySeries& series : result.series) {
        if (series.quantity != quantity || series.sweep != sweep) {
            continue;
        }
        ChartLine line{.label = series.others, .x = {}, .y = {}, .style = Style::marked};
        if (series.order) {
            line.label += fmt::format("{}order {:.2f}", line.label.empty() ? "" : ", ",
                                      series.order->exponent);
        }
        for (const std::size_t k : series.runs) {
            append(line, number_in(result.study, result.runs[k].run, sweep), result, k, quantity);
        }
        chart.lines.push_back(std::move(line));
    }
    return chart;
}

std::string file_of(const std::string& quantity, std::size_t sheet)
{
    std::string name;
    for (const unsigned char c : quantity) {
        name += std::isalnum(c) != 0 ? static_cast<char>(std::tolower(c)) : '_';
    }
    return fmt::format("study_{}{}.svg", name, sheet == 0 ? "" : fmt::format("_{}", sheet + 1));
}

} // namespace

StudyPictures draw_study(const StudyResult& result)
{
    constexpr std::size_t charts_of_a_sheet = 3; // more side by side are too small to read
    StudyPictures pictures;
    for (std::size_t q = 0; q < result.study.quantities.size(); ++q) {
        const std::string& name = result.study.quantities[q].name;
        const auto has_error = [&](const StudyRunResult& run) {
            return run.values[q].error > 0 && std::isfinite(run.values[q].error);
        };
        if (std::ranges::none_of(result.runs, has_error)) {
            pictures.notes.push_back(
                fmt::format("{} is not drawn: no run has an error above zero", file_of(name, 0)));
            continue;
        }
        std::vector<Chart> charts{cost_chart(result, q)};
        for (std::size_t s = 0; s < result.study.sweeps.size(); ++s) {
            const StudySweep& sweep = result.study.sweeps[s];
            if (sweep.numeric() && sweep.values.size() > 1) {
                charts.push_back(sweep_chart(result, q, s));
            }
        }
        for (std::size_t at = 0; at < charts.size(); at += charts_of_a_sheet) {
            const std::size_t end = std::min(at + charts_of_a_sheet, charts.size());
            const auto begin = charts.begin();
            pictures.files.push_back({file_of(name, at / charts_of_a_sheet),
                                      svg_figure(result.study.title + ": " + name,
                                                 {begin + static_cast<std::ptrdiff_t>(at),
                                                  begin + static_cast<std::ptrdiff_t>(end)})});
        }
    }
    return pictures;
}

} // namespace hyoryu
