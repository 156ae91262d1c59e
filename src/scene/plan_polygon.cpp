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

// Rings of all polygons below a GeoJSON object.
void collect(const json& object, std::vector<json>& rings)
{
    const std::string type = object.value("type", "");
    if (type == "FeatureCollection") {
        for (const json& feature : object.at("features")) {
            collect(feature, rings);
        }
    } else if (type == "Feature") {
        if (object.at("geometry").is_object()) {
            collect(object.at("geometry"), rings);
        }
    } else if (type == "Polygon") {
        rings.push_back(object.at("coordinates").at(0));
    } else if (type == "MultiPolygon") {
        for (const json& polygon : object.at("coordinates")) {
            rings.push_back(polygon.at(0));
        }
    }
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
    const auto fail = [&](const std::string& fault) -> IoError {
        return IoError(fmt::format("{}: {}", file.string(), fault));
    };
    std::vector<json> rings;
    try {
        constexpr int deepest = 16; // a MultiPolygon in a FeatureCollection has eight levels
        bool too_deep = false;
        const auto is_shallow = [&](int depth, json::parse_event_t, json&) {
            too_deep = too_deep || depth > deepest;
            return depth <= deepest;
        };
        collect(json::parse(bytes_of_file(file, largest_text), is_shallow), rings);
        if (too_deep) {
            throw fail(fmt::format("has more than {} levels, expected one polygon", deepest));
        }
        if (rings.size() != 1) {
            throw fail(fmt::format("has {} polygons, expected one", rings.size()));
        }
        std::vector<Plan2> polygon;
        for (const json& point : rings.front()) {
            polygon.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
        }
        if (polygon.size() > 1 && polygon.front() == polygon.back()) {
            polygon.pop_back();
        }
        return polygon;
    } catch (const json::exception& error) {
        throw fail(fmt::format("is not GeoJSON: {}", error.what()));
    }
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
