// SPDX-License-Identifier: MIT
#include "hyoryu/report/plan_view.hpp"

#include "hyoryu/report/html.hpp"
#include "hyoryu/report/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hyoryu {

namespace {

using Corner = std::array<float, 3>;
/// Corners in order, so that both triangles of an edge find it; by place, since faces of a surface
/// need not share corner numbers.
using Edge = std::pair<Corner, Corner>;

Corner corner_of(const Surface& surface, std::size_t k)
{
    const auto at = 3 * static_cast<std::size_t>(surface.triangles[k]);
    return {surface.points[at], surface.points[at + 1], surface.points[at + 2]};
}

Vec3 vector_of(const Corner& corner)
{
    return {corner[0], corner[1], corner[2]};
}

/// The unit normals of the triangles at each edge.
std::map<Edge, std::vector<Vec3>> normals_at_edges(const Surface& surface)
{
    std::map<Edge, std::vector<Vec3>> edges;
    for (std::size_t k = 0; k + 2 < surface.triangles.size(); k += 3) {
        const std::array c{corner_of(surface, k), corner_of(surface, k + 1),
                           corner_of(surface, k + 2)};
        const Vec3 normal =
            (vector_of(c[1]) - vector_of(c[0])).cross(vector_of(c[2]) - vector_of(c[0]));
        if (normal.norm() > 0) {
            for (std::size_t n = 0; n < 3; ++n) {
                const Corner &a = c[n], &b = c[(n + 1) % 3];
                edges[{std::min(a, b), std::max(a, b)}].push_back(normal.normalized());
            }
        }
    }
    return edges;
}

bool is_drawn(const std::vector<Vec3>& normals, const Vec3& towards_viewer)
{
    constexpr double sharp = 0.966; // cos 15 degrees
    return normals.size() != 2 || normals[0].dot(normals[1]) < sharp ||
           normals[0].dot(towards_viewer) * normals[1].dot(towards_viewer) < 0;
}

/// The range of the picture: outline and trajectories.
std::array<Range, 2> ranges_of(const std::vector<Segment>& outline,
                               const std::vector<Trajectory>& trajectories)
{
    std::vector<double> x, y;
    for (const Segment& s : outline) {
        x.insert(x.end(), {s[0], s[2]});
        y.insert(y.end(), {s[1], s[3]});
    }
    std::vector<const std::vector<double>*> xs{&x}, ys{&y};
    for (const Trajectory& trajectory : trajectories) {
        xs.push_back(&trajectory.x);
        ys.push_back(&trajectory.y);
    }
    return {padded(range_of(xs), 0.03), padded(range_of(ys), 0.03)};
}

/// The wider of the two directions decides the scale; the other range grows about its middle.
struct Layout {
    PlotArea area;
    Scale x, y;
    double width = 0, height = 0; // of the whole picture [pixels]
};

Layout layout_of(std::array<Range, 2> ranges)
{
    constexpr double inner_width = 780;
    constexpr double least_height = 120, most_height = 640;
    const double wanted = inner_width * ranges[1].width() / ranges[0].width();
    const double inner_height = std::clamp(wanted, least_height, most_height);
    const double metres = std::max(ranges[0].width() / inner_width, // a pixel
                                   ranges[1].width() / inner_height);
    const auto grown = [&](const Range& range, double pixels) {
        return padded(range, 0.5 * (metres * pixels / range.width() - 1));
    };
    const PlotArea area{64, 64 + inner_width, 10, 10 + inner_height};
    return {.area = area,
            .x = {grown(ranges[0], inner_width), area.left, area.right},
            .y = {grown(ranges[1], inner_height), area.bottom, area.top},
            .width = area.right + 12,
            .height = area.bottom + 38};
}

/// Points nearer than half a pixel to the one before draw nothing new.
std::string path_of(const Trajectory& trajectory, const Layout& at)
{
    constexpr double least = 0.5;
    std::string d;
    double x = 0, y = 0;
    for (std::size_t k = 0; k < trajectory.x.size(); ++k) {
        const double u = at.x(trajectory.x[k]), v = at.y(trajectory.y[k]);
        if (!std::isfinite(u) || !std::isfinite(v) ||
            (!d.empty() && k + 1 < trajectory.x.size() && std::hypot(u - x, v - y) < least)) {
            continue;
        }
        d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? 'M' : 'L', u, v);
        x = u;
        y = v;
    }
    return d;
}

std::string drawn_trajectory(const Trajectory& trajectory, const Layout& at, std::size_t k,
                             std::string_view name)
{
    if (trajectory.x.empty()) {
        return {};
    }
    const std::string stroke = svg_stroke(k);
    return fmt::format("<path class=\"l\" {0} d=\"{1}\"><title>{2}</title></path>"
                       "<circle class=\"l r\" {0} cx=\"{3:.1f}\" cy=\"{4:.1f}\" r=\"3\"/>"
                       "<circle cx=\"{5:.1f}\" cy=\"{6:.1f}\" r=\"3\"/>"
                       "<text x=\"{7:.1f}\" y=\"{8:.1f}\">{9}</text>\n",
                       stroke, path_of(trajectory, at), escaped(trajectory.body),
                       at.x(trajectory.x.front()), at.y(trajectory.y.front()),
                       at.x(trajectory.x.back()), at.y(trajectory.y.back()),
                       at.x(trajectory.x.back()) + 5, at.y(trajectory.y.back()) - 4, escaped(name));
}

std::string drawn_outline(const std::vector<Segment>& outline, const Layout& at,
                          std::string_view style)
{
    std::string d;
    for (const Segment& s : outline) {
        d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", at.x(s[0]), at.y(s[1]), at.x(s[2]),
                         at.y(s[3]));
    }
    return d.empty() ? d : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, d);
}

// From a light to a deep blue.
std::string water_colour(double shade)
{
    const auto mix = [&](double light, double deep) {
        return static_cast<int>(std::lround(light + shade * (deep - light)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(205, 8), mix(228, 69), mix(246, 130));
}

} // namespace

View view_of(int dimensions)
{
    return dimensions == 2 ? View::xz : View::xy;
}

std::vector<Segment> outline(const Surface& surface, View view)
{
    const std::size_t up = view == View::xy ? 1 : 2;
    const Vec3 towards_viewer = view == View::xy ? Vec3(0, 0, 1) : Vec3(0, -1, 0);
    std::set<Segment> segments;
    for (const auto& [edge, normals] : normals_at_edges(surface)) {
        const std::array<double, 2> a{edge.first[0], edge.first[up]};
        const std::array<double, 2> b{edge.second[0], edge.second[up]};
        if (a != b && is_drawn(normals, towards_viewer)) {
            const auto& [first, second] = std::minmax(a, b);
            segments.insert({first[0], first[1], second[0], second[1]});
        }
    }
    return {segments.begin(), segments.end()};
}

std::string svg_scene(const SceneView& scene, View view, const std::string& label)
{
    std::vector<Segment> all = scene.walls;
    all.insert(all.end(), scene.bodies.begin(), scene.bodies.end());
    for (const WaterPatch& p : scene.water) {
        all.push_back({p.x, p.y, p.x + p.width, p.y + p.height});
    }
    const Layout at = layout_of(ranges_of(all, {}));
    std::string text = svg_head(at.width, at.height, label);
    for (const WaterPatch& p : scene.water) {
        text += fmt::format("<rect fill=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                            "height=\"{:.1f}\"/>\n",
                            water_colour(p.shade), at.x(p.x), at.y(p.y + p.height),
                            at.x(p.x + p.width) - at.x(p.x), at.y(p.y) - at.y(p.y + p.height));
    }
    text += svg_axes(at.area, at.x, at.y, "x [m]", view == View::xy ? "y [m]" : "z [m]");
    return text + drawn_outline(scene.walls, at, "w") + drawn_outline(scene.bodies, at, "f") +
           "</svg>\n";
}

std::string svg_plan_view(const std::vector<Segment>& outline,
                          const std::vector<Trajectory>& trajectories, View view)
{
    const Layout at = layout_of(ranges_of(outline, trajectories));
    const char* up = view == View::xy ? "y [m]" : "z [m]";
    std::string text = svg_head(at.width, at.height, "tracks of the bodies");
    text += svg_axes(at.area, at.x, at.y, "x [m]", up);
    text += drawn_outline(outline, at, "w");
    for (std::size_t k = 0; k < trajectories.size(); ++k) {
        const std::string_view name =
            trajectories.size() <= most_names ? trajectories[k].body : std::string_view();
        text += drawn_trajectory(trajectories[k], at, k, name);
    }
    return text + "</svg>\n";
}

} // namespace hyoryu
