// SPDX-License-Identifier: MIT
#include "compound.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

// Distance of the test points from a point of a face, and the largest recess of a covering part,
// relative to the reach of the compound.
constexpr double look_aside = 1e-5;
constexpr double touching = 1e-7;
// Tolerance for a direction to equal the normal of a face (1 - cosine).
constexpr double same_direction = 1e-12;

bool holds(const Solid& part, const Vec3& p, double slack)
{
    return std::all_of(part.faces.begin(), part.faces.end(),
                       [&](const Face& face) { return face.normal.dot(p) - face.offset < slack; });
}

// Whether another part of the compound lies directly in front of the face at the point.
bool covered(const Solid& whole, const Solid& part, const Face& face, const Vec3& p)
{
    const Vec3 front = p + look_aside * whole.reach * face.normal;
    return std::any_of(whole.parts.begin(), whole.parts.end(), [&](const Solid& other) {
        return &other != &part && holds(other, front, -touching * whole.reach);
    });
}

void append(Solid& whole, const Solid& part)
{
    for (const Vec3& corner : part.corners) {
        whole.corners.push_back(corner);
        whole.reach = std::max(whole.reach, corner.norm());
    }
    for (Face face : part.faces) {
        for (int& corner : face.corners) {
            corner += part.first_corner;
        }
        for (Side& side : face.sides) {
            side.i += part.first_corner;
            side.j += part.first_corner;
        }
        whole.faces.push_back(std::move(face));
    }
    whole.thickness = std::min(whole.thickness, part.thickness);
}

// The corners of the convex hull, by their places.
std::vector<int> extremes_of(const std::vector<Vec3>& corners)
{
    const Polytope hull = convex_hull(corners);
    std::vector<int> extremes;
    for (const Vec3& corner : hull.corners) {
        const auto found = std::find(corners.begin(), corners.end(), corner);
        extremes.push_back(static_cast<int>(found - corners.begin()));
    }
    std::sort(extremes.begin(), extremes.end());
    return extremes;
}

} // namespace

Solid compound_solid(const Compound& shape, int dimensions)
{
    Solid whole;
    whole.form = Form::compound;
    whole.thickness = infinity;
    AlignedBox box;
    for (const Polytope& polytope : shape.parts) {
        Solid part = solid_of(polytope, dimensions);
        part.first_corner = static_cast<int>(whole.corners.size());
        part.first_face = static_cast<int>(whole.faces.size());
        append(whole, part);
        for (const Vec3& corner : part.corners) {
            box.add(corner);
        }
        whole.parts.push_back(std::move(part));
    }
    whole.box_centre = 0.5 * (box.low + box.high);
    whole.box_half = 0.5 * (box.high - box.low);
    if (dimensions == 3 && !whole.parts.empty()) {
        whole.extremes = extremes_of(whole.corners);
    } else {
        whole.extremes.resize(whole.corners.size());
        std::iota(whole.extremes.begin(), whole.extremes.end(), 0);
    }
    return whole;
}

std::span<const Solid> convex_parts(const Solid& solid)
{
    return solid.form == Form::compound ? std::span<const Solid>(solid.parts)
                                        : std::span<const Solid>(&solid, 1);
}

const Solid& part_of_corner(const Solid& solid, int corner)
{
    const std::span<const Solid> parts = convex_parts(solid);
    const auto next = std::find_if(parts.begin() + 1, parts.end(),
                                   [&](const Solid& part) { return part.first_corner > corner; });
    return *(next - 1);
}

bool face_is_open(const Solid& whole, const Solid& part, int f, const Vec3& point)
{
    if (whole.form != Form::compound) {
        return true;
    }
    const Face& face = part.faces[f];
    const double aside = look_aside * whole.reach;
    const Vec3 foot = point - (face.normal.dot(point) - face.offset) * face.normal;
    const Vec3 u = face.sides.front().normal;
    const Vec3 w = face.normal.cross(u);
    Vec3 centre = Vec3::Zero();
    for (const int corner : face.corners) {
        centre += part.corners[corner];
    }
    centre /= static_cast<double>(face.corners.size());
    // four points around the foot, and one towards the centre of the face for acute corners
    for (const Vec3& d : {Vec3(u + 0.9 * w), Vec3(w - 0.9 * u), Vec3(-u - 0.9 * w),
                          Vec3(0.9 * u - w), Vec3((centre - foot).normalized())}) {
        const Vec3 p = foot + aside * d;
        if (past_sides(face, p) < aside / 2 && !covered(whole, part, face, p)) {
            return true;
        }
    }
    return false;
}

double depth_of_cover(const Solid& whole)
{
    return whole.form == Form::compound ? 0.8 * look_aside * whole.reach : infinity;
}

bool edge_is_open(const Solid& whole, const Solid& part, const Edge& edge, const Vec3& point)
{
    return face_is_open(whole, part, edge.left, point) &&
           face_is_open(whole, part, edge.right, point);
}

int face_at(const Solid& whole, const Solid& part, const Vec3& point, const Vec3& n)
{
    const auto found = std::find_if(part.faces.begin(), part.faces.end(), [&](const Face& face) {
        return face.normal.dot(point) - face.offset > -touching * whole.reach &&
               face.normal.dot(n) > 1 - same_direction;
    });
    return found == part.faces.end() ? -1 : static_cast<int>(found - part.faces.begin());
}

bool rim_is_open(const Solid& whole, const Solid& part, const Vec3& point)
{
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
        const Face& face = part.faces[f];
        if (face.normal.dot(point) - face.offset > -touching * whole.reach &&
            !face_is_open(whole, part, static_cast<int>(f), point)) {
            return false;
        }
    }
    return true;
}

} // namespace hyoryu
