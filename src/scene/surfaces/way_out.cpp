// SPDX-License-Identifier: MIT
#include "way_out.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// The nearest exit of a line behind a distance.
class ExitSearch {
public:
    ExitSearch(const TriangleTree& tree, const Vec3& from, const AxisWay& way)
        : tree_(tree), from_(from), a_(way.axis), b_((way.axis + 1) % 3), c_((way.axis + 2) % 3),
          sense_(way.sense)
    {
    }

    WayOut beyond(double least, double farthest)
    {
        least_ = least;
        best_ = {.distance = farthest};
        found_ = false;
        if (!tree_.nodes.empty()) {
            search(0);
        }
        return found_ ? best_ : WayOut{};
    }

private:
    bool misses(const Bounds& box) const
    {
        const double first = sense_ > 0 ? box.min[a_] - from_[a_] : from_[a_] - box.max[a_];
        const double last = sense_ > 0 ? box.max[a_] - from_[a_] : from_[a_] - box.min[a_];
        return first >= best_.distance || last < least_ || box.min[b_] > from_[b_] ||
               box.max[b_] < from_[b_] || box.min[c_] > from_[c_] || box.max[c_] < from_[c_];
    }

    void search(int node)
    {
        const TriangleTree::Node& n = tree_.nodes[at(node)];
        if (misses(n.box)) {
            return;
        }
        if (n.right >= 0) {
            search(node + 1);
            search(n.right);
            return;
        }
        for (int k = n.first; k < n.first + n.count; ++k) {
            look_at(tree_.triangles[at(k)]);
        }
    }

    // Twice the area that two ways span in the plane across the line.
    double across(const Vec3& u, const Vec3& v) const { return u[b_] * v[c_] - u[c_] * v[b_]; }

    // A line through an edge meets both of its triangles, so that rounding leaves no hole; one in
    // the plane of a triangle meets its neighbours.
    void look_at(const TriangleTree::Triangle& t)
    {
        constexpr double rounding = 1e-9;
        const Vec3 p = tree_.corners[at(t.corner[0])];
        const Vec3 q = tree_.corners[at(t.corner[1])];
        const Vec3 r = tree_.corners[at(t.corner[2])];
        const Vec3 area = (q - p).cross(r - p);
        const double whole = sense_ * area[a_];
        const double of_p = sense_ * across(r - q, from_ - q);
        const double of_q = sense_ * across(p - r, from_ - r);
        const double of_r = sense_ * across(q - p, from_ - p);
        const bool is_parallel = whole <= rounding * area.norm();
        if (is_parallel || std::min({of_p, of_q, of_r}) < -rounding * whole) {
            return;
        }
        const double place = (of_p * p[a_] + of_q * q[a_] + of_r * r[a_]) / whole;
        const double distance = sense_ * (place - from_[a_]);
        if (distance >= least_ && distance < best_.distance) {
            best_ = {distance, area.normalized()};
            found_ = true;
        }
    }

    const TriangleTree& tree_;
    Vec3 from_;
    int a_, b_, c_; // the axis of the line and those across it
    int sense_;
    double least_ = 0;
    WayOut best_;
    bool found_ = false;
};

} // namespace

WayOut way_out(const TriangleTree& tree, const Vec3& from, const AxisWay& way, double farthest)
{
    ExitSearch exits(tree, from, way);
    WayOut exit = exits.beyond(0, farthest);
    if (tree.is_one_piece) {
        return exit;
    }
    const double behind = 1e-6 * tree.moments[0].radius;
    Vec3 step = Vec3::Zero();
    step[way.axis] = way.sense;
    while (exit.distance < farthest &&
           nearest_place(tree, from + (exit.distance + behind) * step, infinity).distance < 0) {
        exit = exits.beyond(exit.distance + behind, farthest);
    }
    return exit;
}

} // namespace hyoryu
