// SPDX-License-Identifier: MIT
// The smooth motion of a sub-step: choice of persistent contacts, their impulses and the paths.
#include "friction_patches.hpp"
#include "sub_step.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Most passes for a sliding patch, and the change of its friction points below which no further
// pass is needed [units].
constexpr int most_passes = 4;
constexpr double settled_rub = 1e-8;
// The first pass only predicts the ends of the paths for the next one.
constexpr Effort first_effort{
    .enough = 1e-3, .direct_tries = 1, .updates = 200, .stuck = contacts_of_a_pile + 1};
// A path end is known if its guess is off by less than this, the noise of positions [units].
constexpr double settled_end = 1e-12;
// Both tolerances for a pile: a hundredth of the residual of its solution.
constexpr double settled_rub_of_a_pile = 1e-6;
constexpr double settled_end_of_a_pile = 1e-10;

bool is_pile(const ContactMemory& memory)
{
    return memory.persistent.size() > contacts_of_a_pile;
}

// Chooses the touching contacts that do not separate as persistent. The features that the event
// search must ignore are listed in `held`.
void choose_persistent(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    const RigidSettings& settings = context.rigid.settings;
    const double located = 1e-10 * settings.unit; // deeper than an event leaves an overlap [m]
    memory.persistent.clear();
    memory.held.clear();
    for (const Candidate& c : memory.candidates) {
        const Feature& f = c.feature;
        const bool touches = c.closing || c.touch.gap <= settings.contact_tolerance;
        const double apart = separation_speed(memory, c, sub.time);
        const bool rests = touches && apart <= sub.slow;
        if (rests) {
            memory.persistent.push_back({c});
        }
        // A contact that bounces opens at once and may close again within the sub-step, even if the
        // projection of neighbouring contacts made it overlap slightly.
        const bool opens = apart * sub.h > -2 * c.touch.gap;
        if (rests || (c.touch.gap < -located && !opens)) {
            memory.held.push_back(f);
        }
    }
    find_patches(context, sub);
    std::sort(memory.held.begin(), memory.held.end());
    recall_forces(memory, sub.h);
    set_rubs(memory);
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

void add_impulse(ContactMemory& memory, int k, const Vec3& P, const Vec3& dL)
{
    Path& path = memory.paths[k];
    path.v1 += memory.rotors[k].inverse_mass.cwiseProduct(P);
    for (int m = 0; m < 3; ++m) {
        path.L1[m] += memory.rotors[k].turns[m] ? dL[m] : 0;
    }
}

// Sets the poses on the planned paths at the times `ahead` / 2 and `ahead` after the start.
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

// The friction point of a sticking patch turns with the pair, as the bodies do not turn relative to
// each other.
void carry_rub(const ContactMemory& memory, Persistent& p)
{
    const int a = p.candidate.feature.a;
    const Vec3 friction_offset = memory.poses[a].R.transpose() * p.friction_offset;
    p.touches.push_friction_offset = memory.middle[a].R * friction_offset;
    p.touches.see_friction_offset = memory.end[a].R * friction_offset;
}

// Sets the touches at the middle and the end, and the friction points of the patches there.
void set_touches(const SubStep& sub, double ahead, ContactMemory& memory)
{
    const Configuration middle = configuration(memory, memory.middle, sub.time + 0.5 * ahead);
    const Configuration end = configuration(memory, memory.end, sub.time + ahead);
    for (Persistent& p : memory.persistent) {
        const Feature& f = p.candidate.feature;
        p.touches.push = touch_of(f, middle);
        p.touches.see = touch_of(f, end);
    }
    for (const FrictionPatch& patch : memory.patches) {
        if (memory.persistent[patch.contacts[0]].stuck > 0) {
            for (const int k : patch.contacts) {
                carry_rub(memory, memory.persistent[k]);
            }
            continue;
        }
        const Vec3 push = centre_of(memory.persistent, patch,
                                    [](const Persistent& p) { return p.touches.push.point; });
        const Vec3 see = centre_of(memory.persistent, patch,
                                   [](const Persistent& p) { return p.touches.see.point; });
        for (const int k : patch.contacts) {
            TwoTouches& at = memory.persistent[k].touches;
            at.push_friction_offset = (1 - patch.rule.scale) * (push - at.push.point);
            at.see_friction_offset = (1 - patch.rule.scale) * (see - at.see.point);
        }
    }
}

// Whether friction opposes the mean slip of the contact over the sub-step, not the slip at its end.
bool slides_through(const ContactMemory& memory, const SubStep& sub, const Row& row, double ahead)
{
    const Persistent& p = memory.persistent[row.contact];
    const Vec3& n = p.candidate.touch.normal;
    const double slow = no_slip * std::sqrt(memory.geometry.unit);
    // in two dimensions the direction of sliding is constant until it stops
    return sub.slip == Slip::mean && ahead > 0 && !is_pile(memory) && row.cone.size == 3 &&
           (p.before - n * n.dot(p.before)).norm() > slow;
}

// Whether the contact at the middle and the end of the planned motion is still the one at its
// start. The low point of a cap may jump to its other side as the cap rocks through the horizontal,
// the crossing of a rod and an edge or another rod to its other end, and a corner may pass a rim; a
// poor guess of the forces may turn a body too far. The inverse mass then mixes two places, may be
// negative, and no impulse solves the contact.
bool contact_persists(const Persistent& p, const Row& row, const std::vector<Response>& bodies)
{
    constexpr double same_way = 0.5; // cosine
    constexpr double same_arm = 0.5; // relative to the inverse mass without rotation, its bound
    const Vec3& n = p.candidate.touch.normal;
    Vec3 inverse_mass = bodies[row.a].inverse_mass;
    inverse_mass += row.b >= 0 ? bodies[row.b].inverse_mass : Vec3::Zero();
    bool same = n.dot(p.touches.push.normal) > same_way && n.dot(p.touches.see.normal) > same_way;
    for (int k = 0; k < row.cone.size; ++k) {
        const Vec3 axis = row.B.col(k);
        same = same && row.cone.K(k, k) >= same_arm * axis.dot(inverse_mass.cwiseProduct(axis));
    }
    return same;
}

// The target normal velocity at the end of the sub-step. A gap that the projection closes gives no
// room to move: with v = -gap / h its noise would excite vibration. A contact that opens at the
// start and closes again within the sub-step may return at its speed of separation. A stop at the
// end, while it is still open, would add the potential energy that it has gained by then.
double target_of(const ContactMemory& memory, const SubStep& sub, const Persistent& p)
{
    const Touch& touch = p.candidate.touch;
    const double closing = touch.gap > clearly_apart(memory.geometry) ? -touch.gap / sub.h : 0;
    return sub.arms == Arms::now ? std::min(closing, -touch.normal.dot(p.before)) : closing;
}

// Builds the rows of all contacts; returns whether each contact is still the one at its start.
bool build_rows(const StepContext& context, const SubStep& sub, double ahead)
{
    ContactMemory& memory = context.memory;
    bool same = true;
    set_touches(sub, ahead, memory);
    memory.rows.clear();
    for (std::size_t k = 0; k < memory.persistent.size(); ++k) {
        Persistent& p = memory.persistent[k];
        const Feature& f = p.candidate.feature;
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
        same = same && contact_persists(p, row, memory.responses);
        if (row.cone.K(0, 0) <= 0) {
            p.impulse.setZero(); // no body can move along the normal
        } else {
            p.effective_mass = 1 / row.cone.K(0, 0);
            if (slides_through(memory, sub, row, ahead)) {
                const Twist still;
                see_mean_slip(row, memory.starts[f.a], f.b >= 0 ? memory.starts[f.b] : still,
                              wall_velocity(memory, f.b, sub.time), memory.responses);
            }
            row.before = velocity(row, memory.responses);
            row.target = target_of(memory, sub, p);
            memory.rows.push_back(row);
        }
    }
    return same;
}

void note_unsolved(ContactMemory& memory)
{
    std::size_t island = 0;
    for (std::size_t k = 0; k < memory.rows.size(); ++k) {
        island += k == memory.island_ends[island] ? 1 : 0;
        memory.persistent[memory.rows[k].contact].unsolved = memory.solvers[island].unsolved;
    }
}

// Solves for the impulses with the arms at the middle and the end of the planned paths, up to
// `ahead`, and adds the impulses to the paths. Returns the residual [m/s]. If a contact changes its
// place before `ahead`, it changes no path and returns infinity.
double solve_pass(const StepContext& context, const SubStep& sub, double ahead,
                  const Effort& effort)
{
    ContactMemory& memory = context.memory;
    predict(memory, sub, ahead);
    set_end_responses(context, sub);
    if (!build_rows(context, sub, ahead) && ahead > 0) {
        return infinity;
    }
    for (Row& row : memory.rows) {
        const Vec3& P = memory.persistent[row.contact].impulse;
        Vec3 p = row.B.transpose() * P;
        p[1] = row.cone.size > 1 ? p[1] : 0;
        p[2] = row.cone.size > 2 ? p[2] : 0;
        push(row, p, memory.responses);
    }
    const double left = solve_islands(memory.rows, memory, effort);
    note_unsolved(memory);
    if (ahead <= 0) {
        make_passive(memory);
    }
    for (const Row& row : memory.rows) {
        const Vec3 P = row.impulse();
        memory.persistent[row.contact].impulse = P;
        add_impulse(memory, row.a, P, row.turn_a * row.p);
        if (row.b >= 0) {
            add_impulse(memory, row.b, -P, -row.turn_b * row.p);
        }
    }
    note_sticking(context);
    return left;
}

// Adds the recalled impulses to the first prediction, with the arms at the start.
void add_known_impulses(ContactMemory& memory)
{
    for (const Persistent& p : memory.persistent) {
        const Feature& f = p.candidate.feature;
        const Touch& touch = p.candidate.touch;
        const Vec3 twist =
            p.friction_offset.cross(p.impulse - touch.normal * touch.normal.dot(p.impulse));
        const auto moment = [&](int k) {
            return Vec3((touch.point - memory.poses[k].x).cross(p.impulse) + twist);
        };
        add_impulse(memory, f.a, p.impulse, moment(f.a));
        if (f.b >= 0) {
            add_impulse(memory, f.b, -p.impulse, -moment(f.b));
        }
    }
}

Vec3 tangential(const Vec3& u, const Vec3& n)
{
    return u - n * n.dot(u);
}

// Velocity of a body at a contact, with tangential components at the friction point
// (`friction_offset`).
Vec3 velocity_at(const Response& body, const Vec3& arm, const Vec3& friction_offset, const Vec3& n)
{
    return body.v + body.omega.cross(arm) + tangential(body.omega.cross(friction_offset), n);
}

// The relative velocity of a contact at the end of the planned motion, with the arms there.
Vec3 velocity_after(const ContactMemory& memory, const Row& row, const TwoTouches& at)
{
    const auto of = [&](int k) {
        const Vec3 arm = at.see.point - memory.end[k].x;
        return velocity_at(memory.responses[k], arm, at.see_friction_offset, at.see.normal);
    };
    return of(row.a) - row.wall_velocity - (row.b >= 0 ? of(row.b) : Vec3::Zero());
}

// Energy that friction takes over the whole sub-step: - P . (u0 + u1) / 2 at the contact, and the
// slip at its ends. A row that opposes the mean slip gives only the sum of the slips at the two
// ends, not each of them.
void record_dissipation(const StepContext& context)
{
    ContactMemory& memory = context.memory;
    for (const Row& row : memory.rows) {
        Persistent& p = memory.persistent[row.contact];
        const Vec3& n = p.candidate.touch.normal;
        const bool mean = !row.slip.isZero(0);
        const Vec3 after = row.D * (velocity(row, memory.responses) - row.slip);
        const Vec3 before = mean ? Vec3(n * n.dot(p.before) + row.D * row.slip) : p.before;
        p.dissipated = std::max(0.0, -0.5 * p.impulse.dot(before + after));
        p.slip_before = tangential(p.before, n);
        p.slip_after =
            tangential(mean ? velocity_after(memory, row, p.touches) : after, p.touches.see.normal);
        context.rigid.counters.tangential_impacts += row.tangential ? 1 : 0;
    }
}

// Velocities of the bodies at the start, and the relative ones of the persistent contacts, in world
// axes: along the normal at the contact point, along the tangents where friction acts.
void set_velocities_before(ContactMemory& memory, const SubStep& sub)
{
    for (const int k : sub.cluster.bodies) {
        memory.starts[k] = {memory.responses[k].v, memory.responses[k].omega};
    }
    for (Persistent& p : memory.persistent) {
        const Feature& f = p.candidate.feature;
        const Vec3& n = p.candidate.touch.normal;
        const auto at_point = [&](int k) {
            const Vec3 arm = p.candidate.touch.point - memory.poses[k].x;
            return velocity_at(memory.responses[k], arm, p.friction_offset, n);
        };
        p.before =
            at_point(f.a) - (f.b >= 0 ? at_point(f.b) : wall_velocity(memory, f.b, sub.time));
    }
}

// Whether a friction point has moved since the last pass by more than round-off: friction points
// depend on the loads, and the loads on the friction points.
bool friction_points_moved(const ContactMemory& memory)
{
    const double settled = is_pile(memory) ? settled_rub_of_a_pile : settled_rub;
    const auto point = [](const Persistent& p) { return p.touches.push.point; };
    return std::ranges::any_of(memory.patches, [&](const FrictionPatch& patch) {
        const Persistent& p = memory.persistent[patch.contacts[0]];
        const Vec3 friction_offset =
            (1 - patch.rule.scale) * (centre_of(memory.persistent, patch, point) - point(p));
        return p.stuck == 0 && (friction_offset - p.touches.push_friction_offset).norm() >
                                   settled * memory.geometry.unit;
    });
}

void guess_ends(ContactMemory& memory, const SubStep& sub)
{
    for (const int k : sub.cluster.bodies) {
        memory.guesses[k] = {memory.paths[k].v1, memory.paths[k].L1};
    }
}

// Whether the path ends agree with the guess, so that a second pass with the new arms would give
// the same result. Bodies at rest or in steady sliding need only one pass.
bool ends_as_guessed(const ContactMemory& memory, const SubStep& sub)
{
    const double most =
        (is_pile(memory) ? settled_end_of_a_pile : settled_end) * memory.geometry.unit;
    return std::ranges::all_of(sub.cluster.bodies, [&](int k) {
        const Path& path = memory.paths[k];
        const Vec3 turn =
            memory.responses[k].inverse_inertia * (path.L1 - memory.guesses[k].angular_momentum);
        const double off = (path.v1 - memory.guesses[k].velocity).norm() +
                           memory.geometry.solids[k].reach * turn.norm();
        return 0.5 * sub.h * off <= most;
    });
}

// Fixed-point passes with the arms at the middle and the end of the paths, each starting from the
// impulses of the last. The first pass predicts the path ends and is the only one if they agree
// with the guess. Returns the residual [m/s], or infinity if a contact changes its place.
double solve_ahead(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    const auto slides = [](const Row& row) { return !row.slip.isZero(0); };
    add_known_impulses(memory);
    guess_ends(memory, sub);
    double left = solve_pass(context, sub, sub.h, first_effort);
    const bool solved = left <= solved_speed * std::sqrt(memory.geometry.unit);
    if (solved && ends_as_guessed(memory, sub) && !friction_points_moved(memory)) {
        return left;
    }
    bool again = true;
    for (int pass = 1; again && left < infinity && pass < most_passes; ++pass) {
        left = solve_pass(context, sub, sub.h, sub.contact_effort);
        again = std::ranges::any_of(memory.rows, slides) && friction_points_moved(memory);
    }
    return left;
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
    memory.rows.clear();
    if (!memory.persistent.empty()) {
        set_velocities_before(memory, sub);
        double left = sub.arms == Arms::ahead ? solve_ahead(context, sub) : infinity;
        if (left == infinity) { // with the arms at the start
            left = solve_pass(context, sub, 0, sub.contact_effort);
        }
        double& worst = context.rigid.counters.worst_residual;
        worst = std::max(worst, left);
        record_dissipation(context);
    }
    for (const int k : sub.cluster.bodies) {
        memory.end[k] = pose_at(memory.paths[k], memory.rotors[k], sub.h);
    }
}

void plan_again(const StepContext& context, const SubStep& sub)
{
    set_responses(context, sub.cluster);
    plan_motion(context, sub);
}

} // namespace hyoryu
