// SPDX-License-Identifier: MIT
// Finds near solids by a sweep along x, and casts a ray from each cell of a face to them.
#include "joint_gaps.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

void find_near_walls(JointTables& tables, int b, const Vec3& centre)
{
    BodyJoints& body = tables.bodies[at(b)];
    const double reach = tables.solids[at(b)].reach + tables.reach;
    for (std::size_t w = 0; w < tables.walls.size(); ++w) {
        if (near_wall(tables.walls[w], centre - tables.displaced[w], reach)) {
            body.near.push_back(-1 - static_cast<int>(w));
        }
    }
}

// Sweep along x: tests bodies whose bounding spheres begin left of the right end of this one.
void find_near_bodies(JointTables& tables, const std::vector<Pose>& poses, int b)
{
    std::vector<int>& near = tables.bodies[at(b)].near;
    const std::size_t walls = near.size();
    const Vec3& centre = poses[at(b)].position;
    const double reach = tables.solids[at(b)].reach + tables.reach;
    const double left = centre.x() - reach - 2 * tables.largest_reach;
    auto other = std::lower_bound(tables.along_x.begin(), tables.along_x.end(),
                                  std::pair{left, std::numeric_limits<int>::min()});
    for (; other != tables.along_x.end() && other->first <= centre.x() + reach; ++other) {
        const int o = other->second;
        const double most = reach + tables.solids[at(o)].reach;
        if (o != b && (poses[at(o)].position - centre).squaredNorm() <= sq(most)) {
            near.push_back(o);
        }
    }
    std::sort(near.begin() + static_cast<Index>(walls), near.end());
}

} // namespace

JointTables joint_tables(const Rigid& rigid, double reach)
{
    JointTables tables;
    const int dimensions = rigid.settings.dimensions;
    tables.reach = reach;
    for (const Boundary& boundary : rigid.boundaries) {
        if (!boundary.bodies_only) {
            tables.walls.push_back(ray_wall(boundary, dimensions));
        }
    }
    tables.displaced.resize(tables.walls.size());
    for (const Body& body : rigid.bodies) {
        tables.solids.push_back(ray_solid(body.shape, dimensions));
        tables.largest_reach = std::max(tables.largest_reach, tables.solids.back().reach);
    }
    tables.bodies.resize(rigid.bodies.size());
    tables.along_x.resize(rigid.bodies.size());
    return tables;
}

void find_near(JointTables& tables, const Rigid& rigid, const std::vector<Pose>& poses, double time)
{
    for (std::size_t w = 0; w < tables.walls.size(); ++w) {
        tables.displaced[w] = displacement(rigid.boundaries[w].motion, time);
    }
    for (std::size_t b = 0; b < poses.size(); ++b) {
        const double end = poses[b].position.x() - tables.solids[b].reach;
        tables.along_x[b] = {rigid.bodies[b].left ? infinity : end, static_cast<int>(b)};
    }
    std::ranges::sort(tables.along_x);
    parallel_blocks(0, static_cast<Index>(poses.size()), [&](Index b) {
        tables.bodies[at(b)].near.clear();
        if (rigid.bodies[at(b)].left) {
            return;
        }
        find_near_walls(tables, static_cast<int>(b), poses[at(b)].position);
        find_near_bodies(tables, poses, static_cast<int>(b));
    });
}

OtherHit first_other(const JointTables& tables, const std::vector<Pose>& poses, int b,
                     const Ray& ray, const RayPart& part)
{
    OtherHit first;
    const BodyJoints& body = tables.bodies[at(b)];
    const auto keep = [&](int other, const std::optional<RayHit>& hit) {
        if (hit && hit->enter < first.hit.enter) {
            first = {other, *hit};
        }
    };
    for (const int other : body.near) {
        if (other < 0) {
            const auto w = at(-1 - other);
            keep(other,
                 enters(tables.walls[w], {ray.origin - tables.displaced[w], ray.direction}, part));
            continue;
        }
        const Pose& pose = poses[at(other)];
        if (!comes_near(ray, part, pose.position, tables.solids[at(other)].reach)) {
            continue;
        }
        const Quat back = pose.orientation.conjugate();
        auto hit = enters(tables.solids[at(other)],
                          {back * (ray.origin - pose.position), back * ray.direction});
        if (hit) {
            hit->normal = pose.orientation * hit->normal;
        }
        keep(other, hit);
    }
    return first;
}

double overlap_of(const JointTables& tables)
{
    return 0.25 * tables.reach;
}

Facing facing(const JointTables& tables, const std::vector<Pose>& poses, int b, const Ray& ray)
{
    constexpr double steepest = -0.8; // cosine of the two normals, at most
    const RayPart part{-overlap_of(tables), tables.reach};
    const OtherHit found = first_other(tables, poses, b, ray, part);
    const double gap = found.hit.enter;
    if (found.other == JointNode::none || gap >= part.to) {
        return {};
    }
    if (gap < part.from) {
        return {JointNode::none, gap, false};
    }
    const bool front = found.hit.normal.dot(ray.direction) < steepest;
    return {front ? found.other : JointNode::none, gap, !front};
}

bool find_gaps(JointTables& tables, const std::vector<Pose>& poses, int b, const Joins& joins)
{
    BodyJoints& body = tables.bodies[at(b)];
    const Mat3 R = poses[at(b)].orientation.toRotationMatrix();
    bool any = false;
    JointKind kind = JointKind::none; // of the joint between a face and another solid
    int face = -1;
    int other = JointNode::none;
    body.nodes.resize(body.faces.cells.size());
    for (std::size_t c = 0; c < body.nodes.size(); ++c) {
        const JointCell& cell = body.faces.cells[c];
        JointNode& node = body.nodes[c];
        node = {.place = poses[at(b)].position + R * cell.centre,
                .normal = R * body.faces.faces[at(cell.face)].normal};
        const Facing found = facing(tables, poses, b, {node.place, node.normal});
        node.open = found.nothing;
        if (found.other != JointNode::none) {
            if (cell.face != face || found.other != other) {
                kind = joins(b, found.other, node.normal);
                face = cell.face;
                other = found.other;
            }
            node.other = kind == JointKind::none ? JointNode::none : found.other;
            node.sealed = kind == JointKind::sealed;
            node.gap = found.gap;
            any = any || kind != JointKind::none;
        }
    }
    return any;
}

} // namespace hyoryu
