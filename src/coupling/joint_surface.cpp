// SPDX-License-Identifier: MIT
#include "joint_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

ConvexPiece piece_of(const Polytope& shape, int dimensions)
{
    ConvexPiece piece;
    const Vec3 inside = mean_of(shape.corners);
    for (const std::vector<int>& face : faces_of(shape, dimensions)) {
        if (const auto side = side_through(shape, face, inside)) {
            piece.sides.push_back(*side);
        }
    }
    return piece;
}

// Intersects the interval of a ray with a + b t + c t^2 <= 0, c >= 0. Returns false if it is empty.
bool clip_round(double a, double b, double c, RayHit& hit)
{
    if (c < 1e-12) {
        return a <= 0;
    }
    const double root = b * b - 4 * a * c;
    if (root < 0) {
        return false;
    }
    const double first = (-b - std::sqrt(root)) / (2 * c);
    const double last = (-b + std::sqrt(root)) / (2 * c);
    if (first > hit.enter) {
        hit.enter = first;
        hit.normal.setZero(); // of the round part, set by the caller
    }
    hit.leave = std::min(hit.leave, last);
    return hit.enter <= hit.leave;
}

bool clip_side(const HalfSpaceOf& side, const Ray& ray, RayHit& hit)
{
    const double slope = side.normal.dot(ray.direction);
    const double room = side.offset - side.normal.dot(ray.origin);
    if (std::abs(slope) < 1e-12) {
        return room >= 0;
    }
    const double at = room / slope;
    if (slope > 0) {
        hit.leave = std::min(hit.leave, at);
    } else if (at > hit.enter) {
        hit.enter = at;
        hit.normal = side.normal;
    }
    return hit.enter <= hit.leave;
}

std::optional<RayHit> enters(const ConvexPiece& piece, const Ray& ray)
{
    RayHit hit{-infinity, infinity, Vec3::Zero()};
    for (const HalfSpaceOf& side : piece.sides) {
        if (!clip_side(side, ray, hit)) {
            return std::nullopt;
        }
    }
    if (piece.round != ConvexPiece::Round::none) {
        const Vec3 across = piece.round == ConvexPiece::Round::ball ? Vec3(1, 1, 1) : Vec3(0, 1, 1);
        const Vec3 o = (ray.origin - piece.middle).cwiseProduct(across);
        const Vec3 d = ray.direction.cwiseProduct(across);
        if (!clip_round(o.squaredNorm() - sq(piece.radius), 2 * o.dot(d), d.squaredNorm(), hit)) {
            return std::nullopt;
        }
        if (hit.normal.squaredNorm() == 0) {
            hit.normal = (o + hit.enter * d) / piece.radius;
        }
    }
    return hit;
}

void add_polytope(RaySolid& solid, const Polytope& shape, int dimensions)
{
    solid.pieces.push_back(piece_of(shape, dimensions));
    for (const Vec3& corner : shape.corners) {
        solid.reach = std::max(solid.reach, corner.norm());
        solid.corners.push_back(corner);
    }
}

// Eight points on the rim of each cap.
std::vector<Vec3> rims_of(const Rod& rod)
{
    constexpr int n = 8;
    std::vector<Vec3> points;
    for (int k = 0; k < n; ++k) {
        const double angle = 2 * std::numbers::pi * k / n;
        const Vec3 across(0, rod.radius * std::cos(angle), rod.radius * std::sin(angle));
        points.push_back(rod.middle + rod.length / 2 * Vec3::UnitX() + across);
        points.push_back(rod.middle - rod.length / 2 * Vec3::UnitX() + across);
    }
    return points;
}

RayWall walls_of(const Basin& basin)
{
    RayWall wall;
    wall.low = basin.min;
    wall.high = basin.max;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const Vec3 unit = Vec3::Unit(axis);
        if (!basin.open[2 * k]) {
            wall.half_spaces.push_back({unit, basin.min[axis]});
        }
        if (!basin.open[2 * k + 1]) {
            wall.half_spaces.push_back({-unit, -basin.max[axis]});
        }
        if (basin.open[2 * k] &&
            basin.open[2 * k + 1]) { // both sides open: no wall along this axis
            wall.low[axis] = -infinity;
            wall.high[axis] = infinity;
        }
    }
    return wall;
}

RayWall walls_of(const MeshSurface& mesh)
{
    RayWall wall;
    std::vector<AlignedBox> boxes;
    for (const auto& corners : mesh.triangles) {
        std::array<Vec3, 3> triangle;
        AlignedBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            triangle[k] = mesh.position + mesh.orientation * mesh.corners[corners[k]];
            box.add(triangle[k]);
        }
        boxes.push_back(box);
        wall.triangles.push_back(triangle);
    }
    wall.tree = tree_over(boxes);
    return wall;
}

// Moeller and Trumbore (1997), from the front side.
std::optional<RayHit> meets(const std::array<Vec3, 3>& t, const Ray& ray)
{
    const Vec3 a = t[1] - t[0];
    const Vec3 b = t[2] - t[0];
    const Vec3 normal = a.cross(b);
    const double slope = -normal.dot(ray.direction);
    if (!(slope > 1e-12 * normal.norm())) {
        return std::nullopt;
    }
    const Vec3 from = ray.origin - t[0];
    const Vec3 turn = from.cross(ray.direction);
    const double u = b.dot(turn) / slope;
    const double v = -a.dot(turn) / slope;
    constexpr double slack = 1e-9; // so that no ray slips through between two triangles
    if (u < -slack || v < -slack || u + v > 1 + slack) {
        return std::nullopt;
    }
    return RayHit{normal.dot(from) / slope, infinity, normal.normalized()};
}

} // namespace

std::optional<HalfSpaceOf> side_through(const Polytope& shape, const std::vector<int>& face,
                                        const Vec3& inside)
{
    const auto corner = [&](std::size_t k) { return shape.corners[face[k % face.size()]]; };
    Vec3 normal = Vec3::Zero();
    if (face.size() == 2) {
        normal = Vec3::UnitY().cross(corner(1) - corner(0));
    }
    for (std::size_t k = 2; k < face.size(); ++k) {
        normal += (corner(k - 1) - corner(0)).cross(corner(k) - corner(0));
    }
    if (!(normal.norm() > 0)) {
        return std::nullopt;
    }
    normal.normalize();
    normal *= normal.dot(corner(0) - inside) < 0 ? -1 : 1;
    return HalfSpaceOf{normal, normal.dot(corner(0))};
}

RaySolid ray_solid(const ContactShape& shape, int dimensions)
{
    RaySolid solid;
    if (const auto* ball = std::get_if<Ball>(&shape)) {
        solid = {{{{}, ConvexPiece::Round::ball, ball->radius, ball->middle}},
                 ball->radius + ball->middle.norm(),
                 {}};
    } else if (const auto* rod = std::get_if<Rod>(&shape)) {
        if (dimensions == 2) {
            const Vec3 section(rod->length, 0, 2 * rod->radius);
            return ray_solid(moved(box_polytope(section, 2), rod->middle), 2);
        }
        const double half = rod->length / 2;
        const double x = rod->middle.x();
        solid = {{{{{Vec3::UnitX(), half + x}, {-Vec3::UnitX(), half - x}},
                   ConvexPiece::Round::cylinder,
                   rod->radius,
                   rod->middle}},
                 std::hypot(half, rod->radius) + rod->middle.norm(),
                 rims_of(*rod)};
    } else if (const auto* polytope = std::get_if<Polytope>(&shape)) {
        add_polytope(solid, *polytope, dimensions);
    } else {
        for (const Polytope& part : std::get<Compound>(shape).parts) {
            add_polytope(solid, part, dimensions);
        }
    }
    return solid;
}

double reach_across(const RaySolid& solid, const Vec3& along)
{
    double reach = solid.corners.empty() ? solid.reach : 0;
    for (const Vec3& corner : solid.corners) {
        reach = std::max(reach, corner.cross(along).norm());
    }
    return reach;
}

bool holds(const ConvexPiece& piece, const Vec3& point, double margin)
{
    const bool between = std::ranges::all_of(piece.sides, [&](const HalfSpaceOf& side) {
        return side.normal.dot(point) <= side.offset + margin;
    });
    const Vec3 r = point - piece.middle;
    const double across =
        piece.round == ConvexPiece::Round::ball ? r.norm() : std::hypot(r.y(), r.z());
    return between && (piece.round == ConvexPiece::Round::none || across <= piece.radius + margin);
}

double distance(const RaySolid& solid, const Vec3& point)
{
    double least = infinity;
    for (const ConvexPiece& piece : solid.pieces) {
        double most = -infinity;
        for (const HalfSpaceOf& side : piece.sides) {
            most = std::max(most, side.normal.dot(point) - side.offset);
        }
        const Vec3 r = point - piece.middle;
        if (piece.round != ConvexPiece::Round::none) {
            const bool ball = piece.round == ConvexPiece::Round::ball;
            most = std::max(most, (ball ? r.norm() : std::hypot(r.y(), r.z())) - piece.radius);
        }
        least = std::min(least, most);
    }
    return least;
}

bool comes_near(const Ray& ray, const RayPart& part, const Vec3& point, double reach)
{
    const Vec3 way = point - ray.origin;
    const double along = std::clamp(way.dot(ray.direction), part.from, part.to);
    return (way - along * ray.direction).squaredNorm() <= sq(reach);
}

std::optional<RayHit> enters(const RaySolid& solid, const Ray& ray)
{
    std::optional<RayHit> first;
    for (const ConvexPiece& piece : solid.pieces) {
        const auto hit = enters(piece, ray);
        if (hit && hit->leave >= 0 && (!first || hit->enter < first->enter)) {
            first = hit;
        }
    }
    return first;
}

RayWall ray_wall(const Boundary& boundary, int dimensions)
{
    if (const auto* plane = std::get_if<Plane>(&boundary.surface)) {
        RayWall wall;
        wall.half_spaces.push_back({plane->normal, plane->normal.dot(plane->point)});
        return wall;
    }
    if (const auto* basin = std::get_if<Basin>(&boundary.surface)) {
        return walls_of(*basin);
    }
    if (const auto* mesh = std::get_if<MeshSurface>(&boundary.surface)) {
        return walls_of(*mesh);
    }
    const auto& obstacle = std::get<Obstacle>(boundary.surface);
    RayWall wall;
    wall.solid = ray_solid(obstacle.shape, dimensions);
    wall.position = obstacle.position;
    wall.orientation = obstacle.orientation;
    return wall;
}

bool near_wall(const RayWall& wall, const Vec3& point, double reach)
{
    const auto is_near = [&](const HalfSpaceOf& side) {
        return side.normal.dot(point) - side.offset <= reach;
    };
    if (std::ranges::any_of(wall.half_spaces, is_near)) {
        return true;
    }
    if (!wall.solid.pieces.empty()) {
        return (point - wall.position).norm() <= reach + wall.solid.reach;
    }
    const AlignedBox box{point - Vec3::Constant(reach), point + Vec3::Constant(reach)};
    return any_of_near(wall.tree, box, [](int) { return true; });
}

std::optional<RayHit> enters(const RayWall& wall, const Ray& ray, const RayPart& part)
{
    std::optional<RayHit> first;
    const auto keep = [&](const std::optional<RayHit>& hit) {
        if (hit && (!first || hit->enter < first->enter)) {
            first = hit;
        }
    };
    for (const HalfSpaceOf& side : wall.half_spaces) {
        RayHit hit{-infinity, infinity, side.normal};
        if (!clip_side(side, ray, hit)) {
            continue;
        }
        const Vec3 at = ray.origin + hit.enter * ray.direction;
        constexpr double slack = 1e-9; // [m]
        if (hit.enter > -infinity && (at.array() >= wall.low.array() - slack).all() &&
            (at.array() <= wall.high.array() + slack).all()) {
            keep(hit);
        }
    }
    if (!wall.solid.pieces.empty() && comes_near(ray, part, wall.position, wall.solid.reach)) {
        const Quat back = wall.orientation.conjugate();
        auto hit = enters(wall.solid, {back * (ray.origin - wall.position), back * ray.direction});
        if (hit) {
            hit->normal = wall.orientation * hit->normal;
        }
        keep(hit);
    }
    if (!wall.triangles.empty()) {
        AlignedBox along;
        along.add(ray.origin + part.from * ray.direction);
        along.add(ray.origin + part.to * ray.direction);
        any_of_near(wall.tree, along, [&](int k) {
            const auto hit = meets(wall.triangles[k], ray);
            if (hit && hit->enter >= part.from && hit->enter <= part.to) {
                keep(hit);
            }
            return false;
        });
    }
    return first;
}

} // namespace hyoryu
