// SPDX-License-Identifier: MIT
#include "groups.hpp"
#include "union_find.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hyoryu {

namespace {

// Repetitions after which the whole cluster is advanced as one group.
constexpr int most_repetitions = 4;
// Bound on the angular speed within a sub-step, relative to the larger one at its ends [1]: a body
// turns by at most 0.3 rad, and its angular velocity changes direction.
constexpr double more_turn = 1.2;
// Two edges whose cross product is shorter than this count as parallel [1].
constexpr double parallel_edges_of_blocks = 1e-6;

struct Direction {
    Vec3 normal{0, 0, 1}; // from b to a
    double gap = -infinity;
};

// The oriented box around a solid, or the ball that it is.
struct Block {
    Vec3 centre;
    Mat3 axes;
    Vec3 half;
    double radius = 0;
};

Block block_of(const ContactMemory& memory, int k)
{
    const Solid& solid = memory.geometry.solids[k];
    const SolidPose pose = pose_of_shape(solid, memory.poses[k]);
    const bool round = solid.form == Form::ball;
    return {pose.x + pose.R * solid.box_centre, pose.R, round ? Vec3::Zero() : solid.box_half,
            round ? solid.radius : 0};
}

void look_along(const Vec3& n, const Block& a, const Block& b, Direction& best)
{
    const Vec3 apart = a.centre - b.centre;
    const double along = n.dot(apart);
    const auto reach = [&](const Block& block) {
        return block.radius + (block.axes.transpose() * n).cwiseAbs().dot(block.half);
    };
    const double gap = std::abs(along) - reach(a) - reach(b);
    if (gap > best.gap) {
        best = {along < 0 ? Vec3(-n) : n, gap};
    }
}

// The direction in which two boxes are farthest apart, of those that separate boxes.
Direction widest_gap(const Block& a, const Block& b)
{
    Direction best;
    const Vec3 between = a.centre - b.centre;
    if (between.norm() > 0) {
        look_along(between.normalized(), a, b, best);
    }
    for (int m = 0; m < 3; ++m) {
        look_along(a.axes.col(m), a, b, best);
        look_along(b.axes.col(m), a, b, best);
    }
    for (int m = 0; m < 3 && best.gap <= 0; ++m) {
        for (int n = 0; n < 3; ++n) {
            const Vec3 cross = a.axes.col(m).cross(b.axes.col(n));
            if (cross.norm() > parallel_edges_of_blocks) {
                look_along(cross.normalized(), a, b, best);
            }
        }
    }
    return best;
}

// The least of b t + c t^2 / 2 within [0, dt].
double least_of(double b, double c, double dt)
{
    double least = std::min(0.0, dt * (b + 0.5 * c * dt));
    if (c > 0 && b < 0 && -b < c * dt) {
        least = std::min(least, -0.5 * sq(b) / c);
    }
    return least;
}

Link link_of(const StepContext& context, const BodyPair& pair)
{
    const ContactMemory& memory = context.memory;
    const auto [n, gap] = widest_gap(block_of(memory, pair.a), block_of(memory, pair.b));
    Link link{pair.a, pair.b, n, gap};
    const auto& bodies = context.rigid.bodies;
    link.shift =
        least_of(n.dot(bodies[pair.a].velocity - bodies[pair.b].velocity),
                 n.dot(acceleration(context, pair.a) - acceleration(context, pair.b)), context.dt);
    return link;
}

// How far the motion of a body beyond its free path goes against the direction [m].
double towards(const ContactMemory& memory, int k, const Vec3& n)
{
    const Deviation& deviation = memory.deviations[k];
    const double along = (n.array() < 0).select(deviation.high, deviation.low).dot(n);
    return -along + memory.geometry.solids[k].reach * std::min(deviation.turn, 2.0);
}

bool stays_apart(const ContactMemory& memory, const Link& link)
{
    const Vec3& n = link.normal;
    return link.gap + link.shift - towards(memory, link.a, n) - towards(memory, link.b, -n) >
           clearly_apart(memory.geometry);
}

// Sets the deviations to those of free motion from the start of the step.
void expect_free_motion(const StepContext& context, const Cluster& cluster)
{
    ContactMemory& memory = context.memory;
    for (const int k : cluster.bodies) {
        const Mat3 inverse = inverse_inertia(memory.rotors[k], memory.poses[k].R);
        const double spin = (inverse * context.rigid.bodies[k].angular_momentum).norm() +
                            context.dt * (inverse * context.loads[k].torque).norm();
        memory.deviations[k] = {};
        memory.deviations[k].turn = more_turn * context.dt * spin;
    }
}

ClusterStart start_of(const StepContext& context, const Cluster& cluster)
{
    ClusterStart start;
    for (const int k : cluster.bodies) {
        start.poses.push_back(context.memory.poses[k]);
        start.velocities.push_back(context.rigid.bodies[k].velocity);
        start.momenta.push_back(context.rigid.bodies[k].angular_momentum);
    }
    return start;
}

void put_back(const StepContext& context, const Cluster& all, const ClusterStart& start,
              const Cluster& group)
{
    for (const int k : group.bodies) {
        const auto m =
            static_cast<std::size_t>(std::ranges::lower_bound(all.bodies, k) - all.bodies.begin());
        context.memory.poses[k] = start.poses[m];
        context.memory.events[k] = 0;
        context.rigid.bodies[k].velocity = start.velocities[m];
        context.rigid.bodies[k].angular_momentum = start.momenta[m];
    }
}

void join(std::vector<int>& parents, int a, int b)
{
    const int root_a = root_of(parents, a);
    const int root_b = root_of(parents, b);
    parents[std::max(root_a, root_b)] = std::min(root_a, root_b);
}

// The groups given by the union-find roots. A group keeps its outcome unless it was joined with
// another group.
std::vector<Outcome> groups_of(const StepContext& context, const Cluster& cluster,
                               std::vector<int>& parents, std::vector<Outcome>& last)
{
    ContactMemory& memory = context.memory;
    std::vector<Outcome> groups;
    memory.island_of_root.assign(memory.rotors.size(), -1);
    for (const int k : cluster.bodies) {
        int& index = memory.island_of_root[root_of(parents, k)];
        if (index < 0) {
            index = static_cast<int>(groups.size());
            groups.emplace_back();
        }
        groups[index].cluster.bodies.push_back(k);
    }
    const auto group_of = [&](int body) -> Outcome& {
        return groups[memory.island_of_root[root_of(parents, body)]];
    };
    for (const BodyPair& pair : cluster.pairs) {
        const bool moves = memory.rotors[pair.a].movable;
        const bool both = moves && pair.b >= 0 && memory.rotors[pair.b].movable;
        if (!both || root_of(parents, pair.a) == root_of(parents, pair.b)) {
            group_of(moves ? pair.a : pair.b).cluster.pairs.push_back(pair);
        }
    }
    for (Outcome& old : last) {
        Outcome& group = group_of(old.cluster.bodies[0]);
        if (group.cluster.bodies.size() == old.cluster.bodies.size()) {
            group = std::move(old);
        }
    }
    return groups;
}

// The links between movable bodies of a cluster that the broad phase paired.
std::vector<Link> links_of(const StepContext& context, const Cluster& cluster)
{
    const std::vector<Rotor>& rotors = context.memory.rotors;
    std::vector<Link> links;
    for (const BodyPair& pair : cluster.pairs) {
        if (pair.b >= 0 && rotors[pair.a].movable && rotors[pair.b].movable) {
            links.push_back(link_of(context, pair));
        }
    }
    return links;
}

// Joins bodies that do not stay apart; returns whether any of them were not joined before.
bool join_near(const ContactMemory& memory, const std::vector<Link>& links,
               std::vector<int>& parents)
{
    bool any = false;
    for (const Link& link : links) {
        if (root_of(parents, link.a) != root_of(parents, link.b) && !stays_apart(memory, link)) {
            join(parents, link.a, link.b);
            any = true;
        }
    }
    return any;
}

bool is_one(const Cluster& cluster, std::vector<int>& parents)
{
    return std::ranges::all_of(cluster.bodies, [&](int k) {
        return root_of(parents, k) == root_of(parents, cluster.bodies[0]);
    });
}

} // namespace

Splitting split(const StepContext& context, const Cluster& cluster)
{
    ContactMemory& memory = context.memory;
    memory.deviations.resize(memory.rotors.size());
    memory.parents_of_groups.resize(memory.rotors.size());
    for (const int k : cluster.bodies) {
        memory.parents_of_groups[k] = k;
    }
    Splitting splitting{.cluster = &cluster, .links = links_of(context, cluster)};
    expect_free_motion(context, cluster);
    join_near(memory, splitting.links, memory.parents_of_groups);
    splitting.whole = is_one(cluster, memory.parents_of_groups);
    if (!splitting.whole) {
        splitting.start = start_of(context, cluster);
    }
    return splitting;
}

void regroup(const StepContext& context, Splitting& splitting)
{
    const Cluster& cluster = *splitting.cluster;
    if (splitting.whole) {
        splitting.groups = {{.cluster = cluster}};
        return;
    }
    splitting.groups =
        groups_of(context, cluster, context.memory.parents_of_groups, splitting.groups);
    for (const Outcome& group : splitting.groups) {
        if (!group.done) {
            put_back(context, cluster, splitting.start, group.cluster);
        }
    }
}

void advance_group(const StepContext& context, Outcome& group, const AdvanceCluster& advance)
{
    ContactMemory& memory = context.memory;
    for (const int k : group.cluster.bodies) {
        memory.deviations[k] = {memory.poses[k].x, context.rigid.bodies[k].velocity};
    }
    advance_apart(context, group, advance);
}

bool join_met(const StepContext& context, Splitting& splitting)
{
    std::vector<int>& parents = context.memory.parents_of_groups;
    if (!join_near(context.memory, splitting.links, parents)) {
        return false;
    }
    if (splitting.repetition++ == most_repetitions) {
        for (const int k : splitting.cluster->bodies) {
            join(parents, k, splitting.cluster->bodies[0]);
        }
    }
    return true;
}

void advance_in_groups(const StepContext& context, const Cluster& cluster,
                       const AdvanceCluster& advance)
{
    Splitting splitting = split(context, cluster);
    if (splitting.whole) {
        advance(context, cluster);
        return;
    }
    context.memory.in_groups = true;
    do {
        regroup(context, splitting);
        for (Outcome& group : splitting.groups) {
            if (!group.done) {
                advance_group(context, group, advance);
            }
        }
    } while (join_met(context, splitting));
    context.memory.in_groups = false;
    for (const Outcome& group : splitting.groups) {
        hand_over(context, group);
    }
}

void note_motion(const StepContext& context, const SubStep& sub, double s)
{
    ContactMemory& memory = context.memory;
    if (!memory.in_groups) {
        return;
    }
    const double now = sub.time + s - context.start;
    for (const int k : sub.cluster.bodies) {
        const Path& path = memory.paths[k];
        Deviation& deviation = memory.deviations[k];
        const Vec3 a = acceleration(context, k);
        const Vec3 off =
            memory.poses[k].x - deviation.start - now * deviation.velocity - 0.5 * sq(now) * a;
        // Maximum distance between the difference of two parabolas and the chord between its ends.
        const Vec3 bow = sq(s) / 8 * ((path.v1 - path.v0) / path.h - a).cwiseAbs();
        deviation.low = deviation.low.cwiseMin(off - bow);
        deviation.high = deviation.high.cwiseMax(off + bow);
        const Mat3 inverse = inverse_inertia(memory.rotors[k], path.start.R);
        deviation.turn +=
            more_turn * s * std::max((inverse * path.L0).norm(), (inverse * path.L1).norm());
    }
}

} // namespace hyoryu
