// SPDX-License-Identifier: MIT
#include "memory.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>

namespace hyoryu {

SolidPose pose_at(const Path& path, const Rotor& rotor, double s)
{
    const double part = path.h > 0 ? s / path.h : 0;
    const Vec3 x = path.start.x + s * path.v0 + 0.5 * s * part * (path.v1 - path.v0);
    const Vec3 L = path.L0 + 0.5 * part * (path.L1 - path.L0);
    return pose_of(x, turned(rotor, path.start.q, L, s));
}

void prepare(Rigid& rigid)
{
    if (!rigid.memory) {
        rigid.memory = std::make_unique<ContactMemory>();
    }
    ContactMemory& memory = *rigid.memory;
    const std::size_t n = rigid.bodies.size();
    const int dimensions = rigid.settings.dimensions;
    if (memory.rotors.size() != n || memory.geometry.walls.size() != rigid.boundaries.size()) {
        memory.rotors.clear();
        memory.geometry = {.unit = rigid.settings.unit};
        for (const Body& body : rigid.bodies) {
            memory.rotors.push_back(rotor_of(body, dimensions));
            memory.geometry.solids.push_back(solid_of(body.shape, dimensions));
        }
        for (const Boundary& boundary : rigid.boundaries) {
            memory.geometry.walls.push_back(wall_of(boundary, dimensions));
        }
    }
    for (std::size_t k = 0; k < rigid.boundaries.size(); ++k) {
        if (rigid.boundaries[k].motion.absorption) { // what a paddle adds changes every step
            memory.geometry.walls[k].motion = rigid.boundaries[k].motion;
        }
    }
    memory.poses.resize(n);
    memory.paths.resize(n);
    memory.responses.resize(n);
    memory.starts.resize(n);
    memory.guesses.resize(n);
    memory.work_of.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        Body& body = rigid.bodies[k];
        if (body.left && memory.rotors[k].movable) {
            memory.rotors[k] = rotor_of(body, dimensions);
        }
        memory.poses[k] = pose_of(body.position, body.orientation);
        for (int m = 0; m < 3; ++m) { // a locked axis does not move, whatever its velocity was
            body.velocity[m] = memory.rotors[k].inverse_mass[m] > 0 ? body.velocity[m] : 0;
            body.angular_momentum[m] = memory.rotors[k].turns[m] ? body.angular_momentum[m] : 0;
        }
        memory.responses[k].inverse_mass = memory.rotors[k].inverse_mass;
        memory.responses[k].movable = memory.rotors[k].movable;
    }
    memory.fresh.clear();
    memory.jammed = false;
    memory.trial = memory.poses;
    memory.middle = memory.poses;
    memory.end = memory.poses;
    memory.events.assign(n, 0);
}

void sort_by_feature(std::vector<Remembered>& forces)
{
    std::sort(forces.begin(), forces.end(),
              [](const Remembered& a, const Remembered& b) { return a.feature < b.feature; });
}

Configuration configuration(const ContactMemory& memory, const std::vector<SolidPose>& poses,
                            double time)
{
    return {memory.geometry, poses, time};
}

Vec3 wall_velocity(const ContactMemory& memory, int b, double time)
{
    return b < 0 ? velocity(memory.geometry.walls[-1 - b].motion, time) : Vec3::Zero();
}

const ContactLaws::Law& law_of(const Rigid& rigid, int a, int b)
{
    const int other = b < 0 ? rigid.boundaries[-1 - b].material : rigid.bodies[b].material;
    return rigid.laws.of(rigid.bodies[a].material, other);
}

Vec3 acceleration(const StepContext& context, int body)
{
    const Vec3& inverse_mass = context.memory.rotors[body].inverse_mass;
    const double mass = context.rigid.bodies[body].mass.mass;
    return inverse_mass.cwiseProduct(mass * context.rigid.settings.gravity +
                                     context.loads[body].force);
}

void set_response(const StepContext& context, int body)
{
    const Body& now = context.rigid.bodies[body];
    Response& response = context.memory.responses[body];
    response.inverse_inertia =
        inverse_inertia(context.memory.rotors[body], context.memory.poses[body].R);
    response.v = now.velocity;
    response.omega = response.inverse_inertia * now.angular_momentum;
}

void set_responses(const StepContext& context, const Cluster& cluster)
{
    for (const int k : cluster.bodies) {
        set_response(context, k);
    }
}

double separation_speed(const ContactMemory& memory, const Candidate& contact, double time)
{
    const Feature& feature = contact.feature;
    const Touch& touch = contact.touch;
    const Vec3 other = feature.b >= 0 ? velocity_at(memory, feature.b, touch.point)
                                      : wall_velocity(memory, feature.b, time);
    return touch.normal.dot(velocity_at(memory, feature.a, touch.point) - other);
}

ContactStart contact_start(const Rigid& rigid)
{
    ContactStart start;
    if (rigid.memory) {
        for (const Remembered& r : rigid.memory->forces) {
            const Feature& f = r.feature;
            start.features.push_back(
                {f.a, f.b, static_cast<int>(f.kind), f.owner, f.i, f.j, f.k, f.l, f.f});
            start.forces.push_back(r.force);
            start.places.push_back(r.place);
            start.rubs.push_back(r.friction_offset);
            start.stuck.push_back(r.stuck);
        }
    }
    return start;
}

void set_contact_start(Rigid& rigid, const ContactStart& start)
{
    const std::size_t n = start.features.size();
    if (start.forces.size() != n || start.places.size() != n || start.rubs.size() != n ||
        start.stuck.size() != n) {
        throw IoError("the contact forces of the checkpoint differ in number: it is damaged");
    }
    rigid.memory = std::make_unique<ContactMemory>();
    for (std::size_t k = 0; k < n; ++k) {
        const auto& [a, b, kind, owner, i, j, l, m, f] = start.features[k];
        const Feature feature{a, b, static_cast<FeatureKind>(kind), owner, i, j, l, m, f};
        rigid.memory->forces.push_back(
            {feature, start.forces[k], start.places[k], start.rubs[k], start.stuck[k]});
    }
}

} // namespace hyoryu
