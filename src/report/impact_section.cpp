// SPDX-License-Identifier: MIT
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/svg.hpp"
#include "hyoryu/report/table.hpp"
#include "sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyoryu {

namespace {

using Align = TextTable::Align;

constexpr std::size_t most_rows = 20;

bool has_force(const std::vector<Blow>& blows)
{
    return std::ranges::any_of(blows,
                               [](const Blow& blow) { return std::isfinite(blow.stiffness); });
}

std::string counted(std::size_t count, const std::string& what)
{
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string place_text(const RunResults& run, const Vec3& place)
{
    return run.dimensions() == 2 ? fmt::format("{}, {}", readable(place.x()), readable(place.z()))
                                 : fmt::format("{}, {}, {}", readable(place.x()),
                                               readable(place.y()), readable(place.z()));
}

std::string blow_table(const RunResults& run, const ContactGroup& group)
{
    const bool between = group.structure.empty();
    const bool force = has_force(group.blows);
    const auto unit = [&](const char* what, const char* of) {
        return fmt::format("{} [{}]", what, run.per_width(of));
    };
    TextTable table{.heads = {{"time [s]", Align::right},
                              {between ? "bodies" : "body"},
                              {"approach speed [m/s]", Align::right},
                              {unit("impulse", "N s"), Align::right},
                              {unit("effective mass", "kg"), Align::right},
                              {unit("energy lost", "J"), Align::right},
                              {"contact points", Align::right},
                              {run.dimensions() == 2 ? "place x, z [m]" : "place x, y, z [m]"}},
                    .rows = {}};
    if (force) {
        table.heads.push_back({unit("u sqrt(k m)", "N"), Align::right});
    }
    for (const Blow& b : largest(group.blows, most_rows)) {
        table.rows.push_back({fmt::format("{:.6g}", b.time),
                              between ? b.body + ", " + b.other : b.body, readable(b.speed),
                              readable(b.impulse), readable(b.mass), readable(b.energy_lost),
                              fmt::format("{}", b.points), place_text(run, b.place)});
        if (force) {
            table.rows.back().push_back(readable(peak_force(b)));
        }
    }
    return html_table(table);
}

/// A stem a blow: time and impulse.
std::string blow_chart(const RunResults& run, const ContactGroup& group)
{
    constexpr double gap = std::numeric_limits<double>::quiet_NaN();
    ChartLine stems;
    for (const Blow& blow : group.blows) {
        stems.x.insert(stems.x.end(), {blow.time, blow.time, gap});
        stems.y.insert(stems.y.end(), {0, blow.impulse, gap});
    }
    return svg_chart(
        {.title = group.structure.empty() ? "blows between bodies" : "blows on " + group.structure,
         .x_axis = "time [s]",
         .y_axis = fmt::format("impulse [{}]", run.per_width("N s")),
         .lines = {std::move(stems)}});
}

std::string blow_totals(const RunResults& run, const ContactGroup& group)
{
    double impulse = 0, energy = 0;
    std::size_t points = 0;
    for (const Blow& blow : group.blows) {
        impulse += blow.impulse;
        energy += blow.energy_lost;
        points += blow.points;
    }
    std::string text =
        fmt::format("{} at {}; total impulse {} {}, energy lost {} {}.",
                    counted(group.blows.size(), "blow"), counted(points, "contact point"),
                    readable(impulse), run.per_width("N s"), readable(energy), run.per_width("J"));
    if (group.blows.size() > most_rows) {
        text += fmt::format(" The {} with the largest impulses:", most_rows);
    }
    return html_paragraph(text);
}

std::string resting_text(const RunResults& run, const RestingSum& resting)
{
    return html_paragraph(
        fmt::format("Resting and sliding contact: total normal impulse {} {}, energy lost {} {}.",
                    readable(resting.impulse), run.per_width("N s"), readable(resting.energy_lost),
                    run.per_width("J")));
}

std::string group_text(const RunResults& run, const ContactGroup& group)
{
    const std::string title = group.structure.empty() ? "Between bodies" : "On " + group.structure;
    const std::string heading = fmt::format("<h3>{}</h3>\n", escaped(title));
    const std::string blows =
        group.blows.empty()
            ? html_paragraph("No blow.")
            : blow_totals(run, group) + blow_table(run, group) + blow_chart(run, group);
    return heading + blows + resting_text(run, group.resting);
}

std::string force_text(const RunResults& run, const DeclaredContact& declared, bool any)
{
    const std::string width = run.dimensions() == 2 ? " per metre of width" : "";
    if (!any) {
        return fmt::format(
            "Peak forces are not estimated: no contact stiffness is declared. `hyoryu report "
            "RESULTS "
            "--stiffness K` (K in N/m{}), or `stiffness` in the `contact.pair` of the materials in "
            "the case, adds a column.",
            width);
    }
    return fmt::format(
        "u sqrt(k m) estimates the peak force by an undamped spring (Haehnel and Daly 2004; "
        "contact stiffness approach of ASCE 7): approach speed u, effective mass m, and the "
        "contact stiffness k {}. It is a design formula, not a result of the simulation, which "
        "computes impulses. A dash means that no k is given for the pair.",
        declared.stiffness
            ? fmt::format("= {} N/m{} of --stiffness", readable(*declared.stiffness), width)
            : "that the case declares for the two materials");
}

/// Energy lost in all contact, blows and resting, beside the sum that the run recorded.
std::string energy_text(const RunResults& run, const std::vector<Impact>& rows)
{
    double energy = 0;
    for (const Impact& row : rows) {
        energy += row.energy_lost;
    }
    return html_paragraph(fmt::format(
        "All contacts, blows and resting, lost {} {}; the run recorded {}.", readable(energy),
        run.per_width("J"), readable(number(run.summary.at("energy").at("contact_loss")))));
}

} // namespace

std::string impact_section(const RunResults& run, std::optional<double> stiffness)
{
    const std::string heading = "<h2>Impacts</h2>\n";
    if (!run.contacts) {
        return heading + html_paragraph("The case has no contact.");
    }
    DeclaredContact declared = run.contact;
    declared.stiffness = stiffness;
    const std::vector<Impact> rows = read_contacts(*run.contacts, declared);
    const std::vector<ContactGroup> groups = by_structure(rows, run.walls);
    const bool force = std::ranges::any_of(
        groups, [](const ContactGroup& group) { return has_force(group.blows); });
    std::string text =
        heading +
        html_paragraph("A row is one blow: all impacts of two partners within 2 sqrt(m / k) of the "
                       "first, or within 10 ms where no stiffness k is declared. The impulse is "
                       "the length of the sum of its impulses, friction included; speed and "
                       "effective mass are those of its largest group of simultaneous impacts, the "
                       "mass being impulse / ((1 + e) speed). The single impacts, one row for each "
                       "contact point, are in contacts.csv.") +
        html_paragraph(force_text(run, declared, force));
    for (const ContactGroup& group : groups) {
        text += group_text(run, group);
    }
    return text + energy_text(run, rows);
}

} // namespace hyoryu
