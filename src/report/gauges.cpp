// SPDX-License-Identifier: MIT
// Gauges as small plots: the components of one reading share a plot, every unit has its own.
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/svg.hpp"
#include "sections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

/// The gauge that a column of gauges.csv belongs to: the longest name that begins it.
std::string gauge_of(const std::string& column, const std::vector<std::string>& gauges)
{
    std::string found;
    for (const std::string& gauge : gauges) {
        const bool fits = column == gauge || column.starts_with(gauge + "_");
        found = fits && gauge.size() > found.size() ? gauge : found;
    }
    return found;
}

/// The meaning of a column: the gauge with its part ("house_pressure"), and the component or none.
struct Reading {
    std::string name;
    std::string component;
};

Reading reading_of(const std::string& column, const std::string& gauge)
{
    // The component follows the part and precedes the filter: house_pressure_x, probe_x_mean.
    for (const std::string component : {"x", "y", "z"}) {
        const std::size_t at = column.find("_" + component, gauge.size());
        const std::size_t end = at + 2;
        if (at != std::string::npos && (end == column.size() || column[end] == '_')) {
            return {column.substr(0, at) + column.substr(end), component};
        }
    }
    return {column, ""};
}

/// Whether a column is the mean contact force since the row before: an impulse over the time
/// between rows, whose value depends more on that time than on a force.
bool is_mean_of_contact(const std::string& column, const std::string& gauge)
{
    const std::string rest = column.substr(gauge.size());
    return rest == "_contact_x" || rest == "_contact_y" || rest == "_contact_z";
}

/// The plots of one gauge, in the order of its columns.
std::vector<Chart> charts_of(const RunResults& run, const std::string& gauge)
{
    std::vector<Chart> charts;
    const std::vector<double>& time = numbers_of(*run.gauges, "time");
    for (const CsvTable::Column& column : run.gauges->columns) {
        if (gauge_of(column.name, run.gauge_names) != gauge ||
            is_mean_of_contact(column.name, gauge)) {
            continue;
        }
        const Reading reading = reading_of(column.name, gauge);
        if (run.dimensions() == 2 && reading.component == "y") {
            continue;
        }
        if (charts.empty() || charts.back().title != reading.name) {
            charts.push_back({.title = reading.name,
                              .x_axis = "time [s]",
                              .y_axis = fmt::format("[{}]", column.unit),
                              .lines = {}});
        }
        charts.back().lines.push_back(
            {reading.component, time, numbers_of(*run.gauges, column.name)});
    }
    return charts;
}

/// The description of the gauge in the plan.
std::string what_of(const RunResults& run, const std::string& gauge)
{
    for (const auto& entry : run.plan.at("gauges").at("list")) {
        if (entry.at("name").get<std::string>() == gauge) {
            return entry.at("what").get<std::string>();
        }
    }
    return {};
}

} // namespace

std::string gauge_section(const RunResults& run)
{
    std::string text = "<h2>Gauges</h2>\n";
    if (!run.gauges) {
        return text + html_paragraph("The case has no gauges.");
    }
    for (const std::string& name : run.gauge_names) {
        text += fmt::format("<h3>{}</h3>\n", escaped(name)) + html_paragraph(what_of(run, name)) +
                "<div class=\"grid\">\n";
        for (const Chart& chart : charts_of(run, name)) {
            text += svg_chart(chart);
        }
        text += "</div>\n";
    }
    return text;
}

} // namespace hyoryu
