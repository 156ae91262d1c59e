// SPDX-License-Identifier: MIT
#include "patch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hyoryu {

namespace {

// A hull of less than this part of the square of its length is a line.
constexpr double no_area = 1e-9;

double cross(const Vec3& a, const Vec3& b, const Vec3& n)
{
    return n.dot(a.cross(b));
}

struct Tangents {
    Vec3 u, w;
};

Tangents tangents(const Vec3& n)
{
    int helper = 0;
    n.cwiseAbs().minCoeff(&helper);
    const Vec3 u = n.cross(Vec3::Unit(helper)).normalized();
    return {u, n.cross(u)};
}

double square_of_length(std::span<const Vec3> points)
{
    double length = 0;
    for (const Vec3& p : points) {
        length = std::max(length, (p - points[0]).squaredNorm());
    }
    return length;
}

// The corners of the hull, counter-clockwise about n: Andrew's monotone chain (1979).
std::vector<int> hull_of(std::span<const Vec3> p, const Vec3& n)
{
    const auto [u, w] = tangents(n);
    const double flat = no_area * square_of_length(p);
    std::vector<int> order(p.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, [&](int a, int b) {
        const Vec3 step = p[b] - p[a];
        const double along = step.dot(u);
        return along != 0 ? along > 0 : step.dot(w) > 0;
    });
    std::vector<int> chain;
    const auto extend = [&](int k, std::size_t fixed) {
        const auto turns_left = [&] {
            const Vec3& last = p[chain.back()];
            return cross(last - p[chain[chain.size() - 2]], p[k] - last, n) > flat;
        };
        while (chain.size() >= fixed + 2 && !turns_left()) {
            chain.pop_back();
        }
        chain.push_back(k);
    };
    for (const int k : order) {
        extend(k, 0);
    }
    const std::size_t lower = chain.size() - 1;
    for (auto k = order.rbegin() + 1; k != order.rend(); ++k) {
        extend(*k, lower);
    }
    chain.pop_back();
    return chain;
}

// The integral of |r| over the triangle of the origin and an edge, at the distance d from it:
// d^3/2 [sec tan + asinh(tan)] between the angles of its ends.
double moment_of_triangle(const Vec3& from, const Vec3& to, const Vec3& n)
{
    const double length = (to - from).norm();
    const double d = cross(from, to, n) / std::max(length, 1e-300);
    if (d <= 0) {
        return 0;
    }
    const Vec3 along = (to - from) / length;
    const auto primitive = [&](const Vec3& end) {
        const double t = along.dot(end) / d;
        return t * std::sqrt(1 + t * t) + std::asinh(t);
    };
    return d * d * d / 6 * (primitive(to) - primitive(from));
}

// The weights of the points whose sum is the centroid of the hull, and its area.
double add_centroid(std::span<const Vec3> p, std::span<const int> hull, const Vec3& n,
                    std::vector<double>& weights)
{
    double area = 0;
    for (std::size_t k = 1; k + 1 < hull.size(); ++k) {
        const double part = 0.5 * cross(p[hull[k]] - p[hull[0]], p[hull[k + 1]] - p[hull[0]], n);
        for (const int corner : {hull[0], hull[k], hull[k + 1]}) {
            weights[corner] += part / 3;
        }
        area += part;
    }
    return area;
}

PatchRule line_rule(std::span<const Vec3> p)
{
    std::size_t first = 0;
    std::size_t last = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        first = (p[k] - p[0]).squaredNorm() > (p[first] - p[0]).squaredNorm() ? k : first;
    }
    for (std::size_t k = 0; k < p.size(); ++k) {
        last = (p[k] - p[first]).squaredNorm() > (p[last] - p[first]).squaredNorm() ? k : last;
    }
    PatchRule rule{.scale = 1, .weights = std::vector<double>(p.size(), 0)};
    rule.weights[first] += 0.5;
    rule.weights[last] += 0.5;
    const Vec3 centre = 0.5 * (p[first] + p[last]);
    double reach = 0;
    for (const Vec3& point : p) {
        reach += (point - centre).norm() / static_cast<double>(p.size());
    }
    // the mean of |r| along a line is a quarter of its length
    rule.scale = reach > 0 ? 0.25 * (p[last] - p[first]).norm() / reach : 1;
    return rule;
}

} // namespace

std::vector<int> outermost(std::span<const Vec3> points, const Vec3& n, const Vec3& along,
                           std::size_t most)
{
    std::vector<int> hull = hull_of(points, n);
    if (hull.size() <= most) {
        return hull;
    }
    const Vec3 u = (along - along.dot(n) * n).normalized();
    const Vec3 w = n.cross(u);
    std::vector<int> kept;
    for (const auto& [x, y] :
         {std::pair(1, 0), {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
        const Vec3 out = x * u + y * w;
        kept.push_back(*std::ranges::max_element(
            hull, {}, [&](int k) { return (points[k] - points[hull[0]]).dot(out); }));
    }
    std::erase_if(hull, [&](int k) { return std::ranges::find(kept, k) == kept.end(); });
    return hull;
}

PatchRule patch_rule(std::span<const Vec3> points, std::span<const int> hull, const Vec3& n,
                     PatchForm form)
{
    if (points.size() < 2) {
        return {.scale = 1, .weights = std::vector<double>(points.size(), 1)};
    }
    PatchRule rule{.scale = 1, .weights = std::vector<double>(points.size(), 0)};
    const double area = add_centroid(points, hull, n, rule.weights);
    if (area <= no_area * square_of_length(points)) {
        return line_rule(points);
    }
    Vec3 centre = Vec3::Zero();
    for (std::size_t k = 0; k < points.size(); ++k) {
        rule.weights[k] /= area;
        centre += rule.weights[k] * points[k];
    }
    double reach = 0;
    for (const Vec3& p : points) {
        reach += (p - centre).norm() / static_cast<double>(points.size());
    }
    double moment = 0;
    for (std::size_t k = 0; k < hull.size(); ++k) {
        moment += moment_of_triangle(points[hull[k]] - centre,
                                     points[hull[(k + 1) % hull.size()]] - centre, n);
    }
    rule.scale = form == PatchForm::disc ? 2.0 / 3 : moment / area / reach;
    return rule;
}

} // namespace hyoryu
