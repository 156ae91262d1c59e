// SPDX-License-Identifier: MIT
// How far convex solids are apart or overlap, by their support functions alone: it knows no
// features, and shares nothing with the contact search. A direction along which two solids are no
// more than some depth in each other proves that they overlap by no more.
#pragma once

#include "hyoryu/rigid/rigid.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyoryu::test {

/// A convex solid where it is: points, with a ball or a cylinder about the x axis added to them.
struct Convex {
    std::vector<Vec3> points{Vec3::Zero()}; // [m]
    double ball = 0;                        // radius [m]
    double disc = 0, half = 0;              // radius and half the length of the cylinder [m]
    Vec3 x{0, 0, 0};
    Mat3 R = Mat3::Identity();

    Vec3 farthest(const Vec3& n) const
    {
        const Vec3 m = R.transpose() * n;
        const auto best =
            std::max_element(points.begin(), points.end(),
                             [&](const Vec3& p, const Vec3& q) { return m.dot(p) < m.dot(q); });
        Vec3 p = *best + ball / std::max(m.norm(), 1e-300) * m;
        const double across = std::max(std::hypot(m.y(), m.z()), 1e-300);
        p += Vec3(std::copysign(half, m.x()), disc / across * m.y(), disc / across * m.z());
        return x + R * p;
    }
};

/// The convex parts of a shape; in two dimensions not of a rod.
inline std::vector<Convex> pieces(const ContactShape& shape, const Vec3& x, const Quat& q)
{
    std::vector<Convex> found;
    const auto add = [&](Convex piece) {
        piece.x = x;
        piece.R = q.toRotationMatrix();
        found.push_back(std::move(piece));
    };
    if (const auto* ball = std::get_if<Ball>(&shape)) {
        add({.ball = ball->radius});
    } else if (const auto* rod = std::get_if<Rod>(&shape)) {
        add({.disc = rod->radius, .half = rod->length / 2});
    } else if (const auto* polytope = std::get_if<Polytope>(&shape)) {
        add({.points = polytope->corners});
    } else {
        for (const Polytope& part : std::get<Compound>(shape).parts) {
            add({.points = part.corners});
        }
    }
    return found;
}

/// How far a is from b along n.
inline double apart(const Convex& a, const Convex& b, const Vec3& n)
{
    return n.dot(a.farthest(-n) - b.farthest(n));
}

/// The point of the hull of at most four points that is nearest to the origin; keeps those that
/// span it.
inline Vec3 nearest_to_origin(std::vector<Vec3>& points)
{
    Vec3 best = points.front();
    std::vector<Vec3> spanning{best};
    for (unsigned set = 1; set < (1U << points.size()); ++set) {
        std::vector<Vec3> some;
        for (std::size_t k = 0; k < points.size(); ++k) {
            if ((set >> k & 1U) != 0) {
                some.push_back(points[k]);
            }
        }
        const auto edges = static_cast<Eigen::Index>(some.size()) - 1;
        if (edges > 3) {
            continue;
        }
        Vec3 p = some.front();
        if (edges > 0) {
            Eigen::MatrixXd D(3, edges);
            for (Eigen::Index k = 0; k < edges; ++k) {
                D.col(k) = some[static_cast<std::size_t>(k) + 1] - some.front();
            }
            const Eigen::VectorXd part = D.colPivHouseholderQr().solve(-some.front());
            if (part.minCoeff() < -1e-12 || part.sum() > 1 + 1e-12) {
                continue;
            }
            p += D * part;
        }
        if (p.squaredNorm() < best.squaredNorm()) {
            best = p;
            spanning = some;
        }
    }
    points = spanning;
    return best;
}

/// The line between the nearest points of a, shifted, and b: Gilbert, Johnson and Keerthi (1988).
inline Vec3 between(const Convex& a, const Convex& b, const Vec3& shift)
{
    constexpr int most_steps = 500;
    const auto corner = [&](const Vec3& n) { return Vec3(a.farthest(-n) + shift - b.farthest(n)); };
    std::vector<Vec3> simplex{corner(a.x + shift - b.x)};
    Vec3 v = simplex.front();
    for (int k = 0; k < most_steps; ++k) {
        const double length2 = v.squaredNorm();
        const Vec3 next = corner(v);
        if (length2 < 1e-28 || length2 - v.dot(next) <= 1e-14 * length2) {
            break;
        }
        simplex.push_back(next);
        const Vec3 nearer = nearest_to_origin(simplex);
        if (nearer.squaredNorm() >= length2 * (1 - 1e-15)) {
            break;
        }
        v = nearer;
    }
    return v;
}

/// The signed distance from b to a along the best direction that was found, beginning with n [m]:
/// the solids are drawn apart along n, and n becomes the line between their nearest points.
inline double signed_distance(const Convex& a, const Convex& b, Vec3& n)
{
    constexpr double well_apart = 1e-3; // [m]
    double best = apart(a, b, n);
    for (int k = 0; k < 100; ++k) {
        const Vec3 line = between(a, b, (well_apart + std::max(0.0, -best)) * n);
        if (line.norm() < 0.1 * well_apart) {
            return best;
        }
        const double distance = apart(a, b, line.normalized());
        if (distance <= best + 1e-15) {
            return best;
        }
        best = distance;
        n = line.normalized();
    }
    return best;
}

/// Overlap of two solids [m], or zero. `hint`: the direction of the last time, zero at first.
inline double depth(const Convex& a, const Convex& b, Vec3& hint)
{
    constexpr double nothing = 1e-8;
    std::vector<Vec3> tries;
    for (int k = 0; k < 3; ++k) {
        for (const Mat3* R : {&a.R, &b.R}) {
            tries.emplace_back(R->col(k));
            tries.emplace_back(-R->col(k));
        }
    }
    tries.push_back((a.x - b.x).normalized());
    if (hint.norm() > 0.5) {
        tries.push_back(hint);
    }
    const auto better = [&](const Vec3& m, const Vec3& n) {
        return apart(a, b, m) < apart(a, b, n);
    };
    hint = *std::max_element(tries.begin(), tries.end(), better);
    if (apart(a, b, hint) >= -nothing || signed_distance(a, b, hint) >= -nothing) {
        return 0;
    }
    constexpr int directions = 600; // on a spiral round the sphere
    for (int k = 0; k < directions; ++k) {
        const double z = 1 - 2 * (k + 0.5) / directions;
        const double r = std::sqrt(1 - z * z);
        const double angle = k * 2.399963229728653; // the golden angle
        tries.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    Vec3 other = *std::max_element(tries.begin(), tries.end(), better);
    if (signed_distance(a, b, other) > apart(a, b, hint)) {
        hint = other;
    }
    return std::max(0.0, -apart(a, b, hint));
}

} // namespace hyoryu::test
