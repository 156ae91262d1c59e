// SPDX-License-Identifier: MIT
// The figures of benchmarks, from the files of their runs.
#include "hyoryu/assess/verify_report.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

/// A curve of t alone: the table that gives it its times.
CsvTable times_over(const Range& range)
{
    constexpr std::size_t samples = 2001;
    CsvTable table{.columns = {{"time", std::vector<double>(samples), {}}}, .rows = samples};
    for (std::size_t k = 0; k < samples; ++k) {
        table.columns[0].numbers[k] =
            range.low + range.width() * static_cast<double>(k) / static_cast<double>(samples - 1);
    }
    return table;
}

Series horizontal(const Curve& curve)
{
    Series series = curve.series;
    series.value = curve.x;
    return series;
}

ChartLine line_of(const Benchmark& benchmark, const Panel& panel, const Curve& curve,
                  const fs::path& folder)
{
    const BenchmarkRun* run = find_run(benchmark, curve.run);
    const Scope scope = scope_of(benchmark.definitions, run != nullptr ? *run : BenchmarkRun{});
    if (run == nullptr && !curve.series.file.ends_with(".csv")) {
        const CsvTable times = times_over(*panel.x_range);
        return {curve.label, evaluate(curve.x, scope, times),
                evaluate(curve.series.value, scope, times), curve.style};
    }
    RunFiles files(folder / benchmark.name / curve.run, benchmark.folder);
    return {curve.label, samples(horizontal(curve), scope, files).values,
            samples(curve.series, scope, files).values, curve.style};
}

std::string drawn(const Benchmark& benchmark, const Figure& figure, const fs::path& folder)
{
    std::vector<Chart> charts;
    for (const Panel& panel : figure.panels) {
        charts.push_back({.title = panel.title,
                          .x_axis = panel.x_axis,
                          .y_axis = panel.y_axis,
                          .lines = {},
                          .width = 560,
                          .height = 400,
                          .x_range = panel.x_range,
                          .y_range = panel.y_range});
        for (const Curve& curve : panel.curves) {
            charts.back().lines.push_back(line_of(benchmark, panel, curve, folder));
        }
    }
    return svg_figure(figure.title, charts);
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

} // namespace

DrawnFigures draw_figures(const std::vector<BenchmarkResult>& results, const fs::path& folder)
{
    DrawnFigures figures;
    for (const BenchmarkResult& result : results) {
        for (const Figure& figure : result.benchmark.figures) {
            std::string why = missing_runs(result, figure);
            why = why.empty() ? why : fmt::format("without results of {}", why);
            // A figure that cannot be drawn does not affect the verdicts.
            try {
                if (why.empty()) {
                    figures.files[result.benchmark.name].push_back(
                        {figure.file, drawn(result.benchmark, figure, folder)});
                }
            } catch (const FormulaError& error) {
                why = error.what();
            } catch (const IoError& error) {
                why = error.what();
            }
            if (!why.empty()) {
                figures.notes.push_back(fmt::format("{} is not drawn: {}", figure.file, why));
            }
        }
    }
    return figures;
}

} // namespace hyoryu
