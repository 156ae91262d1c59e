// SPDX-License-Identifier: MIT
// True overlaps at every row.
#include "convex.hpp"
#include "judge.hpp"
#include "mass.hpp"
#include "second_opinion.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace witness {

namespace {

/// A wall as what bodies can overlap with: a half-space, convex parts, or a surface.
struct WallParts {
    const Solid* wall = nullptr;
    std::vector<Convex> parts; // in space at time 0, or in the axes of the wall
    bool own_axes = false;
    bool surface = false; // of triangles that enclose a solid
};

WallParts basin_parts(const Solid& wall, const Vec3& low, const Vec3& high,
                      const std::array<bool, 6>& open, double thickness, int dimensions)
{
    WallParts made{.wall = &wall};
    for (std::size_t side = 0; side < 6; ++side) {
        const auto axis = static_cast<Eigen::Index>(side / 2);
        if (open[side] || (dimensions == 2 && axis == 1)) {
            continue;
        }
        Vec3 from = low, to = high;
        for (Eigen::Index k = 0; k < 3; ++k) {
            const auto m = static_cast<std::size_t>(k);
            from[k] -= open[2 * m] ? 0 : thickness;
            to[k] += open[2 * m + 1] ? 0 : thickness;
        }
        (side % 2 == 0 ? to : from)[axis] = (side % 2 == 0 ? low : high)[axis];
        made.parts.push_back(box_between(from, to, dimensions));
    }
    return made;
}

WallParts wall_parts(const Solid& wall, int dimensions)
{
    if (wall.kind == Kind::plane) {
        return {.wall = &wall};
    }
    if (wall.kind == Kind::basin) {
        return basin_parts(wall, wall.low, wall.high, wall.open, wall.thickness, dimensions);
    }
    if (wall.kind == Kind::round_basin) { // bodies meet the box about it, as documented
        const Vec3 half = Vec3::Constant(wall.radius);
        return basin_parts(wall, wall.position - half, wall.position + half, {}, wall.thickness,
                           dimensions);
    }
    WallParts made{.wall = &wall, .own_axes = true};
    if (wall.kind != Kind::mesh) {
        made.parts = parts_of(wall, dimensions);
    } else if (is_convex(wall.mesh)) {
        made.parts = {hull_of(wall.mesh)};
    } else {
        made.surface = true;
        for (const auto& t : wall.mesh.triangles) {
            const auto corner = [&](std::size_t k) {
                return wall.mesh.corners[static_cast<std::size_t>(t[k])];
            };
            made.parts.push_back(triangle_of(corner(0), corner(1), corner(2)));
        }
    }
    return made;
}

class Overlaps {
public:
    Overlaps(const Scene& scene, double bound) : scene_(scene), bound_(bound)
    {
        for (const Solid& body : scene.bodies) {
            bodies_.push_back(parts_of(body, scene.dimensions));
            double reach = 0;
            for (const Convex& part : bodies_.back()) {
                reach = std::max(reach, (part.middle + body.middle).norm() + part.reach);
            }
            reach_.push_back(reach);
        }
        for (const Solid& wall : scene.walls) {
            walls_.push_back(wall_parts(wall, scene.dimensions));
        }
    }

    OverlapFinding over(const std::vector<Row>& rows)
    {
        BroadPhase broad(reach_);
        for (const Row& row : rows) {
            begin(row);
            std::vector<Vec3> centres;
            for (const State& state : row.bodies) {
                centres.push_back(state.x);
            }
            broad.pairs(centres, [&](std::size_t i, std::size_t j) { meet_bodies(row, i, j); });
            for (std::size_t b = 0; b < bodies_.size(); ++b) {
                const bool meets = !scene_.bodies[b].held && row.bodies[b].there;
                for (std::size_t w = 0; w < walls_.size() && meets; ++w) {
                    meet_wall(row, b, w);
                }
            }
            found_.rows_over_bound += row_worst_ > bound_ ? 1 : 0;
            found_.first_row = found_.rows == 0 ? row_worst_ : found_.first_row;
            ++found_.rows;
        }
        return found_;
    }

private:
    void begin(const Row& row)
    {
        turns_.clear();
        for (const State& state : row.bodies) {
            turns_.push_back(state.q.toRotationMatrix());
        }
        row_worst_ = 0;
    }

    Placed place(const Row& row, std::size_t body, const Convex& part) const
    {
        return {&part, turns_[body],
                row.bodies[body].x + turns_[body] * scene_.bodies[body].middle};
    }

    void note(double depth, double time, const std::string& a, const std::string& b, double fcl)
    {
        row_worst_ = std::max(row_worst_, depth);
        if (depth > found_.worst) {
            found_.worst = depth;
            found_.time = time;
            found_.a = a;
            found_.b = b;
            found_.fcl = fcl;
        }
    }

    void meet(double time, const Placed& a, const Placed& b, const std::string& name,
              const std::string& other)
    {
        const double apart = a.part->reach + b.part->reach;
        if ((a.middle() - b.middle()).squaredNorm() > apart * apart) {
            return;
        }
        ++found_.looked_at;
        Vec3& warm = normals_[{a.part, b.part}];
        const Depth depth = overlap(a, b, warm, std::max(negligible, row_worst_));
        warm = depth.normal;
        if (depth.value > std::max(negligible, row_worst_)) {
            const double fcl =
                depth.value > found_.worst ? depth_by_fcl(a, b, scene_.dimensions) : 0;
            note(depth.value, time, name, other, fcl);
        }
    }

    void meet_bodies(const Row& row, std::size_t i, std::size_t j)
    {
        const bool both_held = scene_.bodies[i].held && scene_.bodies[j].held;
        if (both_held || !row.bodies[i].there || !row.bodies[j].there) {
            return;
        }
        for (const Convex& a : bodies_[i]) {
            for (const Convex& b : bodies_[j]) {
                meet(row.time, place(row, i, a), place(row, j, b), scene_.bodies[i].name,
                     scene_.bodies[j].name);
            }
        }
    }

    void meet_wall(const Row& row, std::size_t body, std::size_t w)
    {
        const WallParts& wall = walls_[w];
        const Vec3 shift = displacement(wall.wall->path, row.time);
        const Mat3 turn =
            wall.own_axes ? wall.wall->rotation.toRotationMatrix() : Mat3(Mat3::Identity());
        const Vec3 origin = wall.own_axes ? Vec3(wall.wall->position + shift) : shift;
        for (const Convex& part : bodies_[body]) {
            const Placed placed = place(row, body, part);
            const std::string& name = scene_.bodies[body].name;
            if (wall.wall->kind == Kind::plane) {
                const Vec3& n = wall.wall->normal;
                ++found_.looked_at;
                const double depth = reach_along(placed, -n) + n.dot(wall.wall->point + shift);
                note(depth > negligible ? depth : 0, row.time, name, wall.wall->name, depth);
            }
            for (const Convex& other : wall.parts) {
                meet(row.time, placed, {&other, turn, origin}, name, wall.wall->name);
            }
        }
        if (wall.surface) {
            const Vec3 p = turn.transpose() * (row.bodies[body].x - origin);
            if (bounds_of(wall.wall->mesh).contains(p) &&
                winding_number(wall.wall->mesh, p) > 0.5) {
                note(distance_to(wall.wall->mesh, p), row.time, scene_.bodies[body].name,
                     wall.wall->name, 0);
            }
        }
    }

    struct Hash {
        std::size_t operator()(const std::pair<const Convex*, const Convex*>& pair) const
        {
            return std::hash<const void*>()(pair.first) * 31 +
                   std::hash<const void*>()(pair.second);
        }
    };

    const Scene& scene_;
    double bound_;
    std::vector<std::vector<Convex>> bodies_;
    std::vector<WallParts> walls_;
    std::vector<double> reach_;
    std::vector<Mat3> turns_;
    std::unordered_map<std::pair<const Convex*, const Convex*>, Vec3, Hash> normals_;
    OverlapFinding found_;
    double row_worst_ = 0;
};

} // namespace

OverlapFinding find_overlaps(const Scene& scene, const std::vector<Row>& rows, double bound)
{
    return Overlaps(scene, bound).over(rows);
}

} // namespace witness
