// SPDX-License-Identifier: MIT
// How accurate the witness is: random pairs whose overlap is known by construction.
#include "convex.hpp"
#include "judge.hpp"
#include "second_opinion.hpp"

#include <algorithm>
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
    double ours = 0;      // largest error of the depth [m]
    double fcl = 0;       // the same of FCL alone
    double false_gap = 0; // of pairs a little apart: largest overlap told
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
    if (depth > 0) {
        errors.ours = std::max(errors.ours, std::abs(found - depth));
        errors.fcl = std::max(errors.fcl, std::abs(depth_by_fcl(pa, pb, 3) - depth));
    } else {
        errors.ours = std::max(errors.ours, std::abs(found - depth));
        errors.false_gap = std::max(errors.false_gap, found);
    }
}

} // namespace

int self_test(nlohmann::ordered_json& json)
{
    constexpr double allowed = 1e-9;
    constexpr int pairs = 400;
    int failures = 0;
    Random random(22);
    for (const std::string one : {"box", "ball", "cylinder"}) {
        for (const std::string other : {"box", "ball", "cylinder"}) {
            for (const double depth : {1e-3, 1e-5, 1e-7, -1e-6}) {
                Errors errors;
                for (int k = 0; k < pairs; ++k) {
                    try_pair(one, other, random, depth, errors);
                }
                failures += errors.ours > allowed ? 1 : 0;
                json["self_test"].push_back({{"pair", one + " and " + other},
                                             {"depth", depth},
                                             {"largest_error", errors.ours},
                                             {"largest_error_of_fcl_alone", errors.fcl}});
            }
        }
    }
    return failures;
}

} // namespace witness
