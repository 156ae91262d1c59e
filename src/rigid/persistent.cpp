// SPDX-License-Identifier: MIT
// The smooth motion of a sub-step with persistent contacts.
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// More coplanar contacts of a pair than this are thinned out to the outermost ones.
constexpr std::size_t most_contacts = 8;

// Keeps, of the contacts of one pair in one plane, those outermost in eight directions: the others
// lie within their hull and cannot approach on their own.
void thin_out(std::vector<Persistent>& found, std::size_t first)
{
    if (found.size() - first <= most_contacts) {
        return;
    }
    const Vec3 n = found[first].candidate.touch.normal;
    int helper = 0;
    n.cwiseAbs().minCoeff(&helper);
    const Vec3 u = n.cross(Vec3::Unit(helper)).normalized();
    const Vec3 w = n.cross(u);
    std::vector<bool> kept(found.size() - first, false);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        // another normal belongs to another plane
        kept[k] = found[first + k].candidate.touch.normal.dot(n) < 1 - 1e-9;
    }
    for (const auto& [x, y] :
         {std::pair(1, 0), {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) {
        const Vec3 out = x * u + y * w;
        std::size_t best = 0;
        for (std::size_t k = 1; k < kept.size(); ++k) {
            const Vec3 step =
                found[first + k].candidate.touch.point - found[first + best].candidate.touch.point;
            best = step.dot(out) > 0 ? k : best;
        }
        kept[best] = true;
    }
    std::size_t end = first;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        if (kept[k]) {
            found[end++] = found[first + k];
        }
    }
    found.resize(end);
}

// Touching contacts that do not fly apart; everything that the event search must not look for is
// held.
void choose_persistent(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    const RigidSettings& settings = context.rigid.settings;
    const double located = 1e-10 * settings.unit; // deeper than an event leaves a contact [m]
    memory.persistent.clear();
    memory.held.clear();
    std::size_t first = 0;
    for (std::size_t k = 0; k < memory.candidates.size(); ++k) {
        const Candidate& c = memory.candidates[k];
        const Feature& f = c.feature;
        const bool new_pair = k > 0 && (memory.candidates[k - 1].feature.a != f.a ||
                                        memory.candidates[k - 1].feature.b != f.b);
        if (new_pair) {
            thin_out(memory.persistent, first);
            first = memory.persistent.size();
        }
        const bool touches = !c.beyond && (c.closing || c.touch.gap <= settings.contact_tolerance);
        const double apart = separation_speed(memory, c, sub.time);
        const bool rests = touches && apart <= sub.slow;
        if (rests) {
            memory.persistent.push_back({c});
        }
        // What bounces off opens at once, and may come back within the sub-step, though the
        // projection of the contacts beside it has pushed it in a little.
        const bool opens = apart * sub.h > -2 * c.touch.gap;
        if (rests || (c.touch.gap < -located && !opens)) {
            memory.held.push_back(f);
        }
    }
    thin_out(memory.persistent, first);
    std::sort(memory.held.begin(), memory.held.end());
    recall_forces(memory, sub.h);
}

void plan_free_motion(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    for (const int k : sub.cluster.bodies) {
        const Body& body = context.rigid.bodies[k];
        Path& path = memory.paths[k];
        path = {memory.poses[k],       body.velocity,         body.velocity,
                body.angular_momentum, body.angular_momentum, sub.h};
        path.v1 += sub.h * acceleration(context, k);
        for (int m = 0; m < 3; ++m) {
            path.L1[m] += memory.rotors[k].turns[m] ? sub.h * context.loads[k].torque[m] : 0;
        }
    }
}

void add_impulse(ContactMemory& memory, int k, const Vec3& arm, const Vec3& P)
{
    Path& path = memory.paths[k];
    path.v1 += memory.rotors[k].inverse_mass.cwiseProduct(P);
    const Vec3 dL = arm.cross(P);
    for (int m = 0; m < 3; ++m) {
        path.L1[m] += memory.rotors[k].turns[m] ? dL[m] : 0;
    }
}

// Poses halfway and `ahead` of the start on the paths as they are planned now.
void predict(ContactMemory& memory, const SubStep& sub, double ahead)
{
    for (const int k : sub.cluster.bodies) {
        memory.middle[k] = pose_at(memory.paths[k], memory.rotors[k], 0.5 * ahead);
        memory.end[k] = pose_at(memory.paths[k], memory.rotors[k], ahead);
    }
}

// Free velocities at the end of the sub-step, with the inertia of the predicted end.
void set_end_responses(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    plan_free_motion(context, sub);
    for (const int k : sub.cluster.bodies) {
        Response& response = memory.responses[k];
        response.inverse_inertia = inverse_inertia(memory.rotors[k], memory.end[k].R);
        response.v = memory.paths[k].v1;
        response.omega = response.inverse_inertia * memory.paths[k].L1;
    }
}

void build_rows(const StepContext& context, const SubStep& sub, double ahead)
{
    ContactMemory& memory = context.memory;
    const Configuration middle = configuration(memory, memory.middle, sub.time + 0.5 * ahead);
    const Configuration end = configuration(memory, memory.end, sub.time + ahead);
    memory.rows.clear();
    for (std::size_t k = 0; k < memory.persistent.size(); ++k) {
        Persistent& p = memory.persistent[k];
        const Feature& f = p.candidate.feature;
        p.touches = {touch_of(f, middle), touch_of(f, end)};
        Row row;
        row.a = f.a;
        row.b = std::max(f.b, -1);
        row.contact = static_cast<int>(k);
        row.cone.mu = law_of(context.rigid, f.a, f.b).friction;
        row.wall_velocity = wall_velocity(memory, f.b, sub.time + sub.h);
        const int b = std::max(row.b, 0);
        const Centres centres{memory.middle[f.a].x, memory.middle[b].x, memory.end[f.a].x,
                              memory.end[b].x};
        complete(row, p.touches, centres, memory.responses, context.rigid.settings.dimensions);
        if (row.cone.K(0, 0) > 0) {
            p.effective_mass = 1 / row.cone.K(0, 0);
            row.before = velocity(row, memory.responses);
            // A gap that the projection closes is no freedom: v = gap / h of its noise would
            // rattle.
            const double gap = p.candidate.touch.gap;
            row.target = gap > clearly_apart(memory.geometry) ? -gap / sub.h : 0;
            memory.rows.push_back(row);
        }
    }
}

void solve_pass(const StepContext& context, const SubStep& sub, double ahead)
{
    ContactMemory& memory = context.memory;
    predict(memory, sub, ahead);
    set_end_responses(context, sub);
    build_rows(context, sub, ahead);
    for (Row& row : memory.rows) {
        const Vec3& P = memory.persistent[row.contact].impulse;
        Vec3 p = row.B.transpose() * P;
        p[1] = row.cone.size > 1 ? p[1] : 0;
        p[2] = row.cone.size > 2 ? p[2] : 0;
        push(row, p, memory.responses);
    }
    const double left = solve_islands(memory.rows, memory, sub.contact_effort);
    double& worst = context.rigid.counters.worst_residual;
    worst = std::max(worst, left);
    for (const Row& row : memory.rows) {
        const Vec3 P = row.impulse();
        memory.persistent[row.contact].impulse = P;
        add_impulse(memory, row.a, row.arm_a, P);
        if (row.b >= 0) {
            add_impulse(memory, row.b, row.arm_b, -P);
        }
    }
}

// The known forces act on the first prediction with the arms of the start.
void add_known_impulses(ContactMemory& memory)
{
    for (const Persistent& p : memory.persistent) {
        const Feature& f = p.candidate.feature;
        add_impulse(memory, f.a, p.candidate.touch.point - memory.poses[f.a].x, p.impulse);
        if (f.b >= 0) {
            add_impulse(memory, f.b, p.candidate.touch.point - memory.poses[f.b].x, -p.impulse);
        }
    }
}

// Energy that friction takes over the whole sub-step: - P . (u0 + u1) / 2 at the contact.
void book_dissipation(const StepContext& context, const std::vector<Vec3>& before)
{
    ContactMemory& memory = context.memory;
    for (const Row& row : memory.rows) {
        Persistent& p = memory.persistent[row.contact];
        const Vec3 after = row.D * velocity(row, memory.responses);
        p.dissipated = std::max(0.0, -0.5 * p.impulse.dot(before[row.contact] + after));
        const auto tangential = [](const Vec3& u, const Vec3& n) { return Vec3(u - n * n.dot(u)); };
        p.slip_before = tangential(before[row.contact], p.candidate.touch.normal);
        p.slip_after = tangential(after, p.touches.see.normal);
        context.rigid.counters.tangential_impacts += row.tangential ? 1 : 0;
    }
}

// Relative velocities of the persistent contacts at the start, in world axes.
std::vector<Vec3> contact_velocities(const ContactMemory& memory, double time)
{
    std::vector<Vec3> velocities;
    for (const Persistent& p : memory.persistent) {
        const Feature& f = p.candidate.feature;
        const auto at_point = [&](int k) {
            const Response& body = memory.responses[k];
            return Vec3(body.v + body.omega.cross(p.candidate.touch.point - memory.poses[k].x));
        };
        velocities.emplace_back(at_point(f.a) -
                                (f.b >= 0 ? at_point(f.b) : wall_velocity(memory, f.b, time)));
    }
    return velocities;
}

} // namespace

void predict_free_motion(const StepContext& context, const SubStep& sub)
{
    plan_free_motion(context, sub);
    predict(context.memory, sub, sub.h);
}

void plan_motion(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    plan_free_motion(context, sub);
    choose_persistent(context, sub);
    if (memory.persistent.empty()) {
        return;
    }
    const std::vector<Vec3> before = contact_velocities(memory, sub.time);
    if (sub.arms == Arms::now) {
        solve_pass(context, sub, 0);
    } else {
        add_known_impulses(memory);
        solve_pass(context, sub, sub.h);
        solve_pass(context, sub, sub.h); // with the impulses of the first
    }
    book_dissipation(context, before);
}

void plan_again(const StepContext& context, const SubStep& sub)
{
    set_responses(context, sub.cluster);
    plan_motion(context, sub);
}

} // namespace hyoryu
