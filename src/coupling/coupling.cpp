// SPDX-License-Identifier: MIT
#include "hyoryu/coupling/coupling.hpp"

#include "hyoryu/fluid/sum_units.hpp"

namespace hyoryu {

namespace {

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
    bool has_friction() const { return !friction_.empty(); }

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

void collect_loads(const Fluid& fluid, const std::vector<Pose>& poses, OwnerSums<6>& sums)
{
    const Store& store = fluid.particles.body;
    const Tiles& tiles = fluid.neighbours.body;
    const auto x = store[field::position];
    const auto owner = store.owner();
    const SolidForce force(fluid, store);
    const auto body_of = [&](std::int32_t row) { return static_cast<std::size_t>(owner[row]); };
    const auto wrench = [&](std::int32_t row) {
        const Vec3 f = force(row);
        const Vec3 torque = (x[row] - poses[body_of(row)].position).cross(f);
        return std::array{f.x(), f.y(), f.z(), torque.x(), torque.y(), torque.z()};
    };
    const SumUnits units = sum_units(fluid.parameters);
    sums.begin(poses.size(),
               {units.force, units.force, units.force, units.torque, units.torque, units.torque});
    parallel_blocks(0, tiles.tiles(),
                    [&](Index tile) { sums.add_tile(tiles, tile, body_of, wrench); });
}

void collect_wall_forces(const Fluid& fluid, std::size_t walls, OwnerSums<3>& sums)
{
    const Store& store = fluid.particles.wall;
    const Tiles& tiles = fluid.neighbours.wall;
    const auto owner = store.owner();
    const SolidForce force(fluid, store);
    const auto wall_of = [&](std::int32_t row) { return at(-1 - owner[row]); };
    const auto force_of = [&](std::int32_t row) {
        const Vec3 f = force(row);
        return std::array{f.x(), f.y(), f.z()};
    };
    const FixedUnit unit = sum_units(fluid.parameters).force;
    sums.begin(walls, {unit, unit, unit});
    // On walls away from fluid only the friction of the last step may act.
    const std::vector<std::int32_t>& wet = fluid.neighbours.wet_walls;
    const bool all = force.has_friction();
    parallel_blocks(0, all ? tiles.tiles() : static_cast<Index>(wet.size()), [&](Index k) {
        sums.add_tile(tiles, all ? k : wet[at(k)], wall_of, force_of);
    });
}

} // namespace hyoryu
