// SPDX-License-Identifier: MIT
#include "solid.hpp"
#include "compound.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace hyoryu {

namespace {

// Corners of the polygon inscribed in each cap of a rod.
constexpr int cap_corners = 16;
// Two faces are one plane if their unit normals differ by less (the faces of a mesh in single
// precision).
constexpr double coplanar_angle = 1e-5;

Face face_through(const std::vector<Vec3>& corners, std::vector<int> of_face, const Vec3& inside,
                  int dimensions)
{
    Face face;
    const Vec3& c0 = corners[of_face[0]];
    if (dimensions == 2) {
        const Vec3 d = corners[of_face[1]] - c0;
        face.normal = Vec3(d.z(), 0, -d.x()).normalized();
    } else {
        Vec3 sum = Vec3::Zero(); // Newell: twice the area vector, whatever the shape of the polygon
        for (std::size_t k = 0; k < of_face.size(); ++k) {
            const Vec3& next = corners[of_face[(k + 1) % of_face.size()]];
            sum += (corners[of_face[k]] - c0).cross(next - c0);
        }
        face.normal = sum.normalized();
    }
    if (face.normal.dot(c0 - inside) < 0) {
        face.normal = -face.normal;
        std::reverse(of_face.begin(), of_face.end());
    }
    face.offset = face.normal.dot(c0);
    face.corners = std::move(of_face);
    return face;
}

// Corners of a convex planar set in counter-clockwise order about its middle, seen from outside.
std::vector<int> in_order(const std::vector<Vec3>& corners, std::vector<int> set,
                          const Vec3& normal)
{
    Vec3 centre = Vec3::Zero();
    for (const int k : set) {
        centre += corners[k] / static_cast<double>(set.size());
    }
    const Vec3 u = (corners[set[0]] - centre).normalized();
    const Vec3 w = normal.cross(u);
    const auto angle = [&](int k) {
        const Vec3 d = corners[k] - centre;
        return std::atan2(d.dot(w), d.dot(u));
    };
    std::sort(set.begin(), set.end(),
              [&](int k, int m) { return std::pair(angle(k), k) < std::pair(angle(m), m); });
    return set;
}

void merge_coplanar(Solid& solid)
{
    std::vector<Face> merged;
    std::vector<bool> grown;
    for (const Face& face : solid.faces) {
        bool found = false;
        for (std::size_t k = 0; k < merged.size() && !found; ++k) {
            if ((merged[k].normal - face.normal).norm() < coplanar_angle &&
                std::abs(merged[k].offset - face.offset) < coplanar_angle * solid.reach) {
                merged[k].corners.insert(merged[k].corners.end(), face.corners.begin(),
                                         face.corners.end());
                grown[k] = true;
                found = true;
            }
        }
        if (!found) {
            merged.push_back(face);
            grown.push_back(false);
        }
    }
    for (std::size_t k = 0; k < merged.size(); ++k) {
        if (grown[k]) {
            std::vector<int>& set = merged[k].corners;
            std::sort(set.begin(), set.end());
            set.erase(std::unique(set.begin(), set.end()), set.end());
            set = in_order(solid.corners, set, merged[k].normal);
        }
    }
    solid.faces = std::move(merged);
}

void add_sides(Solid& solid, int dimensions)
{
    for (Face& face : solid.faces) {
        const std::size_t n = face.corners.size();
        for (std::size_t k = 0; k < n; ++k) {
            const int i = face.corners[k];
            const int j = face.corners[(k + 1) % n];
            const Vec3 d = solid.corners[j] - solid.corners[i];
            if (dimensions == 2) {
                const Vec3 out = -d.normalized();
                face.sides.push_back({out, out.dot(solid.corners[i]), i, i});
            } else {
                const Vec3 out = d.cross(face.normal).normalized();
                face.sides.push_back({out, out.dot(solid.corners[i]), i, j});
            }
        }
    }
}

void add_edges(Solid& solid)
{
    const int faces = static_cast<int>(solid.faces.size());
    for (int f = 0; f < faces; ++f) {
        for (const Side& side : solid.faces[f].sides) {
            for (int g = f + 1; g < faces; ++g) {
                for (const Side& other : solid.faces[g].sides) {
                    if (side.i == other.j && side.j == other.i) {
                        const Vec3 arc = solid.faces[g].normal.cross(solid.faces[f].normal);
                        solid.edges.push_back({side.i, side.j, f, g, arc});
                    }
                }
            }
        }
    }
}

void add_extent(Solid& solid)
{
    Vec3 low = solid.corners[0];
    Vec3 high = low;
    for (const Vec3& corner : solid.corners) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
        solid.reach = std::max(solid.reach, corner.norm());
    }
    solid.box_centre = 0.5 * (low + high);
    solid.box_half = 0.5 * (high - low);
}

void add_polytope(Solid& solid, const Polytope& shape, int dimensions)
{
    solid.corners = shape.corners;
    add_extent(solid);
    const Vec3 inside = mean_of(solid.corners);
    solid.inside = inside;
    solid.extremes.resize(solid.corners.size());
    std::iota(solid.extremes.begin(), solid.extremes.end(), 0);
    for (const auto& face : faces_of(shape, dimensions)) {
        solid.faces.push_back(face_through(solid.corners, face, inside, dimensions));
    }
    if (dimensions == 3) {
        merge_coplanar(solid);
    }
    add_sides(solid, dimensions);
    if (dimensions == 3) {
        add_edges(solid);
    }
    solid.faces_of_corner.resize(solid.corners.size());
    solid.thickness = solid.reach;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
        solid.thickness =
            std::min(solid.thickness, solid.faces[f].offset - solid.faces[f].normal.dot(inside));
        for (const int k : solid.faces[f].corners) {
            solid.faces_of_corner[k].push_back(static_cast<int>(f));
        }
    }
}

// The two caps of a rod, as the polygons inscribed in their rims.
Polytope caps_of(const Rod& rod)
{
    Polytope caps;
    caps.faces.resize(2);
    for (int k = 0; k < cap_corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / cap_corners;
        const double y = rod.radius * std::cos(angle);
        const double z = rod.radius * std::sin(angle);
        caps.corners.emplace_back(-rod.length / 2, y, z);
        caps.corners.emplace_back(rod.length / 2, y, z);
        caps.faces[0].push_back(2 * k);
        caps.faces[1].push_back(2 * k + 1);
    }
    return caps;
}

} // namespace

std::vector<std::vector<int>> faces_of(const Polytope& shape, int dimensions)
{
    if (dimensions == 3) {
        return shape.faces;
    }
    std::vector<std::vector<int>> edges;
    for (const auto& face : shape.faces) {
        for (std::size_t k = 0; k < (face.size() == 2 ? 1 : face.size()); ++k) {
            edges.push_back({face[k], face[(k + 1) % face.size()]});
        }
    }
    return edges;
}

Vec3 mean_of(const std::vector<Vec3>& points)
{
    Vec3 sum = Vec3::Zero();
    for (const Vec3& point : points) {
        sum += point;
    }
    return sum / static_cast<double>(points.size());
}

Solid solid_of(const ContactShape& shape, int dimensions)
{
    Solid solid;
    if (const auto* ball = std::get_if<Ball>(&shape)) {
        solid.radius = ball->radius;
        solid.middle = ball->middle;
        solid.reach = ball->radius + ball->middle.norm();
        solid.thickness = ball->radius;
        solid.box_half = Vec3::Constant(ball->radius);
    } else if (const auto* rod = std::get_if<Rod>(&shape)) {
        if (dimensions == 2) {
            const Vec3 section(rod->length, 0, 2 * rod->radius);
            return solid_of(moved(box_polytope(section, 2), rod->middle), 2);
        }
        solid.form = Form::rod;
        solid.middle = rod->middle;
        solid.radius = rod->radius;
        solid.half_length = rod->length / 2;
        add_polytope(solid, caps_of(*rod), dimensions);
        solid.reach += rod->middle.norm();
        solid.thickness = std::min(solid.radius, solid.half_length);
    } else if (const auto* polytope = std::get_if<Polytope>(&shape)) {
        solid.form = Form::polytope;
        add_polytope(solid, *polytope, dimensions);
    } else {
        return compound_solid(std::get<Compound>(shape), dimensions);
    }
    return solid;
}

double support(const Solid& solid, const Vec3& n)
{
    if (solid.form == Form::ball) {
        return solid.radius;
    }
    if (solid.form == Form::rod) {
        return solid.half_length * std::abs(n.x()) + solid.radius * std::hypot(n.y(), n.z());
    }
    double farthest = -infinity;
    for (const int corner : solid.extremes) {
        farthest = std::max(farthest, n.dot(solid.corners[corner]));
    }
    return farthest;
}

} // namespace hyoryu
