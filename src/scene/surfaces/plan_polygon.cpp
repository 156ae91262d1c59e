// SPDX-License-Identifier: MIT
#include "plan_polygon.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

bool cross_each_other(const Plan2& a, const Plan2& b, const Plan2& c, const Plan2& d)
{
    return cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0;
}

double beyond_edges(const std::vector<Plan2>& a, const std::vector<Plan2>& b)
{
    double best = -infinity;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const Plan2& p = a[k];
        const Plan2& q = a[(k + 1) % a.size()];
        const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
        double nearest = infinity;
        for (const Plan2& other : b) {
            nearest = std::min(nearest, -cross(p, q, other) / length);
        }
        best = std::max(best, nearest);
    }
    return best;
}

} // namespace

Frame2 frame_of(const Ring& ring)
{
    Frame2 frame;
    for (const Plan2& p : ring) {
        for (std::size_t k = 0; k < 2; ++k) {
            frame.low[k] = std::min(frame.low[k], p[k]);
            frame.high[k] = std::max(frame.high[k], p[k]);
        }
    }
    return frame;
}

std::string fault_of_yard(const std::vector<Plan2>& polygon)
{
    const std::size_t n = polygon.size();
    if (n < 3) {
        return fmt::format("a yard needs three corners, this one has {}", n);
    }
    if (n > most_corners) {
        return fmt::format("the yard has {} corners, at most {} are allowed", n, most_corners);
    }
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t m = k + 2; m < n; ++m) {
            if (cross_each_other(polygon[k], polygon[k + 1], polygon[m], polygon[(m + 1) % n])) {
                return fmt::format("the yard crosses itself: its edge from corner {} crosses that "
                                   "from corner {}",
                                   k + 1, m + 1);
            }
        }
    }
    return {};
}

bool may_be_degrees(const std::vector<Plan2>& polygon)
{
    return std::ranges::all_of(
        polygon, [](const Plan2& p) { return std::abs(p[0]) <= 180 && std::abs(p[1]) <= 90; });
}

std::vector<Plan2> hull_of(std::vector<Plan2> points)
{
    std::ranges::sort(points);
    std::vector<Plan2> hull;
    for (int side = 0; side < 2; ++side) { // below, then above (Andrew 1979)
        const std::size_t first = hull.size();
        for (const Plan2& p : points) {
            while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), p) <= 0) {
                hull.pop_back();
            }
            hull.push_back(p);
        }
        hull.pop_back(); // the first one of the other side
        std::ranges::reverse(points);
    }
    return hull;
}

void into_axes_of(const TerrainPatch& patch, std::vector<Plan2>& polygon)
{
    const double azimuth = patch.azimuth_deg * std::numbers::pi / 180;
    for (Plan2& p : polygon) {
        const double east = p[0] - patch.origin[0];
        const double north = p[1] - patch.origin[1];
        // x points along the azimuth, y to the left of it.
        p = {east * std::sin(azimuth) + north * std::cos(azimuth),
             north * std::sin(azimuth) - east * std::cos(azimuth)};
    }
}

bool holds_all(const std::vector<Plan2>& polygon, const std::vector<Plan2>& inner)
{
    for (std::size_t k = 0; k < inner.size(); ++k) {
        if (!holds(polygon, inner[k])) {
            return false;
        }
        for (std::size_t m = 0; m < polygon.size(); ++m) {
            if (cross_each_other(inner[k], inner[(k + 1) % inner.size()], polygon[m],
                                 polygon[(m + 1) % polygon.size()])) {
                return false;
            }
        }
    }
    return true;
}

double apart(const std::vector<Plan2>& a, const std::vector<Plan2>& b)
{
    return std::max(beyond_edges(a, b), beyond_edges(b, a));
}

} // namespace hyoryu
