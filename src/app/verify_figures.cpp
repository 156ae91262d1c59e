// SPDX-License-Identifier: MIT
#include "verify_figures.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/view/plot.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

/// A curve of t alone: the table that gives it its times.
CsvTable times_over(const std::vector<double>& range)
{
    constexpr std::size_t samples = 2001;
    CsvTable table;
    table.columns.push_back({"time", std::vector<double>(samples), {}});
    table.rows = samples;
    for (std::size_t k = 0; k < samples; ++k) {
        table.columns[0].numbers[k] = range[0] + (range[1] - range[0]) * static_cast<double>(k) /
                                                     static_cast<double>(samples - 1);
    }
    return table;
}

Series horizontal(const Curve& curve)
{
    Series series = curve.series;
    series.value = curve.x;
    return series;
}

PlotCurve curve_of(const Benchmark& benchmark, const Panel& panel, const Curve& curve,
                   const fs::path& folder)
{
    PlotCurve drawn{.label = curve.label,
                    .x = {},
                    .y = {},
                    .style = static_cast<PlotCurve::Style>(curve.style)};
    const BenchmarkRun* run = find_run(benchmark, curve.run);
    const Scope scope = scope_of(benchmark, run != nullptr ? *run : BenchmarkRun{});
    if (run == nullptr && !curve.series.file.ends_with(".csv")) {
        const CsvTable times = times_over(panel.x_range);
        drawn.x = evaluate(curve.x, scope, times);
        drawn.y = evaluate(curve.series.value, scope, times);
        return drawn;
    }
    RunFiles files(folder / benchmark.name / curve.run, benchmark.folder);
    drawn.x = samples(horizontal(curve), scope, files).values;
    drawn.y = samples(curve.series, scope, files).values;
    return drawn;
}

Plot plot_of(const Benchmark& benchmark, const Figure& figure, const fs::path& folder)
{
    Plot plot{.title = figure.title, .panels = {}};
    for (const Panel& panel : figure.panels) {
        PlotPanel drawn{.title = panel.title,
                        .x_axis = panel.x_axis,
                        .y_axis = panel.y_axis,
                        .x_range = panel.x_range,
                        .y_range = panel.y_range,
                        .curves = {}};
        for (const Curve& curve : panel.curves) {
            drawn.curves.push_back(curve_of(benchmark, panel, curve, folder));
        }
        plot.panels.push_back(std::move(drawn));
    }
    return plot;
}

/// The runs that the figure shows but that were not made, or that stopped.
std::string missing_runs(const BenchmarkResult& result, const Figure& figure)
{
    std::string missing;
    for (const Panel& panel : figure.panels) {
        for (const Curve& curve : panel.curves) {
            const auto is_it = [&](const RunResult& run) {
                return run.run.name == curve.run && run.error.empty();
            };
            const bool there = std::any_of(result.runs.begin(), result.runs.end(), is_it);
            if (!curve.run.empty() && !there && missing.find(curve.run) == std::string::npos) {
                missing += (missing.empty() ? "" : ", ") + curve.run;
            }
        }
    }
    return missing;
}

void draw_one(const BenchmarkResult& result, const Figure& figure, const fs::path& folder,
              DrawnFigures& drawn)
{
    const std::string missing = missing_runs(result, figure);
    if (!missing.empty()) {
        drawn.notes.push_back(
            fmt::format("{} is not drawn: without results of {}", figure.file, missing));
        return;
    }
    // A picture that cannot be made takes nothing from the verdicts.
    try {
        draw(plot_of(result.benchmark, figure, folder), folder / figure.file);
        drawn.files[result.benchmark.name].push_back(figure.file);
        drawn.notes.push_back(fmt::format("drawn: {}", (folder / figure.file).string()));
    } catch (const FormulaError& error) {
        drawn.notes.push_back(fmt::format("{} is not drawn: {}", figure.file, error.what()));
    } catch (const IoError& error) {
        drawn.notes.push_back(fmt::format("{} is not drawn: {}", figure.file, error.what()));
    }
}

} // namespace

DrawnFigures draw_figures(const std::vector<BenchmarkResult>& results, const fs::path& folder)
{
    DrawnFigures drawn;
    for (const BenchmarkResult& result : results) {
        for (const Figure& figure : result.benchmark.figures) {
            draw_one(result, figure, folder, drawn);
        }
    }
    return drawn;
}

} // namespace hyoryu
