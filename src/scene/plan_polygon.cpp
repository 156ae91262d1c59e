// SPDX-License-Identifier: MIT
#include "plan_polygon.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

using nlohmann::json;

constexpr std::size_t most_corners = 2000;

// What is wrong with a file that is JSON.
struct Fault {
    std::string what;
};

const json& member(const json& object, const char* name)
{
    const auto found = object.is_object() ? object.find(name) : object.end();
    if (!object.is_object() || found == object.end()) {
        throw Fault{fmt::format("an object without \"{}\"", name)};
    }
    return *found;
}

const json& list(const json& object, const char* name)
{
    const json& items = member(object, name);
    if (!items.is_array()) {
        throw Fault{fmt::format("a \"{}\" that is no list", name)};
    }
    return items;
}

// Polygons below a GeoJSON object, each a list of rings.
void collect(const json& object, std::vector<json>& polygons)
{
    const json& type = member(object, "type");
    if (type == "FeatureCollection") {
        for (const json& feature : list(object, "features")) {
            collect(feature, polygons);
        }
    } else if (type == "Feature") {
        if (const json& geometry = member(object, "geometry"); geometry.is_object()) {
            collect(geometry, polygons);
        }
    } else if (type == "Polygon") {
        polygons.push_back(list(object, "coordinates"));
    } else if (type == "MultiPolygon") {
        for (const json& polygon : list(object, "coordinates")) {
            polygons.push_back(polygon);
        }
    }
}

// The outer ring of a polygon.
std::vector<Plan2> ring_of(const json& polygon)
{
    if (!polygon.is_array() || polygon.empty() || !polygon[0].is_array() || polygon[0].empty()) {
        throw Fault{"a polygon without corners"};
    }
    std::vector<Plan2> ring;
    for (const json& point : polygon[0]) {
        if (!point.is_array() || point.size() < 2 || !point[0].is_number() ||
            !point[1].is_number()) {
            throw Fault{fmt::format("a corner that is not [x, y]: number {}", ring.size() + 1)};
        }
        ring.push_back({point[0].get<double>(), point[1].get<double>()});
    }
    if (ring.size() > 1 && ring.front() == ring.back()) {
        ring.pop_back();
    }
    return ring;
}

// "line 3, column 7" of a byte of a text, from 1 on.
std::string place_in(const std::string& text, std::size_t byte)
{
    const std::size_t end = std::min(byte > 0 ? byte - 1 : 0, text.size());
    const auto before = std::string_view(text).substr(0, end);
    const std::size_t last = before.rfind('\n');
    const std::size_t column = last == std::string_view::npos ? end : end - last - 1;
    return fmt::format("line {}, column {}", std::ranges::count(before, '\n') + 1, column + 1);
}

double cross(const Plan2& o, const Plan2& a, const Plan2& b)
{
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

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

std::vector<Plan2> read_polygon(const std::filesystem::path& file)
{
    const std::string text = bytes_of_file(file, largest_text);
    try {
        constexpr int deepest = 16; // a MultiPolygon in a FeatureCollection has eight levels
        bool too_deep = false;
        const auto is_shallow = [&](int depth, json::parse_event_t, json&) {
            too_deep = too_deep || depth > deepest;
            return depth <= deepest;
        };
        const json document = json::parse(text, is_shallow);
        if (too_deep) {
            throw Fault{fmt::format("more than {} levels, expected one polygon", deepest)};
        }
        std::vector<json> polygons;
        collect(document, polygons);
        if (polygons.size() != 1) {
            throw Fault{fmt::format("{} polygons, expected one", polygons.size())};
        }
        return ring_of(polygons.front());
    } catch (const json::parse_error& error) {
        throw IoError(
            fmt::format("{}: is not JSON, see {}", file.string(), place_in(text, error.byte)));
    } catch (const Fault& fault) {
        throw IoError(fmt::format("{}: has {}", file.string(), fault.what));
    }
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

bool holds(const std::vector<Plan2>& polygon, const Plan2& point)
{
    bool inside = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Plan2& a = polygon[k];
        const Plan2& b = polygon[(k + 1) % polygon.size()];
        if ((a[1] > point[1]) != (b[1] > point[1]) &&
            point[0] < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) {
            inside = !inside;
        }
    }
    return inside;
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
