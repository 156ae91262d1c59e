// SPDX-License-Identifier: MIT
// Depth of overlap by descent: with f = f(n) known, A is moved back along n until it is a little
// apart from B; the direction n' between the nearest points then (Gilbert, Johnson and Keerthi
// 1988) has f(n') <= f(n), with equality only where n is a minimum already.
#include "convex.hpp"

#include <algorithm>
#include <cmath>

namespace witness {

namespace {

// Points of A - B with the origin's nearest point of their hull.
struct Simplex {
    std::vector<Vec3> points;
    Vec3 nearest{0, 0, 0};
};

// Nearest point to the origin of the hull of a subset, if it lies within: its weights are positive.
bool nearest_within(const std::vector<Vec3>& p, Vec3& nearest)
{
    const auto n = static_cast<Eigen::Index>(p.size());
    if (n == 1) {
        nearest = p[0];
        return true;
    }
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> d(3, n - 1);
    for (Eigen::Index k = 1; k < n; ++k) {
        d.col(k - 1) = p[static_cast<std::size_t>(k)] - p[0];
    }
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> w;
    if (n == 2) {
        w = Eigen::Matrix<double, 1, 1>(-d.col(0).dot(p[0]) / d.col(0).squaredNorm());
    } else {
        w = d.colPivHouseholderQr().solve(-p[0]);
    }
    if (!(w.minCoeff() > 0) || !(w.sum() < 1)) {
        return false;
    }
    nearest = p[0] + d * w;
    if (n == 3) { // across the plane, which keeps digits that the weights lose
        const Vec3 normal = d.col(0).cross(Vec3(d.col(1))).normalized();
        nearest = normal * normal.dot(p[0]);
    }
    return true;
}

// The nearest of all faces, edges and corners of up to four points; what does not carry it goes.
void reduce(Simplex& simplex)
{
    Simplex best;
    double least = INFINITY;
    const unsigned all = 1U << simplex.points.size();
    for (unsigned set = 1; set < all; ++set) {
        std::vector<Vec3> part;
        for (std::size_t k = 0; k < simplex.points.size(); ++k) {
            if (set >> k & 1U) {
                part.push_back(simplex.points[k]);
            }
        }
        Vec3 nearest;
        if (part.size() < 4 && nearest_within(part, nearest) && nearest.squaredNorm() < least) {
            least = nearest.squaredNorm();
            best = {part, nearest};
        }
    }
    simplex = std::move(best);
}

double excess_along(const Placed& a, const Placed& b, const Vec3& n)
{
    return n.dot(core_support(a, n) - core_support(b, -n)) + a.part->radius + b.part->radius;
}

// The direction between the nearest points of the cores, A moved by `shift`, which keeps them
// apart; from A to B.
Vec3 direction_apart(const Placed& a, const Placed& b, const Vec3& shift, const Vec3& first)
{
    constexpr int most = 100;
    constexpr double done = 1e-14;
    const auto support = [&](const Vec3& n) -> Vec3 {
        return core_support(a, n) + shift - core_support(b, -n);
    };
    Simplex simplex{{support(first)}, support(first)};
    double before = INFINITY;
    for (int k = 0; k < most; ++k) {
        const Vec3 v = simplex.nearest;
        const double square = v.squaredNorm();
        if (!(square > 0) || !(square < before)) {
            break;
        }
        before = square;
        const Vec3 w = support(-v.normalized());
        if (square - v.dot(w) <= done * square) {
            break;
        }
        simplex.points.push_back(w);
        reduce(simplex);
    }
    return simplex.nearest.norm() > 0 ? Vec3(-simplex.nearest.normalized()) : first;
}

Depth descend(const Placed& a, const Placed& b, Depth best)
{
    constexpr int most = 30;
    const double size = std::min(a.part->reach, b.part->reach);
    const double rounded = a.part->radius + b.part->radius;
    const double apart = 0.01 * size;
    for (int k = 0; k < most; ++k) {
        const double core = best.value - rounded;
        const Vec3 shift = core > -apart ? Vec3(-(core + apart) * best.normal) : Vec3(Vec3::Zero());
        const Vec3 n = direction_apart(a, b, shift, best.normal);
        const double value = excess_along(a, b, n);
        if (!(value < best.value - 1e-14 * size)) {
            break;
        }
        best = {value, n};
    }
    return best;
}

void look(const Placed& a, const Placed& b, const Vec3& n, Depth& best)
{
    const double length = n.norm();
    if (!(length > 1e-9)) {
        return;
    }
    const double value = excess_along(a, b, n / length);
    if (value < best.value) {
        best = {value, n / length};
    }
}

} // namespace

Vec3 core_support(const Placed& placed, const Vec3& n)
{
    const Vec3 own = placed.turn.transpose() * n;
    const Convex& part = *placed.part;
    if (part.cylinder_radius > 0) {
        const double across = std::hypot(own.y(), own.z());
        const double r = across > 0 ? part.cylinder_radius / across : 0;
        const Vec3 p = part.middle + Vec3(own.x() >= 0 ? part.half_length : -part.half_length,
                                          r * own.y(), r * own.z());
        return placed.origin + placed.turn * p;
    }
    const Vec3* farthest = part.corners.data();
    double most = own.dot(*farthest);
    for (const Vec3& corner : part.corners) {
        if (const double d = own.dot(corner); d > most) {
            most = d;
            farthest = &corner;
        }
    }
    return placed.origin + placed.turn * *farthest;
}

double reach_along(const Placed& placed, const Vec3& n)
{
    return n.dot(core_support(placed, n)) + placed.part->radius;
}

Depth overlap(const Placed& a, const Placed& b, const Vec3& warm, double enough)
{
    Depth best{INFINITY, Vec3::UnitZ()};
    look(a, b, warm, best);
    if (best.value <= enough) {
        return best;
    }
    look(a, b, b.middle() - a.middle(), best);
    for (const Vec3& n : a.part->normals) {
        look(a, b, a.turn * n, best);
    }
    for (const Vec3& n : b.part->normals) {
        look(a, b, -(b.turn * n), best);
    }
    for (const Vec3& i : a.part->edges) {
        for (const Vec3& j : b.part->edges) {
            const Vec3 n = (a.turn * i).cross(b.turn * j);
            look(a, b, n, best);
            look(a, b, -n, best);
        }
    }
    if (best.value <= enough) {
        return best;
    }
    Depth found = descend(a, b, best);
    if (found.value > enough) { // a second valley: that of the middles
        Depth other{INFINITY, Vec3::UnitZ()};
        look(a, b, b.middle() - a.middle(), other);
        if (std::isfinite(other.value)) {
            other = descend(a, b, other);
        }
        found = other.value < found.value ? other : found;
    }
    return found;
}

} // namespace witness
