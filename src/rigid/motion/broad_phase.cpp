// SPDX-License-Identifier: MIT
#include "broad_phase.hpp"

#include "hyoryu/rigid/box_tree.hpp"
#include "rigid/shapes/compound.hpp"
#include "union_find.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

// Passes of widening the boxes by the speeds of their clusters; if clusters still grow afterwards,
// the additional pairs are found in the next step.
constexpr int widenings = 3;
// Added to every box so that contacts at rest stay paired [units].
constexpr double skin = 1e-4;
// Number of bodies that share a list of found pairs, independent of the number of threads.
constexpr int bodies_per_block = 64;

double skin_of(const ContactMemory& memory)
{
    return skin * memory.geometry.unit;
}

AlignedBox box_of(const Solid& solid, const SolidPose& body, double margin)
{
    const SolidPose pose = pose_of_shape(solid, body);
    const Vec3 centre = pose.x + pose.R * solid.box_centre;
    const Vec3 half =
        solid.form == Form::ball ? solid.box_half : Vec3(pose.R.cwiseAbs() * solid.box_half);
    const Vec3 reach = half + Vec3::Constant(margin);
    return {centre - reach, centre + reach};
}

// How far a point of the body may move within the step.
double travel(const StepContext& context, int k)
{
    const Body& body = context.rigid.bodies[k];
    const Mat3 inverse = inverse_inertia(context.memory.rotors[k], context.memory.poses[k].R);
    const double spin = (inverse * body.angular_momentum).norm() +
                        context.dt * (inverse * context.loads[k].torque).norm();
    const double speed = body.velocity.norm() + context.dt * acceleration(context, k).norm();
    return context.dt * (speed + spin * context.memory.geometry.solids[k].reach);
}

// The pairs of a body with those of higher number whose boxes meet its own.
void add_pairs_of(const StepContext& context, int a, const std::vector<AlignedBox>& boxes,
                  const BoxTree& tree, std::vector<int>& near, std::vector<BodyPair>& pairs)
{
    const ContactMemory& memory = context.memory;
    const std::vector<Body>& bodies = context.rigid.bodies;
    if (bodies[a].left) {
        return;
    }
    find_near(tree, boxes[a], near);
    for (const int b : near) {
        if (b > a && !bodies[b].left && boxes[a].meets(boxes[b]) &&
            (memory.rotors[a].movable || memory.rotors[b].movable)) {
            pairs.push_back({a, b});
        }
    }
}

std::vector<BodyPair> body_pairs(const StepContext& context, const std::vector<double>& margins)
{
    const ContactMemory& memory = context.memory;
    const int n = static_cast<int>(margins.size());
    std::vector<AlignedBox> boxes;
    for (int k = 0; k < n; ++k) {
        boxes.push_back(
            box_of(memory.geometry.solids[k], memory.poses[k], margins[k] + skin_of(memory)));
    }
    const BoxTree tree = tree_over(boxes);
    std::vector<std::vector<BodyPair>> of_block((margins.size() + bodies_per_block - 1) /
                                                bodies_per_block);
    parallel_blocks(0, static_cast<Index>(of_block.size()), [&](Index block) {
        std::vector<int> near;
        const int first = static_cast<int>(block) * bodies_per_block;
        for (int a = first; a < std::min(n, first + bodies_per_block); ++a) {
            add_pairs_of(context, a, boxes, tree, near, of_block[block]);
        }
    });
    std::vector<BodyPair> pairs;
    for (const std::vector<BodyPair>& some : of_block) {
        pairs.insert(pairs.end(), some.begin(), some.end());
    }
    return pairs;
}

bool may_touch(const StepContext& context, int body, const ContactWall& wall, double margin)
{
    const Solid& solid = context.memory.geometry.solids[body];
    const SolidPose& pose = context.memory.poses[body];
    const double thick = skin_of(context.memory);
    const double room =
        margin + thick +
        context.dt * speed_bound(wall.motion, context.start, context.start + context.dt);
    const Vec3 shift = displacement(wall.motion, context.start);
    if (wall.plane) {
        const Vec3 origin = pose_of_shape(solid, pose).x;
        const Vec3 against = -(pose.R.transpose() * wall.plane->normal);
        return wall.plane->normal.dot(origin - wall.plane->point - shift) <
               support(solid, against) + room;
    }
    if (!wall.mesh.triangles.empty()) {
        const AlignedBox box = box_of(solid, pose, room + thick);
        return any_of_near(wall.mesh.tree, {box.low - shift, box.high - shift},
                           [](int) { return true; });
    }
    const SolidPose there{wall.pose.x + shift, wall.pose.q, wall.pose.R};
    const AlignedBox box = box_of(solid, pose, room + thick);
    return std::ranges::any_of(convex_parts(wall.solid), [&](const Solid& part) {
        return box.meets(box_of(part, there, thick));
    });
}

std::vector<BodyPair> wall_pairs(const StepContext& context, const std::vector<double>& margins)
{
    std::vector<BodyPair> pairs;
    const auto& walls = context.memory.geometry.walls;
    for (int k = 0; k < static_cast<int>(margins.size()); ++k) {
        for (int w = 0; context.memory.rotors[k].movable && w < static_cast<int>(walls.size());
             ++w) {
            if (may_touch(context, k, walls[w], margins[k])) {
                pairs.push_back({k, -1 - w});
            }
        }
    }
    return pairs;
}

// Union-find; immovable bodies link nothing.
std::vector<int> roots(const StepContext& context, const std::vector<BodyPair>& pairs)
{
    std::vector<int> parents(context.memory.rotors.size());
    std::iota(parents.begin(), parents.end(), 0);
    for (const BodyPair& pair : pairs) {
        if (context.memory.rotors[pair.a].movable && context.memory.rotors[pair.b].movable) {
            const int a = root_of(parents, pair.a);
            const int b = root_of(parents, pair.b);
            parents[std::max(a, b)] = std::min(a, b);
        }
    }
    for (int k = 0; k < static_cast<int>(parents.size()); ++k) {
        parents[k] = root_of(parents, k);
    }
    return parents;
}

// Twice the largest travel of each cluster, boundaries included.
std::vector<double> widened(const StepContext& context, const std::vector<double>& own,
                            const std::vector<int>& cluster, const std::vector<BodyPair>& walls)
{
    std::vector<double> largest(own.size(), 0);
    for (std::size_t k = 0; k < own.size(); ++k) {
        largest[cluster[k]] = std::max(largest[cluster[k]], own[k]);
    }
    for (const BodyPair& pair : walls) {
        double& most = largest[cluster[pair.a]];
        most = std::max(most,
                        context.dt * speed_bound(context.memory.geometry.walls[-1 - pair.b].motion,
                                                 context.start, context.start + context.dt));
    }
    std::vector<double> margins(own.size());
    for (std::size_t k = 0; k < own.size(); ++k) {
        margins[k] = 2 * largest[cluster[k]];
    }
    return margins;
}

} // namespace

void find_clusters(const StepContext& context)
{
    const int n = static_cast<int>(context.rigid.bodies.size());
    std::vector<double> own;
    for (int k = 0; k < n; ++k) {
        own.push_back(travel(context, k));
    }
    std::vector<BodyPair> pairs = body_pairs(context, own);
    std::vector<BodyPair> walls = wall_pairs(context, own);
    std::vector<int> cluster = roots(context, pairs);
    for (int pass = 0; pass < widenings && !(pairs.empty() && walls.empty()); ++pass) {
        const std::vector<double> margins = widened(context, own, cluster, walls);
        const std::size_t before = pairs.size() + walls.size();
        pairs = body_pairs(context, margins);
        walls = wall_pairs(context, margins);
        cluster = roots(context, pairs);
        if (pairs.size() + walls.size() == before) {
            break;
        }
    }
    auto& clusters = context.memory.clusters;
    clusters.assign(context.rigid.bodies.size(), {});
    for (int k = 0; k < n; ++k) {
        if (context.memory.rotors[k].movable) {
            clusters[cluster[k]].bodies.push_back(k);
        }
    }
    for (const BodyPair& pair : pairs) {
        const int k = context.memory.rotors[pair.a].movable ? pair.a : pair.b;
        clusters[cluster[k]].pairs.push_back(pair);
    }
    for (const BodyPair& pair : walls) {
        clusters[cluster[pair.a]].pairs.push_back(pair);
    }
    std::erase_if(clusters, [](const Cluster& c) { return c.bodies.empty(); });
}

} // namespace hyoryu
