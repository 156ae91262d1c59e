// SPDX-License-Identifier: MIT
#include "hyoryu/scene/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numbers>
#include <numeric>

namespace hyoryu {

namespace {

constexpr int leaf_size = 4;
// Features of a triangle: the face, edge k from corner k on, corner k.
constexpr std::size_t face = 0, edges = 1, corners_of = 4;

using Triangle = TriangleTree::Triangle;
using Numbers = std::vector<std::array<int, 3>>;

std::size_t at(int k)
{
    return static_cast<std::size_t>(k);
}

Vec3 area_of(const Triangle& t)
{
    return 0.5 * (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]);
}

Vec3 middle_of(const Triangle& t)
{
    return (t.corner[0] + t.corner[1] + t.corner[2]) / 3;
}

double angle_at(const Triangle& t, std::size_t k)
{
    const Vec3 a = (t.corner[(k + 1) % 3] - t.corner[k]).normalized();
    const Vec3 b = (t.corner[(k + 2) % 3] - t.corner[k]).normalized();
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

// An edge of a triangle by the numbers of its ends, the lower one first.
struct Edge {
    int low, high;
    std::size_t triangle, side; // on which side of which triangle
    auto operator<=>(const Edge&) const = default;
};

// The edges of all triangles, those between the same corners together.
std::vector<Edge> sorted_edges(const Numbers& numbers)
{
    std::vector<Edge> all;
    all.reserve(3 * numbers.size());
    for (std::size_t t = 0; t < numbers.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(numbers[t][k], numbers[t][(k + 1) % 3]);
            all.push_back({low, high, t, k});
        }
    }
    std::ranges::sort(all);
    return all;
}

// The normals of all features, from those of the faces that meet there.
void set_normals(const Numbers& numbers, std::size_t corner_count, std::vector<Triangle>& all)
{
    std::vector<Vec3> of_corner(corner_count, Vec3::Zero());
    for (std::size_t t = 0; t < all.size(); ++t) {
        const Vec3 n = area_of(all[t]).normalized();
        all[t].normal[face] = n;
        for (std::size_t k = 0; k < 3; ++k) {
            of_corner[at(numbers[t][k])] += angle_at(all[t], k) * n;
        }
    }
    for (std::size_t t = 0; t < all.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            all[t].normal[corners_of + k] = of_corner[at(numbers[t][k])];
        }
    }
    const std::vector<Edge> sorted = sorted_edges(numbers);
    for (auto first = sorted.begin(); first != sorted.end();) {
        const auto last = std::find_if(first, sorted.end(), [&](const Edge& e) {
            return e.low != first->low || e.high != first->high;
        });
        Vec3 sum = Vec3::Zero();
        for (auto e = first; e != last; ++e) {
            sum += all[e->triangle].normal[face];
        }
        for (; first != last; ++first) {
            all[first->triangle].normal[edges + first->side] = sum;
        }
    }
}

// Whether every corner is joined with every other one.
bool is_connected(const Numbers& numbers, std::size_t corner_count)
{
    std::vector<int> root(corner_count);
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int k) {
        while (root[at(k)] != k) {
            k = root[at(k)] = root[at(root[at(k)])];
        }
        return k;
    };
    std::size_t joins = 0;
    for (const auto& t : numbers) {
        for (const int other : {t[1], t[2]}) {
            const int a = find(t[0]);
            const int b = find(other);
            joins += a != b ? 1 : 0;
            root[at(b)] = a;
        }
    }
    return joins + 1 == corner_count;
}

class TreeBuilder {
public:
    explicit TreeBuilder(TriangleTree& tree) : tree_(tree) {}

    void build(int first, int count)
    {
        const std::size_t own = tree_.nodes.size();
        tree_.nodes.emplace_back();
        sum_up(tree_.nodes[own], first, count);
        if (count <= leaf_size) {
            return;
        }
        Bounds middles;
        for (int k = first; k < first + count; ++k) {
            middles.add(middle_of(tree_.triangles[at(k)]));
        }
        int axis = 0;
        (middles.max - middles.min).maxCoeff(&axis);
        const auto begin = tree_.triangles.begin() + first;
        std::stable_sort(begin, begin + count, [&](const Triangle& a, const Triangle& b) {
            return middle_of(a)[axis] < middle_of(b)[axis];
        });
        build(first, count / 2);
        tree_.nodes[own].right = static_cast<int>(tree_.nodes.size());
        build(first + count / 2, count - count / 2);
    }

private:
    void sum_up(TriangleTree::Node& node, int first, int count)
    {
        node.first = first;
        node.count = count;
        double total = 0;
        for (int k = first; k < first + count; ++k) {
            const Triangle& t = tree_.triangles[at(k)];
            for (const Vec3& corner : t.corner) {
                node.box.add(corner);
            }
            const double size = area_of(t).norm();
            node.area += area_of(t);
            node.middle += size * middle_of(t);
            total += size;
        }
        node.middle = total > 0 ? Vec3(node.middle / total) : node.box.min;
        for (int k = first; k < first + count; ++k) {
            for (const Vec3& corner : tree_.triangles[at(k)].corner) {
                node.radius = std::max(node.radius, (corner - node.middle).norm());
            }
        }
    }

    TriangleTree& tree_;
};

// The place of a triangle that is nearest to a point, and the feature that it is on
// (Ericson 2005, sec. 5.1.5).
struct Foot {
    Vec3 place{0, 0, 0};
    std::size_t feature = face;
};

Foot foot_on(const Triangle& t, const Vec3& p)
{
    const auto& [a, b, c] = t.corner;
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = ab.dot(p - a);
    const double d2 = ac.dot(p - a);
    if (d1 <= 0 && d2 <= 0) {
        return {a, corners_of};
    }
    const double d3 = ab.dot(p - b);
    const double d4 = ac.dot(p - b);
    if (d3 >= 0 && d4 <= d3) {
        return {b, corners_of + 1};
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        return {a + d1 / (d1 - d3) * ab, edges};
    }
    const double d5 = ab.dot(p - c);
    const double d6 = ac.dot(p - c);
    if (d6 >= 0 && d5 <= d6) {
        return {c, corners_of + 2};
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        return {a + d2 / (d2 - d6) * ac, edges + 2};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        return {b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), edges + 1};
    }
    const double scale = 1 / (va + vb + vc);
    return {a + ab * (vb * scale) + ac * (vc * scale), face};
}

double distance_to_box(const Bounds& box, const Vec3& p)
{
    return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).norm();
}

// Part of the sphere about a point that a triangle covers, with the sign of its side
// (van Oosterom and Strackee 1983).
double covered_part(const Triangle& t, const Vec3& p)
{
    const Vec3 a = t.corner[0] - p;
    const Vec3 b = t.corner[1] - p;
    const Vec3 c = t.corner[2] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    const double den = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    return std::atan2(a.dot(b.cross(c)), den) / (2 * std::numbers::pi);
}

// 1 inside, 0 outside; distant nodes by the first term of their expansion.
double winding_number(const TriangleTree& tree, int node, const Vec3& p)
{
    constexpr double far = 2.5; // radii: errors of a few hundredths, and half decides
    const TriangleTree::Node& n = tree.nodes[at(node)];
    const Vec3 r = n.middle - p;
    if (r.norm() > far * n.radius) {
        return n.area.dot(r) / (4 * std::numbers::pi * std::pow(r.norm(), 3));
    }
    if (n.right >= 0) {
        return winding_number(tree, node + 1, p) + winding_number(tree, n.right, p);
    }
    double sum = 0;
    for (int k = n.first; k < n.first + n.count; ++k) {
        sum += covered_part(tree.triangles[at(k)], p);
    }
    return sum;
}

struct Best {
    double distance = infinity;
    Foot foot;
    int triangle = -1;
};

void search(const TriangleTree& tree, int node, const Vec3& p, Best& best)
{
    const TriangleTree::Node& n = tree.nodes[at(node)];
    if (n.right < 0) {
        for (int k = n.first; k < n.first + n.count; ++k) {
            const Foot foot = foot_on(tree.triangles[at(k)], p);
            const double distance = (p - foot.place).norm();
            if (distance < best.distance) {
                best = {distance, foot, k};
            }
        }
        return;
    }
    const double left = distance_to_box(tree.nodes[at(node + 1)].box, p);
    const double right = distance_to_box(tree.nodes[at(n.right)].box, p);
    const bool left_first = left <= right;
    if ((left_first ? left : right) < best.distance) {
        search(tree, left_first ? node + 1 : n.right, p, best);
    }
    if ((left_first ? right : left) < best.distance) {
        search(tree, left_first ? n.right : node + 1, p, best);
    }
}

} // namespace

TriangleTree triangle_tree(const std::vector<Vec3>& corners, const Numbers& triangles)
{
    TriangleTree tree;
    tree.triangles.reserve(triangles.size());
    for (const auto& t : triangles) {
        tree.triangles.push_back({{corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]}, {}});
    }
    set_normals(triangles, corners.size(), tree.triangles);
    tree.is_one_piece = is_connected(triangles, corners.size());
    if (!triangles.empty()) {
        TreeBuilder(tree).build(0, static_cast<int>(triangles.size()));
    }
    return tree;
}

NearestPlace nearest_place(const TriangleTree& tree, const Vec3& point, double farthest)
{
    Best best{.distance = farthest};
    if (!tree.nodes.empty()) {
        search(tree, 0, point, best);
    }
    if (best.triangle < 0) {
        return {};
    }
    const Triangle& t = tree.triangles[at(best.triangle)];
    const Vec3 way = point - best.foot.place;
    const bool inside = tree.is_one_piece ? way.dot(t.normal[best.foot.feature]) < 0
                                          : winding_number(tree, 0, point) > 0.5;
    const double side = inside ? -1 : 1;
    // On the surface itself the direction is undefined.
    const double touching = 1e-12 * tree.nodes[0].radius;
    const Vec3 normal = best.distance > touching ? Vec3(side / best.distance * way)
                                                 : t.normal[best.foot.feature].normalized();
    return {side * best.distance, normal};
}

} // namespace hyoryu
