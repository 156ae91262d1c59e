// SPDX-License-Identifier: MIT
#include "hyoryu/coupling/coupling.hpp"

namespace hyoryu {

namespace {

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

// Force of the fluid on a solid particle: pressure and, without slip, friction.
class SolidForce {
public:
    SolidForce(const Fluid& fluid, const Store& solids)
        : F_(solids[field::force]),
          friction_(sticks_to_solids(fluid) && solids.has(field::viscous_force)
                        ? solids[field::viscous_force]
                        : ColumnView<const Vec3>())
    {
    }
    Vec3 operator()(Index row) const
    {
        return friction_.empty() ? F_[row] : Vec3(F_[row] + friction_[row]);
    }

private:
    ColumnView<const Vec3> F_, friction_;
};

Quat turned(const Quat& q, const Vec3& angle)
{
    const double a = angle.norm();
    return a > 0 ? Quat(Eigen::AngleAxisd(a, angle / a)) * q : q;
}

} // namespace

std::vector<Pose> free_flight(const Rigid& rigid, double ahead)
{
    std::vector<Pose> poses;
    poses.reserve(rigid.bodies.size());
    for (const Body& body : rigid.bodies) {
        poses.push_back({body.position + ahead * body.velocity,
                         turned(body.orientation, ahead * angular_velocity(body))});
    }
    return poses;
}

void place_bodies(const Rigid& rigid, const std::vector<Pose>& poses, const BodyParticles& bodies,
                  Fluid& fluid)
{
    Store& store = fluid.particles.body;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    for (std::size_t b = 0; b < rigid.bodies.size(); ++b) {
        const Mat3 R = poses[b].orientation.toRotationMatrix();
        const Vec3 V = rigid.bodies[b].velocity;
        const Vec3 omega = angular_velocity(rigid.bodies[b]);
        parallel_for(bodies.of[b].begin, bodies.of[b].end, [&](Index k) {
            const Vec3 r = R * bodies.points[at(k)];
            x[k] = poses[b].position + r;
            v[k] = V + omega.cross(r);
        });
    }
}

void collect_loads(const Fluid& fluid, const std::vector<Pose>& poses, const BodyParticles& bodies,
                   std::vector<Wrench>& loads)
{
    const auto x = fluid.particles.body[field::position];
    const SolidForce force(fluid, fluid.particles.body);
    loads.resize(bodies.of.size());
    // One body a row of the loop: its sum has one writer and one order.
    parallel_for(0, static_cast<Index>(bodies.of.size()), [&](Index b) {
        Wrench load;
        for (Index k = bodies.of[at(b)].begin; k < bodies.of[at(b)].end; ++k) {
            const Vec3 f = force(k);
            load.force += f;
            load.torque += (x[k] - poses[at(b)].position).cross(f);
        }
        loads[at(b)] = load;
    });
}

void collect_wall_forces(const Fluid& fluid, std::span<Vec3> forces)
{
    std::fill(forces.begin(), forces.end(), Vec3(Vec3::Zero()));
    const Store& walls = fluid.particles.wall;
    const SolidForce force(fluid, walls);
    const auto owner = walls.owner();
    for (Index k = 0; k < walls.size(); ++k) {
        forces[at(-1 - owner[k])] += force(k);
    }
}

} // namespace hyoryu
