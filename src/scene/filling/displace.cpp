// SPDX-License-Identifier: MIT
#include "displace.hpp"

#include "scene/surfaces/near_points.hpp"
#include "walls.hpp"

#include "hyoryu/rigid/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace hyoryu {

namespace {

// The share of a lattice cell inside shapes, and the centroid of the remaining part.
struct Cover {
    double part = 0;
    Vec3 rest{0, 0, 0}; // [m]
};

// Shapes that may displace parts of the same cells, with the bounds of the cells that each may cut.
struct Cluster {
    std::vector<Placed> shapes;
    std::vector<Bounds> boxes;
};

bool holds(const Bounds& box, const Vec3& p)
{
    return (p.array() >= box.min.array()).all() && (p.array() <= box.max.array()).all();
}

// Signed distance of the nearest shape; infinity outside of all boxes [m].
double distance_to(const Cluster& cluster, const Vec3& p)
{
    double distance = infinity;
    for (std::size_t k = 0; k < cluster.shapes.size(); ++k) {
        if (holds(cluster.boxes[k], p)) {
            distance = std::min(distance, signed_distance(cluster.shapes[k], p));
        }
    }
    return distance;
}

// The share of a sub-cell inside the shapes of a cluster by the distance of its middle from each:
// exact for surfaces along its faces, also between shapes that touch there.
double share_inside(const Cluster& cluster, const Vec3& middle, double edge)
{
    double inside = 0;
    for (std::size_t k = 0; k < cluster.shapes.size(); ++k) {
        if (holds(cluster.boxes[k], middle)) {
            const double depth = -signed_distance(cluster.shapes[k], middle);
            inside += std::clamp(0.5 + depth / edge, 0.0, 1.0);
        }
    }
    return std::min(inside, 1.0);
}

// The cover of the cell about p, computed from sub-cells.
Cover covered(const Cluster& cluster, const Vec3& p, double edge)
{
    constexpr int n = 4;
    const int ny = cluster.shapes[0].dimensions == 2 ? 1 : n;
    double inside = 0;
    Vec3 rest = Vec3::Zero();
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < n; ++i) {
                const Vec3 offset{(i + 0.5) / n - 0.5, ny == 1 ? 0.0 : (j + 0.5) / n - 0.5,
                                  (k + 0.5) / n - 0.5};
                const Vec3 point = p + edge * offset;
                const double part = share_inside(cluster, point, edge / n);
                inside += part;
                rest += (1 - part) * point;
            }
        }
    }
    constexpr double round_off = 1e-9;
    const double all = n * n * ny;
    inside = inside > (1 - round_off) * all ? all : (inside < round_off * all ? 0 : inside);
    return {inside / all, inside < all ? Vec3(rest / (all - inside)) : p};
}

// A particle whose cell the surface of a shape cuts.
struct CutCell {
    std::size_t row = 0;
    double distance = 0;     // of its centre from the surface, negative inside [m]
    Cover covered;           // part of the cell that the shape displaces
    double room = 0;         // to the nearest wall, at most a spacing [m]
    bool shut_in = false;    // the remaining part is a sliver between the shape and a wall
    std::uint64_t place = 0; // along a curve on which neighbours are near (Morton 1966)
};

// The bits of the cell numbers in turns.
std::uint64_t morton(const Vec3& cells)
{
    constexpr int bits = 20;
    std::uint64_t place = 0;
    for (int bit = 0; bit < bits; ++bit) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto number = static_cast<std::uint64_t>(cells[axis]);
            place |= ((number >> bit) & 1U) << (3 * bit + axis);
        }
    }
    return place;
}

// The end of the group that begins at `first`: after eight cells, or at a jump of the curve, since
// cells on two sides of a shape, or beside it and in a gap, cannot balance each other.
std::size_t end_of_group(const std::vector<CutCell>& cut, std::size_t first,
                         const std::vector<Vec3>& points, double spacing)
{
    constexpr std::size_t most = 8;
    constexpr double jump = 3; // spacings
    std::size_t end = first + 1;
    while (end < cut.size() && end - first < most &&
           (points[cut[end].row] - points[cut[end - 1].row]).norm() < jump * spacing) {
        ++end;
    }
    return end;
}

// Marks the number of cut cells that the shape displaces, group by group of neighbours, the deepest
// cells of each first and, among equals, those at a wall, since particles left there could not move
// away. The fraction of a particle by which a group is over or short is carried to the next group.
// A shut-in cell has no place for a particle: its particle is removed whatever the count, and
// another one is kept. A single count over all cells could take its last particles from one side,
// which would set the body turning.
void choose(std::vector<CutCell>& cut, const std::vector<Vec3>& points, double spacing,
            std::vector<bool>& gone)
{
    std::sort(cut.begin(), cut.end(), [](const CutCell& a, const CutCell& b) {
        return std::pair(a.place, a.row) < std::pair(b.place, b.row);
    });
    double displaced = 0;
    std::size_t taken = 0;
    for (std::size_t first = 0; first < cut.size();) {
        const std::size_t last = end_of_group(cut, first, points, spacing);
        const auto begin = cut.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = cut.begin() + static_cast<std::ptrdiff_t>(last);
        std::sort(begin, end, [](const CutCell& a, const CutCell& b) {
            return std::tuple(!a.shut_in, a.distance, a.room, a.row) <
                   std::tuple(!b.shut_in, b.distance, b.room, b.row);
        });
        for (auto cell = begin; cell != end; ++cell) {
            displaced += cell->covered.part;
        }
        constexpr double round_off = 1e-9; // a half is rounded up in spite of round-off
        const auto wanted = at(std::llround(displaced + round_off));
        for (auto cell = begin; cell != end && (cell->shut_in || taken < wanted); ++cell) {
            gone[cell->row] = true;
            taken += 1;
        }
        first = last;
    }
}

// To the nearest wall, at most a spacing [m].
double room_at(const Scene& scene, const Vec3& p)
{
    double room = scene.spacing;
    for (const Wall& wall : scene.walls) {
        room = std::min(room, -depth_behind(wall, p, scene.dimensions));
    }
    return room;
}

// The remaining particles of cut cells are placed outside the shape, at the pressure of their new
// depth.
void move_out(const Scene& scene, const std::vector<CutCell>& cut, const std::vector<bool>& gone,
              Filling& filling)
{
    for (const CutCell& cell : cut) {
        if (cell.distance < 0 && !gone[cell.row]) {
            Vec3& p = filling.fluid[cell.row];
            if (scene.gravity.norm() > 0) {
                filling.fluid_depth[cell.row] +=
                    height(scene, p) - height(scene, cell.covered.rest);
            }
            p = cell.covered.rest;
        }
    }
}

void drop(const std::vector<bool>& gone, Filling& filling)
{
    const auto keep = [&](auto& values) {
        std::size_t kept = 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            if (!gone[k]) {
                values[kept++] = values[k];
            }
        }
        values.resize(kept);
    };
    keep(filling.fluid);
    keep(filling.fluid_number);
    keep(filling.fluid_velocity);
    keep(filling.fluid_depth);
    keep(filling.fluid_pressure);
    keep(filling.fluid_cut);
}

// Marks the fluid about the cut cells, whether these keep their particle or not.
void mark(const std::vector<CutCell>& cut, double spacing, Filling& filling)
{
    constexpr double around = 4; // spacings: the region that evens out the errors of cut cells
    if (cut.empty()) {
        return;
    }
    std::vector<Vec3> places;
    for (const CutCell& cell : cut) {
        places.push_back(filling.fluid[cell.row]);
    }
    const auto marked = marks_near(filling.fluid, places, around * spacing);
    for (std::size_t k = 0; k < marked.size(); ++k) {
        filling.fluid_cut[k] = std::max(filling.fluid_cut[k], marked[k]);
    }
}

} // namespace

double height(const Scene& scene, const Vec3& p)
{
    const double g = scene.gravity.norm();
    return g > 0 ? -scene.gravity.dot(p) / g : p.z();
}

namespace {

// Bounds of the bodies, enlarged by a spacing.
std::vector<Bounds> boxes_of(const std::vector<Placed>& shapes, double spacing)
{
    std::vector<Bounds> boxes;
    for (const Placed& shape : shapes) {
        Bounds box = bounds(shape);
        box.min -= Vec3::Constant(spacing);
        box.max += Vec3::Constant(spacing);
        boxes.push_back(box);
    }
    return boxes;
}

// For each body, the earlier bodies with which it may cut a cell: with many bodies, testing all
// pairs takes too long.
std::vector<std::vector<std::size_t>> near_before(const std::vector<Bounds>& boxes, double spacing)
{
    const auto meet = [&](const Bounds& a, const Bounds& b) { // both are a spacing too large
        return (a.min.array() <= b.max.array() - spacing).all() &&
               (b.min.array() <= a.max.array() - spacing).all();
    };
    std::vector<AlignedBox> aligned;
    for (const Bounds& box : boxes) {
        aligned.push_back({box.min, box.max});
    }
    const BoxTree tree = tree_over(aligned);
    std::vector<std::vector<std::size_t>> near(boxes.size());
    std::vector<int> found;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        find_near(tree, aligned[k], found);
        for (const int other : found) {
            if (at(other) < k && meet(boxes[k], boxes[at(other)])) {
                near[k].push_back(at(other));
            }
        }
    }
    return near;
}

// Groups that are joined body by body: each body is a new root of the groups that it meets.
class Groups {
public:
    explicit Groups(std::size_t bodies) : above_(bodies), below_(bodies)
    {
        std::iota(above_.begin(), above_.end(), std::size_t(0));
    }
    void join(std::size_t body, const std::vector<std::size_t>& near)
    {
        for (const std::size_t other : near) {
            below_[body].push_back(root(other));
        }
        std::ranges::sort(below_[body]);
        const auto rest = std::ranges::unique(below_[body]);
        below_[body].erase(rest.begin(), rest.end());
        for (const std::size_t other : below_[body]) {
            above_[other] = body;
        }
    }
    bool is_root(std::size_t body) const { return above_[body] == body; }
    /// The bodies of a group: its root, then those of each group that it joined.
    std::vector<std::size_t> members(std::size_t of_root) const
    {
        std::vector<std::size_t> found;
        std::vector<std::size_t> left{of_root};
        while (!left.empty()) {
            const std::size_t body = left.back();
            left.pop_back();
            found.push_back(body);
            left.insert(left.end(), below_[body].rbegin(), below_[body].rend());
        }
        return found;
    }

private:
    std::size_t root(std::size_t body)
    {
        while (above_[body] != body) {
            above_[body] = above_[above_[body]];
            body = above_[body];
        }
        return body;
    }
    std::vector<std::size_t> above_;
    std::vector<std::vector<std::size_t>> below_;
};

// The bodies that may cut a cell together, all of them in groups.
std::vector<Cluster> clusters_of(const Scene& scene)
{
    std::vector<Placed> shapes;
    for (const BodySettings& body : scene.bodies) {
        shapes.push_back(placed(body, scene.dimensions));
    }
    const std::vector<Bounds> boxes = boxes_of(shapes, scene.spacing);
    const std::vector<std::vector<std::size_t>> near = near_before(boxes, scene.spacing);
    Groups groups(shapes.size());
    for (std::size_t body = 0; body < shapes.size(); ++body) {
        groups.join(body, near[body]);
    }
    std::vector<Cluster> clusters;
    for (std::size_t body = 0; body < shapes.size(); ++body) {
        if (!groups.is_root(body)) {
            continue;
        }
        Cluster cluster;
        for (const std::size_t member : groups.members(body)) {
            cluster.shapes.push_back(shapes[member]);
            cluster.boxes.push_back(boxes[member]);
        }
        clusters.push_back(std::move(cluster));
    }
    return clusters;
}

bool overlap(const Bounds& a, const Bounds& b)
{
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

// The shapes of a cluster that reach into bounds, in their order.
Cluster within(const Cluster& cluster, const Bounds& bounds)
{
    Cluster found;
    for (std::size_t k = 0; k < cluster.shapes.size(); ++k) {
        if (overlap(cluster.boxes[k], bounds)) {
            found.shapes.push_back(cluster.shapes[k]);
            found.boxes.push_back(cluster.boxes[k]);
        }
    }
    return found;
}

Bounds box_of(const Cluster& cluster)
{
    Bounds box;
    for (const Bounds& one : cluster.boxes) {
        box.add(one);
    }
    return box;
}

// Bounds of the cells of the fluid. `elsewhere`: bounds of the fluid that is not in `filling`.
Bounds cells_of(const Filling& filling, const Bounds& elsewhere, double spacing)
{
    Bounds fluid;
    if (!elsewhere.empty()) {
        fluid.add(elsewhere.min - Vec3::Constant(spacing));
        fluid.add(elsewhere.max + Vec3::Constant(spacing));
    }
    for (const Vec3& p : filling.fluid) {
        fluid.add(p - Vec3::Constant(spacing));
        fluid.add(p + Vec3::Constant(spacing));
    }
    return fluid;
}

// `box`: about the whole cluster, of which `cluster` are the shapes that reach the fluid.
void take_out(const Scene& scene, const Bounds& box, const Cluster& cluster, Filling& filling)
{
    const double spacing = scene.spacing;
    const double cell_volume = particle_volume(scene, filling);
    const double edge = std::pow(cell_volume, 1.0 / scene.dimensions);
    std::vector<bool> gone(filling.fluid.size(), false);
    std::vector<CutCell> cut;
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        const Vec3& p = filling.fluid[k];
        const double distance = holds(box, p) ? distance_to(cluster, p) : infinity;
        if (distance >= spacing) {
            continue;
        }
        const Bounds cell{p - Vec3::Constant(spacing), p + Vec3::Constant(spacing)};
        const Cover cover =
            distance < -spacing ? Cover{1, p} : covered(within(cluster, cell), p, edge);
        filling.fluid_volume -= cover.part * cell_volume;
        gone[k] = cover.part == 1;
        if (cover.part > 0 && cover.part < 1) {
            cut.push_back({.row = k,
                           .distance = distance,
                           .covered = cover,
                           .room = room_at(scene, p),
                           .shut_in = distance < 0 && room_at(scene, cover.rest) < spacing / 4,
                           .place = morton((p - box.min) / spacing)});
        }
    }
    choose(cut, filling.fluid, spacing, gone);
    mark(cut, spacing, filling);
    move_out(scene, cut, gone, filling);
    drop(gone, filling);
}

} // namespace

void take_out_bodies(const Scene& scene, const Bounds& elsewhere, Filling& filling)
{
    Bounds fluid = cells_of(filling, elsewhere, scene.spacing);
    for (const Cluster& cluster : clusters_of(scene)) {
        const Cluster reaching = within(cluster, fluid);
        if (!reaching.shapes.empty()) {
            take_out(scene, box_of(cluster), reaching, filling);
            fluid = cells_of(filling, elsewhere, scene.spacing);
        }
    }
}

} // namespace hyoryu
