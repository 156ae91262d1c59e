// SPDX-License-Identifier: MIT
#include "hyoryu/scene/triangle_tree.hpp"

#include "hyoryu/core/triangle_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace hyoryu {

namespace {

constexpr int leaf_size = 4;
// Features of a triangle: the face, edge k from corner k on, corner k.
constexpr std::size_t on_face = 0, edges = 1, corners_of = 4;

using Triangle = TriangleTree::Triangle;
using Numbers = std::vector<std::array<int, 3>>;
using Corners = std::array<Vec3, 3>; // of a triangle [m]

Corners corners_of_triangle(const std::vector<Vec3>& corners, const std::array<int, 3>& t)
{
    return {corners[at(t[0])], corners[at(t[1])], corners[at(t[2])]};
}

Vec3 area_of(const Corners& t)
{
    return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]);
}

Vec3 normal_of(const Corners& t)
{
    return area_of(t).normalized();
}

Vec3 middle_of(const Corners& t)
{
    return (t[0] + t[1] + t[2]) / 3;
}

double angle_at(const Corners& t, std::size_t k)
{
    const Vec3 a = (t[(k + 1) % 3] - t[k]).normalized();
    const Vec3 b = (t[(k + 2) % 3] - t[k]).normalized();
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

void set_corner_normals(TriangleTree& tree)
{
    tree.corner_normals.assign(tree.corners.size(), Vec3::Zero());
    for (const Triangle& t : tree.triangles) {
        const Corners corner = corners_of_triangle(tree.corners, t.corner);
        const Vec3 n = normal_of(corner);
        for (std::size_t k = 0; k < 3; ++k) {
            tree.corner_normals[at(t.corner[k])] += angle_at(corner, k) * n;
        }
    }
}

// Numbers the edges and sums the normals of the faces that meet there.
void set_edge_normals(const Numbers& numbers, TriangleTree& tree)
{
    const std::vector<TriangleSide> sorted = sorted_sides(numbers);
    tree.edge_normals.reserve(sorted.size() / 2);
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        const TriangleSide& e = sorted[k];
        if (k == 0 || e.low != sorted[k - 1].low || e.high != sorted[k - 1].high) {
            tree.edge_normals.emplace_back(0, 0, 0);
        }
        Triangle& t = tree.triangles[at(e.triangle)];
        t.edge[at(e.side)] = static_cast<int>(tree.edge_normals.size()) - 1;
        tree.edge_normals.back() += normal_of(corners_of_triangle(tree.corners, t.corner));
    }
}

class TreeBuilder {
public:
    explicit TreeBuilder(TriangleTree& tree) : tree_(tree)
    {
        for (const Triangle& t : tree.triangles) {
            order_.push_back(static_cast<int>(order_.size()));
            middles_.push_back(middle_of(corners_of_triangle(tree.corners, t.corner)));
        }
    }

    void build()
    {
        const auto count = static_cast<int>(order_.size());
        tree_.nodes.reserve(order_.size());
        build(0, count);
        tree_.nodes.shrink_to_fit();
        std::vector<Triangle> sorted;
        sorted.reserve(order_.size());
        for (const int k : order_) {
            sorted.push_back(tree_.triangles[at(k)]);
        }
        tree_.triangles = std::move(sorted);
        const std::size_t nodes = tree_.is_one_piece ? 1 : tree_.nodes.size();
        for (std::size_t k = 0; k < nodes; ++k) {
            tree_.moments.push_back(moment_of(tree_.nodes[k]));
        }
    }

private:
    void build(int first, int count)
    {
        const std::size_t own = tree_.nodes.size();
        TriangleTree::Node& node = tree_.nodes.emplace_back();
        node.first = first;
        node.count = count;
        Bounds middles;
        for (int k = first; k < first + count; ++k) {
            const int triangle = order_[at(k)];
            for (const int corner : tree_.triangles[at(triangle)].corner) {
                node.box.add(tree_.corners[at(corner)]);
            }
            middles.add(middles_[at(triangle)]);
        }
        if (count <= leaf_size) {
            return;
        }
        int axis = 0;
        (middles.max - middles.min).maxCoeff(&axis);
        const auto begin = order_.begin() + first;
        std::stable_sort(begin, begin + count, [&](int a, int b) {
            return middles_[at(a)][axis] < middles_[at(b)][axis];
        });
        build(first, count / 2);
        tree_.nodes[own].right = static_cast<int>(tree_.nodes.size());
        build(first + count / 2, count - count / 2);
    }

    TriangleTree::Moment moment_of(const TriangleTree::Node& node) const
    {
        TriangleTree::Moment moment;
        double total = 0;
        const auto corners_at = [&](int k) {
            return corners_of_triangle(tree_.corners, tree_.triangles[at(k)].corner);
        };
        for (int k = node.first; k < node.first + node.count; ++k) {
            const Corners t = corners_at(k);
            const double size = area_of(t).norm();
            moment.area += area_of(t);
            moment.middle += size * middle_of(t);
            total += size;
        }
        moment.middle = total > 0 ? Vec3(moment.middle / total) : node.box.min;
        for (int k = node.first; k < node.first + node.count; ++k) {
            for (const Vec3& corner : corners_at(k)) {
                moment.radius = std::max(moment.radius, (corner - moment.middle).norm());
            }
        }
        return moment;
    }

    TriangleTree& tree_;
    std::vector<int> order_;    // the triangles as the leaves will have them
    std::vector<Vec3> middles_; // of the triangles [m]
};

// The place of a triangle that is nearest to a point, and the feature that it is on
// (Ericson 2005, sec. 5.1.5).
struct Foot {
    Vec3 place{0, 0, 0};
    std::size_t feature = on_face;
};

Foot foot_on(const Corners& t, const Vec3& p)
{
    const auto& [a, b, c] = t;
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
    return {a + ab * (vb * scale) + ac * (vc * scale), on_face};
}

double distance_to_box(const Bounds& box, const Vec3& p)
{
    return (box.min - p).cwiseMax(p - box.max).cwiseMax(0.0).norm();
}

// Part of the sphere about a point that a triangle covers, with the sign of its side
// (van Oosterom and Strackee 1983).
double covered_part(const Corners& t, const Vec3& p)
{
    const Vec3 a = t[0] - p;
    const Vec3 b = t[1] - p;
    const Vec3 c = t[2] - p;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    const double den = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    return std::atan2(a.dot(b.cross(c)), den) / (2 * std::numbers::pi);
}

// 1 inside, 0 outside; distant nodes by the first term of their expansion.
double winding_below(const TriangleTree& tree, int node, const Vec3& p)
{
    constexpr double far = 2.5; // radii: errors of a few hundredths, and half decides
    const TriangleTree::Node& n = tree.nodes[at(node)];
    const TriangleTree::Moment& moment = tree.moments[at(node)];
    const Vec3 r = moment.middle - p;
    if (r.norm() > far * moment.radius) {
        return moment.area.dot(r) / (4 * std::numbers::pi * std::pow(r.norm(), 3));
    }
    if (n.right >= 0) {
        return winding_below(tree, node + 1, p) + winding_below(tree, n.right, p);
    }
    double sum = 0;
    for (int k = n.first; k < n.first + n.count; ++k) {
        sum += covered_part(corners_of_triangle(tree.corners, tree.triangles[at(k)].corner), p);
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
            const Foot foot =
                foot_on(corners_of_triangle(tree.corners, tree.triangles[at(k)].corner), p);
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

// The normal that decides on which side of a feature a point is.
Vec3 side_normal(const TriangleTree& tree, const Triangle& t, std::size_t feature)
{
    if (feature == on_face) {
        return normal_of(corners_of_triangle(tree.corners, t.corner));
    }
    return feature < corners_of ? tree.edge_normals[at(t.edge[feature - edges])]
                                : tree.corner_normals[at(t.corner[feature - corners_of])];
}

} // namespace

TriangleTree triangle_tree(const std::vector<Vec3>& corners, const Numbers& triangles)
{
    TriangleTree tree;
    tree.corners = corners;
    tree.triangles.reserve(triangles.size());
    for (const auto& t : triangles) {
        tree.triangles.push_back({t, {}});
    }
    set_corner_normals(tree);
    set_edge_normals(triangles, tree);
    const std::vector<int> pieces = pieces_of(tree);
    tree.is_one_piece = std::ranges::all_of(pieces, [](int piece) { return piece == 0; });
    if (!triangles.empty()) {
        TreeBuilder(tree).build();
    }
    return tree;
}

std::vector<int> pieces_of(const TriangleTree& tree)
{
    std::vector<int> root(tree.triangles.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int k) {
        while (root[at(k)] != k) {
            k = root[at(k)] = root[at(root[at(k)])];
        }
        return k;
    };
    std::vector<int> first(tree.edge_normals.size(), -1); // triangle at each edge
    for (std::size_t k = 0; k < tree.triangles.size(); ++k) {
        for (const int edge : tree.triangles[k].edge) {
            int& other = first[at(edge)];
            other = other < 0 ? static_cast<int>(k) : other;
            const int one = find(other);
            const int two = find(static_cast<int>(k));
            root[at(std::max(one, two))] = std::min(one, two);
        }
    }
    for (std::size_t k = 0; k < root.size(); ++k) {
        root[k] = find(static_cast<int>(k));
    }
    return root;
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
    const Vec3 outward = side_normal(tree, tree.triangles[at(best.triangle)], best.foot.feature);
    const Vec3 way = point - best.foot.place;
    const bool inside =
        tree.is_one_piece ? way.dot(outward) < 0 : winding_number(tree, point) > 0.5;
    const double side = inside ? -1 : 1;
    // On the surface itself the direction is undefined.
    const double touching = 1e-12 * tree.moments[0].radius;
    const Vec3 normal =
        best.distance > touching ? Vec3(side / best.distance * way) : outward.normalized();
    return {side * best.distance, normal};
}

double winding_number(const TriangleTree& tree, const Vec3& point)
{
    return winding_below(tree, 0, point);
}

} // namespace hyoryu
