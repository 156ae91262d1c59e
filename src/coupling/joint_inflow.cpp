// SPDX-License-Identifier: MIT
#include "joint_inflow.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

double joint_inertance(double density, double path, double section)
{
    return density * path / (3 * section);
}

double inertia_drop(double last, const JointResponse& joint, double growth, double limit)
{
    const double off = joint.inertance * growth - last;
    return std::clamp(last + off / (1 + joint.inertance * joint.mobility), 0.0, limit);
}

double bernoulli_drop(const Inflow& in, double density, double growth, double dt)
{
    const double v = in.opening + dt * std::max(growth, 0.0) / in.area;
    const double k = density * in.area * sq(in.area / in.section) / 2;
    const double rate = 2 * k * dt / in.mass;
    const double later = rate * v > 1e-12 ? (std::sqrt(1 + 2 * rate * v) - 1) / rate : v;
    return k * sq(later) / in.area;
}

double spread_by_sound(double last, double rims, double part)
{
    const double delayed = rims - (rims - last) * std::exp(-part);
    return std::min(rims, std::max(last * std::exp(part), delayed));
}

} // namespace hyoryu
