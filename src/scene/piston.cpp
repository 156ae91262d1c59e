// SPDX-License-Identifier: MIT
#include "hyoryu/scene/piston.hpp"

#include <cmath>

namespace hyoryu {

namespace {

constexpr double last_phase = 3.80; // tanh = 0.999, as Goring cut it
// Points of the path: the cubics between them follow it to 1e-4 of its largest speed.
constexpr int points = 201;

} // namespace

Motion solitary_piston(double height, double depth, double gravity)
{
    const double k = std::sqrt(3 * height / (4 * depth * depth * depth));
    const double c = std::sqrt(gravity * (depth + height));
    const double half_stroke = height / (k * depth);
    // Time and place are explicit in the phase theta = k (c t - x).
    const auto time = [&](double theta) {
        return (theta + height / depth * std::tanh(theta)) / (k * c);
    };
    Motion motion;
    for (int n = 0; n < points; ++n) {
        const double theta = last_phase * (2.0 * n / (points - 1) - 1);
        motion.times.push_back(time(theta) + time(last_phase));
        motion.places.emplace_back(half_stroke * (std::tanh(theta) + std::tanh(last_phase)), 0, 0);
    }
    return motion;
}

} // namespace hyoryu
