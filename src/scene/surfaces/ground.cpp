// SPDX-License-Identifier: MIT
#include "ground.hpp"

#include "plan_polygon.hpp"

#include "hyoryu/scene/triangles.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A face that is steeper than this is a side, not ground (sine of its slope).
constexpr double least_up = 1e-9;

// Sutherland and Hodgman (1974), in plan; heights are interpolated along the edges.
std::vector<Vec3> clipped(std::vector<Vec3> polygon, const Plan2& a, const Plan2& b)
{
    std::vector<Vec3> kept;
    const auto side = [&](const Vec3& p) {
        return (b[0] - a[0]) * (p.y() - a[1]) - (b[1] - a[1]) * (p.x() - a[0]);
    };
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3& p = polygon[k];
        const Vec3& q = polygon[(k + 1) % polygon.size()];
        const double sp = side(p);
        const double sq = side(q);
        if (sp >= 0) {
            kept.push_back(p);
        }
        if ((sp > 0 && sq < 0) || (sp < 0 && sq > 0)) {
            kept.emplace_back(p + sp / (sp - sq) * (q - p));
        }
    }
    return kept;
}

// The walls of a basin that are ground: its floor, in the section a strip below it.
TriangleSurface floor_of(const BasinWall& basin, int dimensions)
{
    BasinWall floor = basin;
    floor.open = {true, true, true, true, basin.open[4], true};
    return triangles_of(Wall{.geometry = floor}, {}, dimensions);
}

TriangleSurface surface_for(const Wall& wall, double far, int dimensions)
{
    if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        return floor_of(*basin, dimensions);
    }
    const auto* plane = std::get_if<PlaneWall>(&wall.geometry);
    if (plane != nullptr && plane->normal.z() <= least_up) {
        return {};
    }
    const Bounds domain{Vec3::Constant(-far), Vec3::Constant(far)};
    return triangles_of(wall, domain, dimensions);
}

} // namespace

Ground::Ground(const std::vector<Wall>& walls, const std::string& on, double far, int dimensions)
    : dimensions_(dimensions)
{
    for (const Wall& wall : walls) {
        if (moves(wall.motion) || (!on.empty() && wall.name != on)) {
            continue;
        }
        const TriangleSurface surface = surface_for(wall, far, dimensions);
        for (const auto& t : surface.triangles) {
            const auto corner = [&](std::size_t k) { return surface.corners[at(t[k])]; };
            add({corner(0), corner(1), corner(2)});
        }
    }
    std::vector<AlignedBox> boxes(triangles_.size());
    for (std::size_t n = 0; n < triangles_.size(); ++n) {
        for (const Vec3& corner : triangles_[n]) {
            boxes[n].add(corner);
        }
    }
    tree_ = tree_over(boxes);
}

void Ground::add(const Triangle& t)
{
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (dimensions_ == 2 || normal.z() > least_up * normal.norm()) {
        triangles_.push_back(t);
    }
}

Ground::Range Ground::range_under(const Ring& footprint) const
{
    auto [low, high] = frame_of(footprint);
    if (dimensions_ == 2) {
        low[1] = -infinity;
        high[1] = infinity;
    }
    std::vector<int> near;
    find_near(tree_, {{low[0], low[1], -infinity}, {high[0], high[1], infinity}}, near);
    Range range;
    for (const int n : near) {
        std::vector<Vec3> polygon(triangles_[at(n)].begin(), triangles_[at(n)].end());
        if (dimensions_ == 2) { // the section: its part between two verticals
            polygon = clipped(polygon, {low[0], 1}, {low[0], 0});
            polygon = clipped(polygon, {high[0], 0}, {high[0], 1});
        }
        for (std::size_t k = 0; dimensions_ == 3 && k < footprint.size(); ++k) {
            polygon = clipped(polygon, footprint[k], footprint[(k + 1) % footprint.size()]);
        }
        for (const Vec3& p : polygon) {
            range.highest = std::max(range.highest, p.z());
            range.lowest = std::min(range.lowest, p.z());
        }
    }
    return range;
}

double Ground::height_at(const Plan2& place) const
{
    // A square of a size that does not count, so that no place falls between two triangles.
    const double e = 1e-9 * (1 + std::abs(place[0]) + std::abs(place[1]));
    return highest_under({{place[0] - e, place[1] - e},
                          {place[0] + e, place[1] - e},
                          {place[0] + e, place[1] + e},
                          {place[0] - e, place[1] + e}});
}

} // namespace hyoryu
