// SPDX-License-Identifier: MIT
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/plan_view.hpp"
#include "sections.hpp"

#include <map>

namespace hyoryu {

namespace {

/// In the order in which the bodies first appear: that of the case.
std::vector<Trajectory> trajectories_of(const RunResults& run, View view)
{
    std::vector<Trajectory> trajectories;
    if (!run.bodies) {
        return trajectories;
    }
    const std::vector<std::string> names = texts_of(*run.bodies, "body");
    const auto& x = numbers_of(*run.bodies, "x");
    const auto& y = numbers_of(*run.bodies, view == View::xy ? "y" : "z");
    std::map<std::string, std::size_t> place;
    for (std::size_t row = 0; row < run.bodies->rows; ++row) {
        const auto [at, is_new] = place.emplace(names[row], trajectories.size());
        if (is_new) {
            trajectories.push_back({names[row], {}, {}});
        }
        trajectories[at->second].x.push_back(x[row]);
        trajectories[at->second].y.push_back(y[row]);
    }
    return trajectories;
}

} // namespace

std::string trajectory_section(const RunResults& run)
{
    const View view = view_of(run.dimensions());
    const std::vector<Trajectory> trajectories = trajectories_of(run, view);
    const std::string heading = "<h2>Trajectories of the bodies</h2>\n";
    if (trajectories.empty()) {
        return heading + html_paragraph("The case has no bodies.");
    }
    const std::vector<Segment> walls =
        run.structures ? outline(*run.structures, view) : std::vector<Segment>();
    std::string text =
        view == View::xy ? "Seen from above. " : "Seen from the side, in the x-z plane. ";
    text +=
        "Each line is the path of a centre of mass: a ring at the start, a dot at the end. Grey: "
        "the walls at the start.";
    if (trajectories.size() > most_names) {
        text += " There are too many bodies to print their names; each line has a tooltip with its "
                "name.";
    }
    return heading + html_paragraph(text) + svg_plan_view(walls, trajectories, view);
}

} // namespace hyoryu
