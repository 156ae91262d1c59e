// SPDX-License-Identifier: MIT
// Quantities derived from the state of one body: velocities, energy, support function.
#include "hyoryu/rigid/body.hpp"
#include "rotor.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// The inertia in world axes without the rows and columns of locked axes.
Mat3 free_inertia(const Body& body)
{
    const Mat3 R = body.orientation.toRotationMatrix();
    Mat3 inertia = R * body.mass.inertia * R.transpose();
    for (int k = 0; k < 3; ++k) {
        if (body.locks[3 + k]) {
            inertia.row(k).setZero();
            inertia.col(k).setZero();
        }
    }
    return inertia;
}

double reach_of(const Polytope& shape, const Vec3& n)
{
    double reach = -infinity;
    for (const Vec3& corner : shape.corners) {
        reach = std::max(reach, n.dot(corner));
    }
    return reach;
}
double reach_of(const Ball& ball, const Vec3& n)
{
    return n.dot(ball.middle) + ball.radius;
}
double reach_of(const Rod& rod, const Vec3& n)
{
    return n.dot(rod.middle) + 0.5 * rod.length * std::abs(n.x()) +
           rod.radius * std::hypot(n.y(), n.z());
}
double reach_of(const Compound& shape, const Vec3& n)
{
    double reach = -infinity;
    for (const Polytope& part : shape.parts) {
        reach = std::max(reach, reach_of(part, n));
    }
    return reach;
}

} // namespace

Vec3 angular_velocity(const Body& body)
{
    return inverse_inertia(rotor_of(body, 3), body.orientation.toRotationMatrix()) *
           body.angular_momentum;
}

Acceleration acceleration(const Body& body, const Wrench& wrench)
{
    const Rotor rotor = rotor_of(body, 3);
    const Mat3 turn = inverse_inertia(rotor, body.orientation.toRotationMatrix());
    return {rotor.inverse_mass.cwiseProduct(wrench.force), turn * wrench.torque};
}

Vec3 angular_momentum(const Body& body, const Vec3& omega)
{
    return free_inertia(body) * omega;
}

double kinetic_energy(const Body& body)
{
    return 0.5 * body.mass.mass * body.velocity.squaredNorm() +
           0.5 * angular_velocity(body).dot(body.angular_momentum);
}

bool is_fixed(const Body& body)
{
    return std::ranges::all_of(body.locks, [](bool locked) { return locked; });
}

double reach_along(const Body& body, const Vec3& n)
{
    const Vec3 local = body.orientation.conjugate() * n;
    return std::visit([&](const auto& shape) { return reach_of(shape, local); }, body.shape);
}

const ContactLaws::Law& ContactLaws::of(int a, int b) const
{
    const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const auto& entry) {
        const auto& [m, n] = entry.first;
        return (m == a && n == b) || (m == b && n == a);
    });
    return found != pairs.end() ? found->second : otherwise;
}

} // namespace hyoryu
