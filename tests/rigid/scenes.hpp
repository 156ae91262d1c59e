// SPDX-License-Identifier: MIT
// Scenes that several rigid tests share. Numbers named "contact notes" were computed by independent
// event-driven solvers (g = 9.81 m/s2).
#pragma once

#include "hyoryu/rigid/rigid.hpp"

#include <functional>

namespace hyoryu::test {

constexpr double g = 9.81; // [m/s2]

/// The cube of the drops: 6 cm long and wide, 5 cm high, 250 kg/m3.
inline Vec3 cube_size()
{
    return {0.06, 0.06, 0.05};
}
/// The timber: 100 x 10 x 10 cm, 520 kg/m3.
inline Vec3 timber_size()
{
    return {1.0, 0.1, 0.1};
}

inline Body body_of(ContactShape shape, double density, const Vec3& position, int dimensions = 3)
{
    Body body;
    body.mass = mass_properties(shape, density, dimensions);
    body.shape = std::move(shape);
    body.position = position;
    return body;
}

inline Body box(const Vec3& size, double density, const Vec3& position, int dimensions = 3)
{
    return body_of(box_polytope(size, dimensions), density, position, dimensions);
}

inline Rigid scene(double restitution, double friction, int dimensions = 3)
{
    Rigid rigid;
    rigid.settings.dimensions = dimensions;
    rigid.laws.otherwise = {restitution, friction};
    return rigid;
}

inline Rigid on_floor(double restitution, double friction, int dimensions = 3)
{
    Rigid rigid = scene(restitution, friction, dimensions);
    rigid.boundaries.push_back({"floor", Plane{}});
    return rigid;
}

/// Advances by `steps` steps without loads; `each` sees the time after every step.
inline std::vector<Contact> run(Rigid& rigid, double dt, int steps,
                                const std::function<void(double)>& each = {}, double start = 0)
{
    const std::vector<Wrench> loads(rigid.bodies.size());
    std::vector<Contact> log;
    for (int k = 0; k < steps; ++k) {
        step(rigid, start + k * dt, dt, loads, log);
        if (each) {
            each(start + (k + 1) * dt);
        }
    }
    return log;
}

inline double energy(const Rigid& rigid)
{
    double sum = 0;
    for (const Body& body : rigid.bodies) {
        sum += kinetic_energy(body) - body.mass.mass * rigid.settings.gravity.dot(body.position);
    }
    return sum;
}

inline Quat turn_about(const Vec3& axis, double degrees)
{
    return Quat(Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180, axis));
}

} // namespace hyoryu::test
