// SPDX-License-Identifier: MIT
// The energy balance of contacts in a planned sub-step. Impulses at its middle with constraints at
// its end are of second order, but their work is not necessarily dissipative: the error is of third
// order in the length of the sub-step, and of either sign.
#include "sub_step.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Energy gain from contacts that is accepted in a sub-step, relative to the kinetic energy.
constexpr double no_gain = 1e-6;
// Round-off of their work, relative to the kinetic energy.
constexpr double round_off = 1e-13;

// The work of the contacts on a body along a path that ends at the rotation `end`: the gain of
// kinetic energy less the work of gravity and loads.
double work_on(const StepContext& context, int k, const Path& path, const Mat3& end)
{
    const Rotor& rotor = context.memory.rotors[k];
    const Vec3 mean = 0.5 * (path.v0 + path.v1);
    const Vec3 gain = path.v1 - path.v0 - path.h * acceleration(context, k);
    double work = context.rigid.bodies[k].mass.mass * mean.dot(gain);
    if (rotor.free_axes > 0) {
        const Vec3 before = inverse_inertia(rotor, path.start.R) * path.L0;
        const Vec3 after = inverse_inertia(rotor, end) * path.L1;
        work += 0.5 * (path.L1.dot(after) - path.L0.dot(before)) -
                0.5 * path.h * context.loads[k].torque.dot(before + after);
    }
    return work;
}

// The accepted gain without the part for the energy exchanged by contacts: relative to the kinetic
// energy at the end of the paths in the frame of the centre of mass of the cluster, so that a
// common drift of all bodies does not count.
double gain_left(const StepContext& context, const SubStep& sub)
{
    const ContactMemory& memory = context.memory;
    double mass = 0;
    double energy = 0;
    Vec3 momentum = Vec3::Zero();
    for (const int k : sub.cluster.bodies) {
        const Path& path = memory.paths[k];
        const double m = memory.rotors[k].movable ? context.rigid.bodies[k].mass.mass : 0;
        mass += m;
        momentum += m * path.v1;
        energy += 0.5 * (m * path.v1.squaredNorm() + path.L1.dot(memory.responses[k].omega));
    }
    const double of_centre = 0.5 * momentum.squaredNorm() / mass;
    return no_gain * (energy - of_centre) + round_off * energy;
}

// Work of the projection against gravity and loads if the path changes a gap: the projection moves
// the two bodies until the gap has its former value. `apart` is the acceleration of the gap in free
// flight.
double work_of_projection(const StepContext& context, const Row& row, double change)
{
    const ContactMemory& memory = context.memory;
    const Vec3 n = row.D.col(0);
    const auto free = [&](int k, const Mat3& lever) {
        const Vec3 turn = memory.responses[k].inverse_inertia * context.loads[k].torque;
        return n.dot(acceleration(context, k)) + lever.col(0).dot(turn);
    };
    const double apart = free(row.a, row.lever_a) - (row.b >= 0 ? free(row.b, row.lever_b) : 0.0);
    return change * apart / row.cone.K(0, 0);
}

// The part of a path up to the time s.
Path up_to(double s, Path path)
{
    const double part = path.h > 0 ? s / path.h : 0;
    path.v1 = path.v0 + part * (path.v1 - path.v0);
    path.L1 = path.L0 + part * (path.L1 - path.L0);
    path.h = s;
    return path;
}

} // namespace

double taken_by_contacts(const StepContext& context, const SubStep& sub, double s)
{
    const ContactMemory& memory = context.memory;
    double taken = 0;
    for (const int k : sub.cluster.bodies) {
        if (memory.rotors[k].movable) {
            taken -= work_on(context, k, up_to(s, memory.paths[k]), memory.poses[k].R);
        }
    }
    const double part = sub.h > 0 ? s / sub.h : 0;
    for (const Persistent& p : memory.persistent) {
        const Vec3 wall = wall_velocity(memory, p.candidate.feature.b, sub.time + 0.5 * s);
        taken += part * p.impulse.dot(wall);
    }
    return taken;
}

bool gains_energy(const StepContext& context, const SubStep& sub)
{
    ContactMemory& memory = context.memory;
    const auto pushes = [](const Persistent& p) { return p.impulse.squaredNorm() > 0; };
    if (std::ranges::none_of(memory.persistent, pushes)) {
        return false;
    }
    double work = 0;
    for (const int k : sub.cluster.bodies) {
        work +=
            memory.rotors[k].movable ? work_on(context, k, memory.paths[k], memory.end[k].R) : 0;
    }
    const Configuration end = configuration(memory, memory.end, sub.time + sub.h);
    double left = gain_left(context, sub);
    for (const Row& row : memory.rows) {
        const Persistent& p = memory.persistent[row.contact];
        work -= p.impulse.dot(wall_velocity(memory, p.candidate.feature.b, sub.time + 0.5 * sub.h));
        left += 0.5 * no_gain * row.p.dot(row.cone.K * row.p);
        if (row.p[0] > 0) {
            const double gap = touch_of(p.candidate.feature, end).gap;
            work += work_of_projection(context, row, gap - p.candidate.touch.gap);
        }
    }
    return work > left;
}

} // namespace hyoryu
