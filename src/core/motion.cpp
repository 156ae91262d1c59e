// SPDX-License-Identifier: MIT
#include "hyoryu/core/motion.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

double slope(const Motion& motion, std::size_t k, int axis)
{
    return (motion.places[k + 1][axis] - motion.places[k][axis]) /
           (motion.times[k + 1] - motion.times[k]);
}

// Tangent at a point: zero at the ends and at turning points, else the weighted harmonic mean of
// the two slopes, which keeps the cubic monotone (Fritsch and Butland 1984).
double tangent(const Motion& motion, std::size_t k, int axis)
{
    if (k == 0 || k + 1 == motion.times.size()) {
        return 0;
    }
    const double before = slope(motion, k - 1, axis);
    const double after = slope(motion, k, axis);
    if (before * after <= 0) {
        return 0;
    }
    const double h0 = motion.times[k] - motion.times[k - 1];
    const double h1 = motion.times[k + 1] - motion.times[k];
    return 3 * (h0 + h1) / ((2 * h1 + h0) / before + (h1 + 2 * h0) / after);
}

// The interval that holds t; the caller has made sure that there is one.
std::size_t interval(const Motion& motion, double t)
{
    const auto next = std::upper_bound(motion.times.begin() + 1, motion.times.end() - 1, t);
    return static_cast<std::size_t>(next - motion.times.begin()) - 1;
}

bool rests(const Motion& motion, double t)
{
    return motion.times.size() < 2 || t < motion.times.front() || t > motion.times.back();
}

Vec3 place_on_path(const Motion& motion, double t)
{
    if (motion.times.empty()) {
        return t * motion.velocity;
    }
    if (rests(motion, t)) {
        return t < motion.times.front() ? motion.places.front() : motion.places.back();
    }
    const std::size_t k = interval(motion, t);
    const double h = motion.times[k + 1] - motion.times[k];
    const double s = (t - motion.times[k]) / h;
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = motion.places[k][axis];
        const double b = motion.places[k + 1][axis];
        place[axis] = a + (b - a) * s * s * (3 - 2 * s) +
                      h * s * (1 - s) *
                          ((1 - s) * tangent(motion, k, axis) - s * tangent(motion, k + 1, axis));
    }
    return place;
}

Vec3 velocity_on_path(const Motion& motion, double t)
{
    if (motion.times.empty()) {
        return motion.velocity;
    }
    if (rests(motion, t)) {
        return Vec3::Zero();
    }
    const std::size_t k = interval(motion, t);
    const double s = (t - motion.times[k]) / (motion.times[k + 1] - motion.times[k]);
    Vec3 v;
    for (int axis = 0; axis < 3; ++axis) {
        v[axis] = 6 * s * (1 - s) * slope(motion, k, axis) +
                  (1 - s) * (1 - 3 * s) * tangent(motion, k, axis) +
                  s * (3 * s - 2) * tangent(motion, k + 1, axis);
    }
    return v;
}

} // namespace

Vec3 displacement(const Motion& motion, double t)
{
    Vec3 place = place_on_path(motion, t);
    if (motion.absorption) {
        const Motion::Absorption& a = *motion.absorption;
        place.x() += a.place + (t - a.time) * a.velocity;
    }
    return place;
}

Vec3 velocity(const Motion& motion, double t)
{
    Vec3 v = velocity_on_path(motion, t);
    if (motion.absorption) {
        v.x() += motion.absorption->velocity;
    }
    return v;
}

double asked_level(const Motion& motion, double t)
{
    if (!motion.absorption || motion.absorption->levels.empty() || rests(motion, t)) {
        return 0;
    }
    const std::vector<double>& levels = motion.absorption->levels;
    const std::size_t k = interval(motion, t);
    const double s = (t - motion.times[k]) / (motion.times[k + 1] - motion.times[k]);
    return (1 - s) * levels[k] + s * levels[k + 1];
}

bool moves(const Motion& motion)
{
    if (motion.absorption) {
        return true;
    }
    return motion.times.empty()
               ? motion.velocity.norm() > 0
               : std::any_of(motion.places.begin(), motion.places.end(),
                             [&](const Vec3& place) { return place != motion.places.front(); });
}

double speed_bound(const Motion& motion, double from, double to)
{
    const double added = motion.absorption ? std::abs(motion.absorption->velocity) : 0;
    if (motion.times.size() < 2) {
        return added + (motion.times.empty() ? motion.velocity.norm() : 0);
    }
    // A monotone cubic is nowhere steeper than three times its secant.
    double fastest = 0;
    for (std::size_t k = 0; k + 1 < motion.times.size(); ++k) {
        if (motion.times[k + 1] < from || motion.times[k] > to) {
            continue;
        }
        const Vec3 secant(slope(motion, k, 0), slope(motion, k, 1), slope(motion, k, 2));
        fastest = std::max(fastest, 3 * secant.norm());
    }
    return added + fastest;
}

} // namespace hyoryu
