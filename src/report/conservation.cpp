// SPDX-License-Identifier: MIT
// Energy and momentum over time, and their conservation errors.
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/svg.hpp"
#include "sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

using Values = std::vector<double>;

constexpr std::array energy_names{"fluid_kinetic", "fluid_potential", "fluid_internal",
                                  "body_kinetic",  "body_potential",  "contact_loss"};

const Values& column(const RunResults& run, const std::string& name)
{
    return numbers_of(run.energy, name);
}

Values change(const Values& values)
{
    Values out = values;
    for (double& value : out) {
        value -= values.front();
    }
    return out;
}

double largest_magnitude(const Values& values)
{
    double largest_ = 0;
    for (const double value : values) {
        largest_ = std::max(largest_, std::abs(value));
    }
    return largest_;
}

void add(Values& sum, const Values& values, double factor)
{
    for (std::size_t k = 0; k < sum.size(); ++k) {
        sum[k] += factor * values[k];
    }
}

/// A column that not every run has: zero where it is missing.
Values optional_column(const RunResults& run, const std::string& name)
{
    const CsvTable::Column* found = run.energy.find(name);
    return found == nullptr ? Values(run.energy.rows, 0.0) : found->numbers;
}

std::string energy_text(const RunResults& run, double remainder, double scale)
{
    const std::string closing = fmt::format(
        "At the end the sum is {} {}, {} of the largest change of a single term. ",
        readable(remainder), run.per_width("J"), scale > 0 ? readable(remainder / scale) : "–");
    const bool fluid = run.plan.at("counts").at("fluid").get<std::int64_t>() > 0;
    return html_paragraph(
        "Each line is the change since the start; contact loss is the energy dissipated by impacts "
        "and friction, and the energy of lost fluid is the sum of its kinetic and potential "
        "energy. " +
        closing +
        (fluid
             ? "With a fluid it is not zero: the dissipation by viscosity, physical and numerical, "
               "and the work of moving walls are not shown as separate lines and are part of the "
               "sum."
             : "Without a fluid it is the closure error of the run plus the work of moving walls, "
               "if there are any."));
}

std::string energy_balance(const RunResults& run, const Values& time)
{
    Chart chart{.title = "energy: change since the start",
                .x_axis = "time [s]",
                .y_axis = fmt::format("energy [{}]", run.per_width("J")),
                .lines = {},
                .width = 640,
                .height = 360};
    Values sum(time.size());
    double scale = 0;
    const auto add_line = [&](const std::string& label, const Values& values, double factor) {
        add(sum, values, factor);
        if (largest_magnitude(values) > 0) {
            chart.lines.push_back({label, time, values});
        }
    };
    for (const std::string name : energy_names) {
        const Values values = change(column(run, name));
        scale = std::max(scale, largest_magnitude(values));
        std::string label = name;
        std::replace(label.begin(), label.end(), '_', ' ');
        add_line(label, values, 1);
    }
    add_line("came in through open sides", change(optional_column(run, "open_energy")), -1);
    add_line("left the domain", optional_column(run, "lost_energy"), 1);
    chart.lines.push_back({"sum", time, sum});
    return "<h3>Energy</h3>\n" + svg_chart(chart) + energy_text(run, sum.back(), scale);
}

/// Change of momentum, with that of lost fluid, less the impulses of walls, gravity and open sides.
Values unexplained(const RunResults& run, char axis)
{
    const auto of = [&](const char* name) { return column(run, fmt::format("{}_{}", name, axis)); };
    Values rest = change(of("momentum"));
    add(rest, change(of("wall_impulse")), -1);
    add(rest, change(of("gravity_impulse")), -1);
    add(rest, change(optional_column(run, fmt::format("open_impulse_{}", axis))), -1);
    add(rest, optional_column(run, fmt::format("lost_momentum_{}", axis)), 1);
    return rest;
}

double norm(const nlohmann::ordered_json& vector)
{
    return std::hypot(number(vector.at(0)), number(vector.at(1)), number(vector.at(2)));
}

std::string momentum_text(const RunResults& run)
{
    const auto& m = run.summary.at("momentum");
    const nlohmann::ordered_json sides = m.value("open_impulse", nlohmann::ordered_json{0, 0, 0});
    Vec3 rest;
    for (std::size_t k = 0; k < 3; ++k) {
        rest[static_cast<Eigen::Index>(k)] =
            number(m.at("end").at(k)) - number(m.at("start").at(k)) + number(m.at("lost").at(k)) -
            number(m.at("wall_impulse").at(k)) - number(m.at("gravity_impulse").at(k)) -
            number(sides.at(k));
    }
    const double scale =
        std::max({norm(m.at("start")), norm(m.at("end")), norm(m.at("wall_impulse")),
                  norm(m.at("gravity_impulse")), norm(sides)});
    return html_paragraph(fmt::format(
        "Closure error at the end, including the momentum of lost particles: {} {}, {} "
        "of the largest of momentum and impulses of walls, gravity and open sides. Worst of a "
        "single step, relative: {}.",
        readable(rest.norm()), run.per_width("N s"),
        scale > 0 ? readable(rest.norm() / scale) : "–",
        readable(number(m.at("worst_closure_of_a_step")))));
}

std::string momentum_balance(const RunResults& run, const Values& time)
{
    const std::string unit = run.per_width("kg m/s");
    Chart momentum{.title = "momentum of fluid and bodies",
                   .x_axis = "time [s]",
                   .y_axis = fmt::format("momentum [{}]", unit),
                   .lines = {}};
    Chart rest{.title = "momentum not explained by walls, gravity, open sides and lost fluid",
               .x_axis = "time [s]",
               .y_axis = fmt::format("closure error [{}]", unit),
               .lines = {}};
    for (const char axis : run.dimensions() == 2 ? std::string("xz") : std::string("xyz")) {
        const std::string label(1, axis);
        momentum.lines.push_back({label, time, column(run, "momentum_" + label)});
        rest.lines.push_back({label, time, unexplained(run, axis)});
    }
    return "<h3>Momentum</h3>\n<div class=\"grid\">\n" + svg_chart(momentum) + svg_chart(rest) +
           "</div>\n" + momentum_text(run);
}

} // namespace

std::string conservation_section(const RunResults& run)
{
    const Values& time = column(run, "time");
    if (time.empty()) {
        return "<h2>Energy and momentum</h2>\n" + html_paragraph("energy.csv has no rows yet.");
    }
    return "<h2>Energy and momentum</h2>\n" + energy_balance(run, time) +
           momentum_balance(run, time);
}

} // namespace hyoryu
