// SPDX-License-Identifier: MIT
#include "hyoryu/report/html.hpp"
#include "sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

using Align = HtmlTable::Align;

constexpr std::size_t most_rows = 20;

bool has_force(const std::vector<Impact>& impacts)
{
    return std::any_of(impacts.begin(), impacts.end(),
                       [](const Impact& impact) { return std::isfinite(impact.stiffness); });
}

std::string impact_table(const RunResults& run, const ImpactGroup& group)
{
    const bool between = group.structure.empty();
    const bool force = has_force(group.impacts);
    const auto unit = [&](const char* what, const char* of) {
        return fmt::format("{} [{}]", what, run.per_width(of));
    };
    HtmlTable table{.heads = {{"time [s]", Align::right},
                              {between ? "bodies" : "body"},
                              {"approach speed [m/s]", Align::right},
                              {unit("normal impulse", "N s"), Align::right},
                              {unit("effective mass", "kg"), Align::right},
                              {unit("energy lost", "J"), Align::right}},
                    .rows = {}};
    if (force) {
        table.heads.push_back({unit("u sqrt(k m)", "N"), Align::right});
    }
    for (const Impact& i : largest(group.impacts, most_rows)) {
        table.rows.push_back({fmt::format("{:.6g}", i.time),
                              between ? i.body + ", " + i.other : i.body, readable(i.speed),
                              readable(i.impulse), readable(i.mass), readable(i.energy_lost)});
        if (force) {
            table.rows.back().push_back(readable(peak_force(i)));
        }
    }
    return html_table(table);
}

std::string totals(const RunResults& run, const ImpactGroup& group)
{
    double impulse = 0, energy = 0;
    for (const Impact& impact : group.impacts) {
        impulse += impact.impulse;
        energy += impact.energy_lost;
    }
    const std::size_t count = group.impacts.size();
    std::string text =
        fmt::format("{} impact{}; normal impulses together {} {}, energy lost {} {}.", count,
                    count == 1 ? "" : "s", readable(impulse), run.per_width("N s"),
                    readable(energy), run.per_width("J"));
    if (count > most_rows) {
        text += fmt::format(" The {} with the largest impulses:", most_rows);
    }
    return html_paragraph(text);
}

std::string group_text(const RunResults& run, const ImpactGroup& group)
{
    const std::string title = group.structure.empty() ? "Between bodies" : "On " + group.structure;
    const std::string heading = fmt::format("<h3>{}</h3>\n", escaped(title));
    return group.impacts.empty() ? heading + html_paragraph("No impact.")
                                 : heading + totals(run, group) + impact_table(run, group);
}

std::string force_text(const RunResults& run, const DeclaredStiffness& declared, bool any)
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
        "contact "
        "stiffness approach of ASCE 7): approach speed u, effective mass m, and the contact "
        "stiffness k {}. It is a design formula, no result of the simulation: impulses, not "
        "forces, "
        "are what the simulation computes. A dash: no k for that pair.",
        declared.all ? fmt::format("= {} N/m{} of --stiffness", readable(*declared.all), width)
                     : "that the case declares for the two materials");
}

} // namespace

std::string impact_section(const RunResults& run, std::optional<double> stiffness)
{
    const std::string heading = "<h2>Impacts</h2>\n";
    if (!run.contacts) {
        return heading + html_paragraph("The case has no contact.");
    }
    DeclaredStiffness declared = run.stiffness;
    declared.all = stiffness;
    const std::vector<Impact> impacts = read_impacts(*run.contacts, declared);
    std::string text =
        heading +
        html_paragraph("A row is one contact point of an impact: a face that meets a wall flat has "
                       "several at one time, each with its impulse and with the effective mass 1 / "
                       "(n K n) of the body at that point. Resting and sliding contact is not "
                       "listed. All rows are in contacts.csv.") +
        html_paragraph(force_text(run, declared, has_force(impacts)));
    for (const ImpactGroup& group : by_structure(impacts, run.walls)) {
        text += group_text(run, group);
    }
    return text;
}

} // namespace hyoryu
