// SPDX-License-Identifier: MIT
#include "metric.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu::bench {

namespace {

constexpr double mm = 1e3; // millimetres in a metre
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Vec3 displacement(const Trace& trace, std::size_t body)
{
    return trace.back().states[body].position - trace.front().states[body].position;
}

double lowest_corner(const Solid& box, const State& state)
{
    const Vec3 reach = (state.orientation.toRotationMatrix().row(2).transpose()).cwiseAbs();
    return state.position.z() - reach.dot(box.size) / 2;
}

// The sample nearest to a time.
const Sample& sample_at(const Trace& trace, double time)
{
    const auto nearer = [time](const Sample& a, const Sample& b) {
        return std::abs(a.time - time) < std::abs(b.time - time);
    };
    return *std::min_element(trace.begin(), trace.end(), nearer);
}

} // namespace

Vec3 inertia(const Solid& solid)
{
    if (solid.form == Solid::Form::ball) {
        return Vec3::Constant(0.1 * solid.mass * sq(solid.size.x()));
    }
    const Vec3 squares = solid.size.cwiseAbs2();
    return solid.mass / 12 * (Vec3::Constant(squares.sum()) - squares);
}

Vec3 angular_momentum(const Solid& solid, const State& state)
{
    return state.orientation *
           inertia(solid).cwiseProduct(state.orientation.conjugate() * state.omega);
}

double kinetic_energy(const Solid& solid, const State& state)
{
    return solid.mass * state.velocity.squaredNorm() / 2 +
           state.omega.dot(angular_momentum(solid, state)) / 2;
}

Metric rms_height(const std::string& name, double until, std::function<double(double)> exact)
{
    return {name, "mm", 0, [until, exact](const Scene&, const Trace& trace) {
                double sum = 0;
                double count = 0;
                for (const Sample& sample : trace) {
                    if (sample.time <= until) {
                        sum += sq(sample.states[0].position.z() - exact(sample.time));
                        ++count;
                    }
                }
                return mm * std::sqrt(sum / count);
            }};
}

Metric apex(int k, double exact)
{
    return {"apex " + std::to_string(k), "mm", exact, [k](const Scene& scene, const Trace& trace) {
                int found = 0;
                for (std::size_t n = 1; n + 1 < trace.size(); ++n) {
                    const State& state = trace[n].states[0];
                    const double z = state.position.z();
                    if (z > trace[n - 1].states[0].position.z() &&
                        z >= trace[n + 1].states[0].position.z() && ++found == k) {
                        // Between two samples the flight is a parabola.
                        return mm * (z + sq(state.velocity.z()) / (2 * scene.gravity.norm()));
                    }
                }
                return nan;
            }};
}

Metric largest_tilt()
{
    return {"largest tilt", "mrad", 0, [](const Scene&, const Trace& trace) {
                const Vec3 up = trace.front().states[0].orientation * Vec3::UnitZ();
                double tilt = 0;
                for (const Sample& sample : trace) {
                    const Vec3 axis = sample.states[0].orientation * Vec3::UnitZ();
                    tilt = std::max(tilt, std::atan2(axis.cross(up).norm(), axis.dot(up)));
                }
                return 1e3 * tilt;
            }};
}

Metric at_time(const std::string& name, const std::string& unit, double time, double exact,
               std::function<double(const State&)> number)
{
    return {name, unit, exact, [time, number](const Scene&, const Trace& trace) {
                return number(sample_at(trace, time).states[0]);
            }};
}

Metric distance_at(double time, const Vec3& place)
{
    return at_time("distance from the exact place", "mm", time, 0,
                   [place](const State& state) { return mm * (state.position - place).norm(); });
}

Metric travel(const std::string& name, double exact)
{
    return {name, "mm", exact,
            [](const Scene&, const Trace& trace) { return mm * displacement(trace, 0).norm(); }};
}

Metric mean_acceleration(double from, double to, double exact)
{
    return {"acceleration", "m/s2", exact, [from, to](const Scene&, const Trace& trace) {
                const Sample& early = sample_at(trace, from);
                const Sample& late = sample_at(trace, to);
                const Vec3 way = displacement(trace, 0).normalized();
                const Vec3 gain = late.states[0].velocity - early.states[0].velocity;
                return gain.dot(way) / (late.time - early.time);
            }};
}

Metric top_drift()
{
    return {"drift of the top", "mm", 0, [](const Scene& scene, const Trace& trace) {
                return mm * displacement(trace, scene.solids.size() - 1).head<2>().norm();
            }};
}

Metric top_sink()
{
    return {"sink of the top", "mm", 0, [](const Scene& scene, const Trace& trace) {
                return -mm * displacement(trace, scene.solids.size() - 1).z();
            }};
}

Metric late_energy()
{
    return {"kinetic energy, second half", "J", 0, [](const Scene& scene, const Trace& trace) {
                double sum = 0;
                const std::size_t half = trace.size() / 2;
                for (std::size_t n = half; n < trace.size(); ++n) {
                    for (std::size_t k = 0; k < scene.solids.size(); ++k) {
                        sum += kinetic_energy(scene.solids[k], trace[n].states[k]);
                    }
                }
                return sum / static_cast<double>(trace.size() - half);
            }};
}

Metric deepest_corner()
{
    return {"deepest corner", "mm", 0, [](const Scene& scene, const Trace& trace) {
                double lowest = 0;
                for (const Sample& sample : trace) {
                    lowest = std::min(lowest, lowest_corner(scene.solids[0], sample.states[0]));
                }
                return mm * lowest;
            }};
}

} // namespace hyoryu::bench
