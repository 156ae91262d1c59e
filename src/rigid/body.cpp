// SPDX-License-Identifier: MIT
// What follows from the state of one body.
#include "hyoryu/rigid/body.hpp"
#include "rotor.hpp"

#include <algorithm>

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

} // namespace

Vec3 angular_velocity(const Body& body)
{
    return inverse_inertia(rotor_of(body, 3), body.orientation.toRotationMatrix()) *
           body.angular_momentum;
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

const ContactLaws::Law& ContactLaws::of(int a, int b) const
{
    const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const auto& entry) {
        const auto& [m, n] = entry.first;
        return (m == a && n == b) || (m == b && n == a);
    });
    return found != pairs.end() ? found->second : otherwise;
}

} // namespace hyoryu
