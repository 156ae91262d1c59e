// SPDX-License-Identifier: MIT
// `[[figure]]` and `[[table]]`: the charts and tables of the runs.
#include "hyoryu/scene/reader_hint.hpp"
#include "reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hyoryu {

namespace {

constexpr std::array<std::string_view, 4> styles{"line", "dashed", "points", "theory"};
constexpr std::array drawn_styles{ChartLine::Style::line, ChartLine::Style::dashed,
                                  ChartLine::Style::points, ChartLine::Style::theory};

/// A plain file name with that end; `.png`, as figures once were, is taken for `.svg`.
std::string read_file_name(Section& section, const std::string& end)
{
    section.require("file");
    std::string name = section.text("file");
    if (end == ".svg" && name.ends_with(".png")) {
        name.replace(name.size() - end.size(), end.size(), end);
    }
    if (section.has("file") &&
        (!name.ends_with(end) || name.find_first_of("/\\") != std::string::npos)) {
        section.error("file", fmt::format("expected a file name that ends in {}", end));
    }
    return name;
}

std::optional<Range> read_range(Section& panel, std::string_view key)
{
    const std::vector<double> range = panel.numbers(key);
    if (range.size() == 2 && range[0] < range[1]) {
        return Range{range[0], range[1]};
    }
    if (panel.has(key)) {
        panel.error(key, "expected [lowest, highest]");
    }
    return std::nullopt;
}

Curve read_curve(Section& section, const std::vector<BenchmarkRun>& runs)
{
    Curve curve;
    section.require("label");
    curve.label = section.text("label");
    curve.run = section.text("run");
    curve.series = read_series(section, "y");
    if (section.has("x")) {
        curve.x = section.expression("x");
    }
    curve.style = drawn_styles[section.choice("style", styles).value_or(0)];
    const auto is_it = [&](const BenchmarkRun& run) { return run.name == curve.run; };
    if (!curve.run.empty() && std::none_of(runs.begin(), runs.end(), is_it)) {
        section.error("run", fmt::format("no run is named \"{}\"", curve.run));
    }
    section.finish();
    return curve;
}

Panel read_panel(Section& section, const std::vector<BenchmarkRun>& runs)
{
    Panel panel;
    panel.title = section.label("title");
    panel.x_axis = section.text("x_axis");
    panel.y_axis = section.text("y_axis");
    panel.x_range = read_range(section, "x_range");
    panel.y_range = read_range(section, "y_range");
    for (Section& curve : section.tables("curve")) {
        panel.curves.push_back(read_curve(curve, runs));
        const bool of_time_alone = panel.curves.back().run.empty() && !curve.has("file");
        if (of_time_alone && !panel.x_range) {
            section.error("x_range", "is missing: a curve that depends on t alone needs it");
        }
    }
    section.finish();
    return panel;
}

SummaryTable::Item read_item(Section& section, const Benchmark& benchmark)
{
    SummaryTable::Item item;
    section.require("check");
    item.check = section.text("check");
    item.label = section.text("label", item.check);
    item.unit = section.text("unit");
    item.scale = section.number("scale", 1);
    std::vector<std::string_view> names;
    for (const Check& check : benchmark.checks) {
        names.push_back(check.name);
    }
    if (std::find(names.begin(), names.end(), item.check) == names.end()) {
        section.error("check", fmt::format("no check is named \"{}\"", item.check),
                      did_you_mean(item.check, names));
    }
    section.finish();
    return item;
}

} // namespace

std::vector<Figure> read_figures(Section& root, const std::vector<BenchmarkRun>& runs)
{
    std::vector<Figure> figures;
    for (Section& section : root.tables("figure")) {
        Figure figure;
        figure.file = read_file_name(section, ".svg");
        figure.title = section.label("title");
        for (Section& panel : section.tables("panel")) {
            figure.panels.push_back(read_panel(panel, runs));
        }
        if (figure.panels.empty()) {
            section.error("panel", "is missing: a figure needs [[figure.panel]]");
        }
        section.finish();
        figures.push_back(std::move(figure));
    }
    return figures;
}

std::vector<SummaryTable> read_summary_tables(Section& root, const Benchmark& benchmark)
{
    std::vector<SummaryTable> tables;
    for (Section& section : root.tables("table")) {
        SummaryTable table;
        table.file = read_file_name(section, ".md");
        table.preface = section.text("preface");
        table.title = section.label("title");
        table.text = section.text("text");
        table.by = section.texts("by");
        for (Section& item : section.tables("column")) {
            table.items.push_back(read_item(item, benchmark));
        }
        section.finish();
        tables.push_back(std::move(table));
    }
    return tables;
}

} // namespace hyoryu
