// SPDX-License-Identifier: MIT
#include "hyoryu/rigid/body.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace hyoryu {

namespace {

struct HullFace {
    std::array<int, 3> corner;
    Vec3 normal{0, 0, 0}; // unit, outwards
    double offset = 0;    // normal . x on the face
};

HullFace make_face(const std::vector<Vec3>& p, int a, int b, int c)
{
    const auto at = [&](int k) { return p[k]; };
    const Vec3 normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    return {{a, b, c}, normal, normal.dot(at(a))};
}

// The point with the largest f.
template <class F>
int farthest_along(const std::vector<Vec3>& p, const F& f)
{
    int best = 0;
    for (int k = 1; k < static_cast<int>(p.size()); ++k) {
        if (f(p[k]) > f(p[best])) {
            best = k;
        }
    }
    return best;
}

// Four points that span as much as a greedy choice finds.
std::vector<HullFace> first_tetrahedron(const std::vector<Vec3>& p)
{
    const auto at = [&](int k) { return p[k]; };
    const int a = farthest_along(p, [](const Vec3& x) { return x.x(); });
    const int b = farthest_along(p, [&](const Vec3& x) { return (x - at(a)).squaredNorm(); });
    const Vec3 line = (at(b) - at(a)).normalized();
    const int c =
        farthest_along(p, [&](const Vec3& x) { return (x - at(a)).cross(line).squaredNorm(); });
    const Vec3 normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    const int d = farthest_along(p, [&](const Vec3& x) { return std::abs(normal.dot(x - at(a))); });
    if (normal.dot(at(d) - at(a)) > 0) {
        return {make_face(p, a, c, b), make_face(p, a, b, d), make_face(p, b, c, d),
                make_face(p, c, a, d)};
    }
    return {make_face(p, a, b, c), make_face(p, a, d, b), make_face(p, b, d, c),
            make_face(p, c, d, a)};
}

// Corners of one face are off its plane by the rounding of a mesh in single precision, 6e-8, and
// more where three that are near each other span it; a point that sticks out by less is left out of
// the hull [sizes].
constexpr double plane_enough = 1e-6;
// One less the cosine of the angle between two triangles of one face, 1e-5, at most.
constexpr double flat = 5e-11;
// Rounding of distances in double precision, with room [sizes].
constexpr double rounding = 1e-13;

// Replaces the faces that see the point by a cone from their horizon to it. All faces below a new
// corner are replaced, with no tolerance beyond round-off: with one, only some faces of a nearly
// flat side would be replaced, and the hull would not be closed.
void add_point(const std::vector<Vec3>& p, int point, double size, std::vector<HullFace>& faces)
{
    const Vec3& x = p[point];
    const auto above = [&](const HullFace& face) { return face.normal.dot(x) - face.offset; };
    const auto sees = [&](const HullFace& face) { return above(face) > rounding * size; };
    if (std::ranges::none_of(faces,
                             [&](const HullFace& f) { return above(f) > plane_enough * size; })) {
        return;
    }
    std::set<std::pair<int, int>> edges;
    for (const HullFace& face : faces) {
        if (sees(face)) {
            for (std::size_t k = 0; k < 3; ++k) {
                edges.insert({face.corner[k], face.corner[(k + 1) % 3]});
            }
        }
    }
    faces.erase(std::remove_if(faces.begin(), faces.end(), sees), faces.end());
    for (const auto& [from, to] : edges) {
        if (!edges.contains({to, from})) {
            faces.push_back(make_face(p, from, to, point));
        }
    }
}

// The outline of faces that lie in one plane, counter-clockwise from outside.
std::vector<int> outline(const std::vector<HullFace>& faces)
{
    std::set<std::pair<int, int>> edges;
    for (const HullFace& face : faces) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.insert({face.corner[k], face.corner[(k + 1) % 3]});
        }
    }
    std::map<int, int> next;
    for (const auto& [from, to] : edges) {
        if (!edges.contains({to, from})) {
            next[from] = to;
        }
    }
    std::vector<int> loop{next.begin()->first};
    while (loop.size() < next.size()) {
        loop.push_back(next.at(loop.back()));
    }
    return loop;
}

} // namespace

Polytope convex_hull(const std::vector<Vec3>& points)
{
    Vec3 low = points.front(), high = points.front();
    for (const Vec3& x : points) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const double size = (high - low).norm();
    std::vector<HullFace> faces = first_tetrahedron(points);
    for (int k = 0; k < static_cast<int>(points.size()); ++k) {
        add_point(points, k, size, faces);
    }

    Polytope hull;
    std::map<int, int> number; // of a point among the corners of the hull
    while (!faces.empty()) {
        const HullFace first = faces.front();
        const auto coplanar =
            std::stable_partition(faces.begin(), faces.end(), [&](const HullFace& face) {
                return face.normal.dot(first.normal) < 1 - flat ||
                       std::abs(face.offset - first.offset) > plane_enough * size;
            });
        std::vector<int> face;
        for (const int k : outline({coplanar, faces.end()})) {
            const auto known = number.try_emplace(k, static_cast<int>(number.size())).first;
            if (known->second == static_cast<int>(hull.corners.size())) {
                hull.corners.push_back(points[k]);
            }
            face.push_back(known->second);
        }
        hull.faces.push_back(std::move(face));
        faces.erase(coplanar, faces.end());
    }
    return hull;
}

} // namespace hyoryu
