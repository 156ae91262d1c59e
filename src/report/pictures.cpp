// SPDX-License-Identifier: MIT
// The scene at its start, at its hardest blow and at its end.
#include "hyoryu/io/results.hpp"
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/plan_view.hpp"
#include "sections.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

std::vector<SeriesEntry> frames_of(const RunResults& run, const char* name)
{
    const std::filesystem::path file = run.folder / fmt::format("{}.hdf.series", name);
    return std::filesystem::exists(file) ? read_series(file) : std::vector<SeriesEntry>();
}

/// The time of the blow with the largest impulse, or half of the run.
double hardest_moment(const RunResults& run, const std::vector<SeriesEntry>& frames)
{
    if (run.contacts) {
        const std::vector<Blow> hardest =
            largest(blows_of(read_contacts(*run.contacts, run.contact)), 1);
        if (!hardest.empty()) {
            return hardest.front().time;
        }
    }
    return 0.5 * (frames.front().time + frames.back().time);
}

/// From the lowest to the highest point of the water at the start.
std::array<double, 2> heights_of(const std::vector<float>& points)
{
    std::array<double, 2> heights{0, 1};
    for (std::size_t k = 2; k < points.size(); k += 3) {
        const double z = points[k];
        heights = k == 2 ? std::array{z, z}
                         : std::array{std::min(heights[0], z), std::max(heights[1], z)};
    }
    return heights;
}

} // namespace

std::string picture_section(const RunResults& run)
{
    const std::string heading = "<h2>Pictures</h2>\n";
    const View view = view_of(run.dimensions());
    const std::vector<SeriesEntry> water = frames_of(run, "fluid");
    const std::vector<SeriesEntry> bodies = frames_of(run, "surfaces");
    const std::vector<SeriesEntry>& frames = water.empty() ? bodies : water;
    if (frames.empty()) {
        return heading + html_paragraph("The folder contains no frames.");
    }
    std::vector<std::size_t> shown{0, nearest_in_time(frames, hardest_moment(run, frames)),
                                   frames.size() - 1};
    shown.erase(std::unique(shown.begin(), shown.end()), shown.end());
    std::array<double, 2> heights{};
    std::string text =
        heading + html_paragraph(view == View::xy
                                     ? "Seen from above, at the start, at the frame nearest to the "
                                       "blow of largest impulse (without blows: half way) and at "
                                       "the end; water is darker where its surface is higher."
                                     : "The x-z plane, at the start, at the frame nearest to the "
                                       "blow of largest impulse (without blows: half way) and at "
                                       "the end.");
    for (const std::size_t k : shown) {
        SceneView scene;
        scene.walls = run.structures ? outline(*run.structures, view) : std::vector<Segment>();
        if (!water.empty()) {
            const Cloud cloud = read_frame(run.folder / water[k].file);
            heights = k == 0 ? heights_of(cloud.points) : heights;
            scene.water = water_patches(cloud.points, run.spacing, view, heights);
        }
        if (!bodies.empty()) {
            scene.bodies = outline(
                read_surface(run.folder / bodies[nearest_in_time(bodies, frames[k].time)].file),
                view);
        }
        const std::string time = fmt::format("t = {:.4g} s", frames[k].time);
        text += fmt::format("<h3>{}</h3>\n", time) + svg_scene(scene, view, "the scene at " + time);
    }
    return text;
}

} // namespace hyoryu
