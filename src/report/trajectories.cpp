// SPDX-License-Identifier: MIT
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/plan_view.hpp"
#include "sections.hpp"

#include <map>

namespace hyoryu {

namespace {

/// In the order in which the bodies first appear: that of the case.
std::vector<Track> tracks_of(const RunResults& run, View view)
{
    std::vector<Track> tracks;
    if (!run.bodies) {
        return tracks;
    }
    const std::vector<std::string> names = texts_of(*run.bodies, "body");
    const auto& x = numbers_of(*run.bodies, "x");
    const auto& y = numbers_of(*run.bodies, view == View::xy ? "y" : "z");
    std::map<std::string, std::size_t> place;
    for (std::size_t row = 0; row < run.bodies->rows; ++row) {
        const auto [at, is_new] = place.emplace(names[row], tracks.size());
        if (is_new) {
            tracks.push_back({names[row], {}, {}});
        }
        tracks[at->second].x.push_back(x[row]);
        tracks[at->second].y.push_back(y[row]);
    }
    return tracks;
}

} // namespace

std::string track_section(const RunResults& run)
{
    const View view = view_of(run.dimensions());
    const std::vector<Track> tracks = tracks_of(run, view);
    const std::string heading = "<h2>Trajectories of the bodies</h2>\n";
    if (tracks.empty()) {
        return heading + html_paragraph("The case has no bodies.");
    }
    const std::vector<Segment> walls =
        run.structures ? outline(*run.structures, view) : std::vector<Segment>();
    std::string text =
        view == View::xy ? "Seen from above. " : "Seen from the side, in the x-z plane. ";
    text +=
        "Each line is the path of a centre of mass: a ring at the start, a dot at the end. Grey: "
        "the walls at the start.";
    if (tracks.size() > most_names) {
        text += " There are too many bodies to print their names; each line has a tooltip with its "
                "name.";
    }
    return heading + html_paragraph(text) + svg_plan_view(walls, tracks, view);
}

} // namespace hyoryu
