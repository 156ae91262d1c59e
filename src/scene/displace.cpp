// SPDX-License-Identifier: MIT
#include "displace.hpp"

#include "near_points.hpp"
#include "walls.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace hyoryu {

namespace {

// What of a lattice cell lies inside some shapes, and the middle of the rest.
struct Cover {
    double part = 0;
    Vec3 rest{0, 0, 0}; // [m]
};

// Shapes that may displace parts of the same cells, with boxes about what each may cut.
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

// That of the cell about p, by sub-cells.
Cover covered(const Cluster& cluster, const Vec3& p, double spacing)
{
    constexpr int n = 4;
    const int ny = cluster.shapes[0].dimensions == 2 ? 1 : n;
    int inside = 0;
    Vec3 rest = Vec3::Zero();
    for (int k = 0; k < n; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < n; ++i) {
                const Vec3 offset{(i + 0.5) / n - 0.5, ny == 1 ? 0.0 : (j + 0.5) / n - 0.5,
                                  (k + 0.5) / n - 0.5};
                const Vec3 point = p + spacing * offset;
                const bool in = distance_to(cluster, point) < 0;
                inside += in ? 1 : 0;
                rest += in ? Vec3(Vec3::Zero()) : point;
            }
        }
    }
    const int all = n * n * ny;
    return {static_cast<double>(inside) / all, inside < all ? Vec3(rest / (all - inside)) : p};
}

// A particle whose cell the surface of a shape cuts.
struct CutCell {
    std::size_t row = 0;
    double distance = 0;     // of its centre from the surface, negative inside [m]
    Cover covered;           // part of the cell that the shape displaces
    double room = 0;         // to the nearest wall, at most a spacing [m]
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

// Marks as many cut cells as the shape displaces, group after group of neighbours, the deepest of
// each first, of equals those at a wall, where what stays could not give way; what a group is over
// or short of whole particles goes to the next one. One count for all of them could take its last
// particles from one side, which sets the body turning.
void choose(std::vector<CutCell>& cut, std::vector<bool>& gone)
{
    constexpr std::size_t group = 8;
    std::sort(cut.begin(), cut.end(), [](const CutCell& a, const CutCell& b) {
        return std::pair(a.place, a.row) < std::pair(b.place, b.row);
    });
    double displaced = 0;
    std::size_t taken = 0;
    for (std::size_t first = 0; first < cut.size(); first += group) {
        const auto begin = cut.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end =
            cut.begin() + static_cast<std::ptrdiff_t>(std::min(first + group, cut.size()));
        std::sort(begin, end, [](const CutCell& a, const CutCell& b) {
            return std::tuple(a.distance, a.room, a.row) < std::tuple(b.distance, b.room, b.row);
        });
        for (auto cell = begin; cell != end; ++cell) {
            displaced += cell->covered.part;
        }
        const auto wanted = static_cast<std::size_t>(std::llround(displaced));
        for (auto cell = begin; cell != end && taken < wanted; ++cell) {
            gone[cell->row] = true;
            taken += 1;
        }
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

// What stays of the cut cells stands outside the shape, at the pressure of its new depth.
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
    std::size_t kept = 0;
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        if (!gone[k]) {
            filling.fluid[kept] = filling.fluid[k];
            filling.fluid_velocity[kept] = filling.fluid_velocity[k];
            filling.fluid_depth[kept] = filling.fluid_depth[k];
            filling.fluid_pressure[kept] = filling.fluid_pressure[k];
            filling.fluid_cut[kept] = filling.fluid_cut[k];
            ++kept;
        }
    }
    filling.fluid.resize(kept);
    filling.fluid_velocity.resize(kept);
    filling.fluid_depth.resize(kept);
    filling.fluid_pressure.resize(kept);
    filling.fluid_cut.resize(kept);
}

// About the cut cells, whether they keep their particle or not.
void mark(const std::vector<CutCell>& cut, double spacing, Filling& filling)
{
    constexpr double around = 4; // spacings: what evens out what the surface leaves of its cells
    if (cut.empty()) {
        return;
    }
    std::vector<std::uint8_t> marked(filling.fluid.size(), 0);
    for (const CutCell& cell : cut) {
        marked[cell.row] = 1;
    }
    marked = marks_about(filling.fluid, marked, around * spacing);
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

// The bodies that may cut a cell together, all of them in groups.
std::vector<Cluster> clusters_of(const Scene& scene)
{
    std::vector<Cluster> clusters;
    const double spacing = scene.spacing;
    const auto meet = [&](const Bounds& a, const Bounds& b) { // both are a spacing too large
        return (a.min.array() <= b.max.array() - spacing).all() &&
               (b.min.array() <= a.max.array() - spacing).all();
    };
    for (const BodySettings& body : scene.bodies) {
        Cluster joined{{{&body.shape, body.position, body.rotation, scene.dimensions}}, {}};
        Bounds box = bounds(joined.shapes[0]);
        box.min -= Vec3::Constant(spacing);
        box.max += Vec3::Constant(spacing);
        joined.boxes.push_back(box);
        std::erase_if(clusters, [&](const Cluster& other) {
            const bool near =
                std::ranges::any_of(other.boxes, [&](const Bounds& its) { return meet(its, box); });
            if (near) {
                joined.shapes.insert(joined.shapes.end(), other.shapes.begin(), other.shapes.end());
                joined.boxes.insert(joined.boxes.end(), other.boxes.begin(), other.boxes.end());
            }
            return near;
        });
        clusters.push_back(std::move(joined));
    }
    return clusters;
}

void take_out(const Scene& scene, const Cluster& cluster, Filling& filling)
{
    const double spacing = scene.spacing;
    Bounds box;
    for (const Bounds& one : cluster.boxes) {
        box.add(one);
    }
    std::vector<bool> gone(filling.fluid.size(), false);
    std::vector<CutCell> cut;
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        const Vec3& p = filling.fluid[k];
        const double distance = holds(box, p) ? distance_to(cluster, p) : infinity;
        if (distance >= spacing) {
            continue;
        }
        const Cover cover = distance < -spacing ? Cover{1, p} : covered(cluster, p, spacing);
        gone[k] = cover.part == 1;
        if (cover.part > 0 && cover.part < 1) {
            cut.push_back({k, distance, cover, room_at(scene, p), morton((p - box.min) / spacing)});
        }
    }
    choose(cut, gone);
    mark(cut, spacing, filling);
    move_out(scene, cut, gone, filling);
    drop(gone, filling);
}

} // namespace

void take_out_bodies(const Scene& scene, Filling& filling)
{
    for (const Cluster& cluster : clusters_of(scene)) {
        take_out(scene, cluster, filling);
    }
}

} // namespace hyoryu
