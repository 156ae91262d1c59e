// SPDX-License-Identifier: MIT
#include "hyoryu/geometry/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyoryu {

namespace {

// Whether two closed segments share a point.
bool segments_meet(const Plan2& a, const Plan2& b, const Plan2& c, const Plan2& d)
{
    const auto within = [](const Plan2& p, const Plan2& q, const Plan2& r) {
        return cross(p, q, r) == 0 && std::min(p[0], q[0]) <= r[0] &&
               r[0] <= std::max(p[0], q[0]) && std::min(p[1], q[1]) <= r[1] &&
               r[1] <= std::max(p[1], q[1]);
    };
    const auto differ = [](double s, double t) { return (s > 0 && t < 0) || (s < 0 && t > 0); };
    return (differ(cross(a, b, c), cross(a, b, d)) && differ(cross(c, d, a), cross(c, d, b))) ||
           within(a, b, c) || within(a, b, d) || within(c, d, a) || within(c, d, b);
}

// Whether an edge returns on the one before it.
bool folds_back(const Plan2& a, const Plan2& b, const Plan2& c)
{
    return cross(a, b, c) == 0 &&
           (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) <= 0;
}

std::string ring_fault(const Ring& ring)
{
    const std::size_t n = ring.size();
    if (n < 3) {
        return fmt::format("it has {} corners, expected at least 3", n);
    }
    if (n > most_corners) {
        return fmt::format("it has {} corners, at most {} are supported", n, most_corners);
    }
    for (std::size_t k = 0; k < n; ++k) {
        const Plan2& a = ring[k];
        const Plan2& b = ring[(k + 1) % n];
        if (folds_back(a, b, ring[(k + 2) % n])) {
            return fmt::format("it turns back on itself at corner {}", (k + 1) % n + 1);
        }
        for (std::size_t m = k + 2; m < n && (k > 0 || m + 1 < n); ++m) {
            if (segments_meet(a, b, ring[m], ring[(m + 1) % n])) {
                return fmt::format("it crosses itself: its edge from corner {} touches or crosses "
                                   "that from corner {}",
                                   k + 1, m + 1);
            }
        }
    }
    return {};
}

bool rings_meet(const Ring& a, const Ring& b)
{
    for (std::size_t k = 0; k < a.size(); ++k) {
        for (std::size_t m = 0; m < b.size(); ++m) {
            if (segments_meet(a[k], a[(k + 1) % a.size()], b[m], b[(m + 1) % b.size()])) {
                return true;
            }
        }
    }
    return false;
}

// Whether a line from corner v of a ring that runs counter-clockwise begins within its area.
bool begins_inside(const Ring& ring, std::size_t v, const Plan2& to)
{
    const std::size_t n = ring.size();
    const Plan2& before = ring[(v + n - 1) % n];
    const Plan2& after = ring[(v + 1) % n];
    const bool left_of_first = cross(before, ring[v], to) > 0;
    const bool left_of_second = cross(ring[v], after, to) > 0;
    return cross(before, ring[v], after) > 0 ? left_of_first && left_of_second
                                             : left_of_first || left_of_second;
}

// Whether edges of a ring lie between two places, each of which may be a corner of it.
bool blocks(const Ring& ring, const Plan2& from, const Plan2& to)
{
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Plan2& a = ring[k];
        const Plan2& b = ring[(k + 1) % ring.size()];
        const bool at_a = a == from || a == to;
        const bool at_b = b == from || b == to;
        const bool along = (at_a && !at_b && segments_meet(from, to, b, b)) ||
                           (at_b && !at_a && segments_meet(from, to, a, a));
        if (along || (!at_a && !at_b && segments_meet(from, to, a, b))) {
            return true;
        }
    }
    return false;
}

// Joins a hole, which runs clockwise, to a ring by the shortest bridge from a corner of the hole;
// false if there is none.
bool join(Ring& ring, const std::vector<Ring>& holes, std::size_t hole)
{
    const Ring& inner = holes[hole];
    const auto right = std::ranges::max_element(inner);
    std::vector<std::size_t> order(ring.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t v) {
        return std::hypot(ring[v][0] - (*right)[0], ring[v][1] - (*right)[1]);
    });
    const auto is_free = [&](std::size_t v) {
        return begins_inside(ring, v, *right) && !blocks(ring, ring[v], *right) &&
               std::none_of(holes.begin() + static_cast<std::ptrdiff_t>(hole), holes.end(),
                            [&](const Ring& other) { return blocks(other, ring[v], *right); });
    };
    const auto found = std::ranges::find_if(order, is_free);
    if (found == order.end()) {
        return false;
    }
    Ring loop(right, inner.end());
    loop.insert(loop.end(), inner.begin(), right + 1);
    loop.push_back(ring[*found]);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(*found) + 1, loop.begin(), loop.end());
    return true;
}

// Whether the corner at place k of a list of corners is an ear: convex, and the others leave its
// triangle free.
bool is_ear(const Ring& ring, const std::vector<int>& left, std::size_t k)
{
    const std::size_t n = left.size();
    const auto corner = [&](std::size_t m) -> const Plan2& { return ring[left[m % n]]; };
    const Plan2& a = corner(k + n - 1);
    const Plan2& b = corner(k);
    const Plan2& c = corner(k + 1);
    if (!(cross(a, b, c) > 0)) {
        return false;
    }
    for (std::size_t m = k + 2; m < k + n - 1; ++m) {
        const Plan2& p = corner(m);
        if (p == b) { // the other end of a bridge: its edges must not run into the ear
            const auto enters = [&](const Plan2& q) {
                return cross(a, b, q) > 0 && cross(b, c, q) > 0;
            };
            if (enters(corner(m + n - 1)) || enters(corner(m + 1))) {
                return false;
            }
        } else if (p != a && p != c && !(cross(corner(m + n - 1), p, corner(m + 1)) > 0) &&
                   cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) {
            return false;
        }
    }
    return true;
}

using Triangle2 = std::array<Plan2, 3>;

std::vector<Triangle2> triangles_in(const Ring& ring)
{
    std::vector<Triangle2> found;
    for (const auto& [i, j, k] : ear_triangles(ring)) {
        const auto corner = [&](int n) { return ring[n]; };
        found.push_back({corner(i), corner(j), corner(k)});
    }
    return found;
}

// The part of a convex ring inside a triangle (Sutherland and Hodgman 1974).
Ring clipped(Ring ring, const Triangle2& t)
{
    for (std::size_t side = 0; side < 3; ++side) {
        Ring kept;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Plan2& p = ring[k];
            const Plan2& q = ring[(k + 1) % ring.size()];
            const double sp = cross(t[side], t[(side + 1) % 3], p);
            const double sq = cross(t[side], t[(side + 1) % 3], q);
            if (sp >= 0) {
                kept.push_back(p);
            }
            if ((sp > 0 && sq < 0) || (sp < 0 && sq > 0)) {
                const double s = sp / (sp - sq);
                kept.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
            }
        }
        ring = std::move(kept);
    }
    return ring;
}

} // namespace

double shared_area(const Ring& a, const Ring& b)
{
    const std::vector<Triangle2> second = triangles_in(b);
    double sum = 0;
    for (const Triangle2& t : triangles_in(a)) {
        for (const Triangle2& u : second) {
            sum += signed_area(clipped({t[0], t[1], t[2]}, u));
        }
    }
    return sum;
}

double cross(const Plan2& o, const Plan2& a, const Plan2& b)
{
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

double signed_area(const Ring& ring)
{
    double sum = 0;
    for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
        sum += cross(ring[0], ring[k], ring[k + 1]);
    }
    return sum / 2;
}

bool holds(const Ring& ring, const Plan2& point)
{
    bool inside = false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        const Plan2& a = ring[k];
        const Plan2& b = ring[(k + 1) % ring.size()];
        if ((a[1] > point[1]) != (b[1] > point[1]) &&
            point[0] < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) {
            inside = !inside;
        }
    }
    return inside;
}

std::string outline_fault(const std::vector<Ring>& rings)
{
    for (std::size_t k = 0; k < rings.size(); ++k) {
        const std::string fault = ring_fault(rings[k]);
        if (!fault.empty()) {
            return k == 0 ? fault : fmt::format("inner ring {}: {}", k, fault);
        }
        if (k > 0 && !holds(rings[0], rings[k][0])) {
            return fmt::format("inner ring {} lies outside the outer ring", k);
        }
        for (std::size_t m = 0; m < k; ++m) {
            const bool nested =
                m > 0 && (holds(rings[m], rings[k][0]) || holds(rings[k], rings[m][0]));
            if (nested || rings_meet(rings[m], rings[k])) {
                return m == 0 ? fmt::format("inner ring {} touches or crosses the outer ring", k)
                              : fmt::format("inner rings {} and {} touch or overlap", m, k);
            }
        }
    }
    return rings.empty() ? "it has no corners" : "";
}

Ring cut_open(const std::vector<Ring>& rings)
{
    std::vector<Ring> holes(rings.begin() + 1, rings.end());
    for (Ring& hole : holes) {
        if (signed_area(hole) > 0) {
            std::ranges::reverse(hole);
        }
    }
    // From the right: between the rightmost corner of a hole and the ring, no later hole can lie
    // everywhere in between.
    std::ranges::stable_sort(holes, std::ranges::greater{},
                             [](const Ring& hole) { return *std::ranges::max_element(hole); });
    Ring ring = rings.front();
    if (signed_area(ring) < 0) {
        std::ranges::reverse(ring);
    }
    for (std::size_t k = 0; k < holes.size(); ++k) {
        if (!join(ring, holes, k)) {
            return {};
        }
    }
    return ring;
}

std::vector<std::array<int, 3>> ear_triangles(const Ring& ring)
{
    const double area = signed_area(ring);
    std::vector<int> left(ring.size());
    std::iota(left.begin(), left.end(), 0);
    if (area < 0) {
        std::ranges::reverse(left);
    }
    std::vector<std::array<int, 3>> triangles;
    double sum = 0;
    while (left.size() >= 3) {
        std::size_t k = 0;
        while (k < left.size() && !is_ear(ring, left, k)) {
            ++k;
        }
        if (k == left.size()) {
            return {};
        }
        const std::size_t n = left.size();
        const std::array<int, 3> ear{left[(k + n - 1) % n], left[k], left[(k + 1) % n]};
        const auto corner = [&](std::size_t m) { return ring[ear[m]]; };
        sum += cross(corner(0), corner(1), corner(2)) / 2;
        triangles.push_back(ear);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    }
    constexpr double round_off = 1e-9; // of the area
    return std::abs(sum - std::abs(area)) <= round_off * sum ? triangles
                                                             : std::vector<std::array<int, 3>>{};
}

} // namespace hyoryu
