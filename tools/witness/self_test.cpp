// SPDX-License-Identifier: MIT
// How accurate the witness is: random pairs whose overlap is known by construction.
#include "convex.hpp"
#include "judge.hpp"
#include "second_opinion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace witness {

namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high)
{
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

Quat turn(Random& random)
{
    Eigen::Vector4d q;
    do {
        for (double& n : q) {
            n = between(random, -1, 1);
        }
    } while (q.norm() > 1 || q.norm() < 0.1);
    return Quat(q[0], q[1], q[2], q[3]).normalized();
}

Convex shape(const std::string& name, Random& random, int dimensions)
{
    Solid solid;
    solid.kind = name == "box" ? Kind::box : name == "ball" ? Kind::ball : Kind::cylinder;
    solid.size = {between(random, 0.1, 2), between(random, 0.1, 2), between(random, 0.1, 2)};
    solid.radius = between(random, 0.05, 1);
    solid.length = between(random, 0.1, 3);
    return parts_of(solid, dimensions)[0];
}

struct Errors {
    double ours = 0; // largest error of the depth [m]
    double fcl = 0;  // the same of FCL alone
};

// A stands in any pose; B lies with a feature on the plane that bounds A along a random direction n
// and reaches `depth` beyond it. For depths far below the sizes the depth is exact if n is the
// normal of a face of A over which the deepest point of B lies well inside.
void try_pair(const std::string& one, const std::string& other, Random& random, double depth,
              Errors& errors)
{
    const Convex a = shape(one, random, 3), b = shape(other, random, 3);
    const Quat qa = turn(random), qb = turn(random);
    Placed pa{&a, qa.toRotationMatrix(), {between(random, -5, 5), between(random, -5, 5), 0.3}};
    Vec3 n;
    Vec3 deepest; // of A's surface, where B is to touch it
    if (one == "box") {
        n = pa.turn * Vec3::UnitZ();
        deepest = pa.origin + pa.turn * Vec3(a.box.x() * between(random, -0.3, 0.3),
                                             a.box.y() * between(random, -0.3, 0.3), a.box.z() / 2);
    } else if (one == "ball") {
        n = turn(random) * Vec3::UnitX();
        deepest = pa.origin + a.radius * n;
    } else { // the side of the cylinder, or its cap
        const bool cap = random() % 2 == 0;
        const double angle = between(random, 0, 6.28);
        const Vec3 side(0, std::cos(angle), std::sin(angle));
        n = pa.turn * (cap ? Vec3(Vec3::UnitX()) : side);
        deepest = pa.origin +
                  pa.turn * (cap ? Vec3(a.half_length * Vec3::UnitX() +
                                        between(random, 0, 0.7) * a.cylinder_radius * side)
                                 : Vec3(between(random, -0.7, 0.7) * a.half_length * Vec3::UnitX() +
                                        a.cylinder_radius * side));
    }
    Placed pb{&b, qb.toRotationMatrix(), Vec3::Zero()};
    const Vec3 tip = core_support(pb, -n) - b.radius * n;
    pb.origin = deepest - depth * n - tip;
    const double found = overlap(pa, pb, Vec3::Zero(), -INFINITY).value;
    errors.ours = std::max(errors.ours, std::abs(found - depth));
    if (depth > 0) {
        errors.fcl = std::max(errors.fcl, std::abs(depth_by_fcl(pa, pb, 3) - depth));
    }
}

// An octahedron, stretched and sheared.
Mesh octahedron(Random& random)
{
    Mat3 stretch = Mat3::Zero();
    stretch.diagonal() =
        Vec3(between(random, 0.1, 1), between(random, 0.1, 1), between(random, 0.1, 1));
    const Mat3 map = turn(random) * stretch * turn(random).toRotationMatrix();
    Mesh mesh;
    for (Eigen::Index k = 0; k < 3; ++k) {
        mesh.corners.insert(mesh.corners.end(), {map.col(k), -map.col(k)});
    }
    for (const int x : {0, 1}) {
        for (const int y : {2, 3}) {
            for (const int z : {4, 5}) {
                const bool out = (x + y + z) % 2 == 0;
                mesh.triangles.push_back({x, out ? y : z, out ? z : y});
            }
        }
    }
    return mesh;
}

// The edge of a hull and that of a triangle cross within both and overlap by `depth` along n, which
// lies well within what the faces beside the edge of the hull span. All other directions are as
// much deeper as the solids are large.
void try_edges(Random& random, double depth, Errors& errors)
{
    const Mesh mesh = octahedron(random);
    const Convex hull = hull_of(mesh);
    const Placed a{&hull, turn(random).toRotationMatrix(), {between(random, -5, 5), 1, 0.3}};
    const auto corner = [&](int k) {
        return Vec3(a.origin + a.turn * mesh.corners[static_cast<std::size_t>(k)]);
    };
    const Vec3 along = (corner(2) - corner(0)).normalized(); // between the faces to 4 and to 5
    const auto out = [&](int k) {
        const Vec3 normal = along.cross(corner(k) - corner(0)).normalized();
        return Vec3(normal.dot(a.origin - corner(0)) > 0 ? -normal : normal);
    };
    const double part = between(random, 0.3, 0.7);
    const Vec3 n = (part * out(4) + (1 - part) * out(5)).normalized();
    const Vec3 across = (n.cross(along) + between(random, -2, 2) * along).normalized();
    // A triangle all but along the hull, near a corner of it, has other directions hardly deeper.
    const double tilt = std::pow(10.0, between(random, -2, 0));
    const Vec3 back = (tilt * n + (random() % 2 == 0 ? -1 : 1) * n.cross(across)).normalized();
    const double part_along = std::max(std::pow(10.0, between(random, -4, -0.3)), 1e4 * depth);
    const Vec3 point = corner(0) + std::min(part_along, 0.7) * (corner(2) - corner(0)) - depth * n;
    const Convex triangle = triangle_of(point - between(random, 0.3, 1) * across,
                                        point + between(random, 0.3, 1) * across,
                                        point + between(random, 0.3, 1) * back);
    const Placed b{&triangle, Mat3::Identity(), Vec3::Zero()};
    const double found = overlap(a, b, Vec3::Zero(), -INFINITY).value;
    errors.ours = std::max(errors.ours, std::abs(found - depth));
    errors.fcl = std::max(errors.fcl, std::abs(depth_by_fcl(a, b, 3) - depth));
}

void tell(nlohmann::ordered_json& json, const std::string& pair, double depth, const Errors& errors)
{
    json["self_test"].push_back({{"pair", pair},
                                 {"depth", depth},
                                 {"largest_error", errors.ours},
                                 {"largest_error_of_fcl_alone", errors.fcl}});
}

} // namespace

int self_test(nlohmann::ordered_json& json)
{
    constexpr double allowed = 1e-9;
    constexpr int pairs = 400;
    constexpr std::array depths{1e-3, 1e-5, 1e-7, -1e-6};
    int failures = 0;
    Random random(22);
    for (const std::string one : {"box", "ball", "cylinder"}) {
        for (const std::string other : {"box", "ball", "cylinder"}) {
            for (const double depth : depths) {
                Errors errors;
                for (int k = 0; k < pairs; ++k) {
                    try_pair(one, other, random, depth, errors);
                }
                failures += errors.ours > allowed ? 1 : 0;
                tell(json, one + " and " + other, depth, errors);
            }
        }
    }
    for (const double depth : depths) {
        Errors errors;
        for (int k = 0; k < pairs; ++k) {
            try_edges(random, depth, errors);
        }
        failures += errors.ours > allowed ? 1 : 0;
        tell(json, "edges of hull and triangle", depth, errors);
    }
    return failures;
}

} // namespace witness
