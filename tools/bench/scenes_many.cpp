// SPDX-License-Identifier: MIT
// Stacks, mass ratios, the cradle, the free rotor, and the list of all scenes.
#include "metric.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu::bench {

namespace {

// Boxes of 0.2 m on one another that must stand.
Scene stack(const std::string& name, const std::vector<double>& masses, double duration)
{
    constexpr double edge = 0.2;
    Scene scene;
    scene.name = name;
    double z = edge / 2;
    for (const double mass : masses) {
        scene.solids.push_back({Solid::Form::box, Vec3::Constant(edge), mass, {{0, 0, z}}});
        z += edge;
    }
    scene.ground.form = Ground::Form::floor;
    scene.friction = 0.5;
    scene.duration = duration;
    scene.metrics = {top_drift(), top_sink(), late_energy()};
    return scene;
}

Metric cradle_error()
{
    return {"largest error of a speed", "m/s", 0, [](const Scene& scene, const Trace& trace) {
                double error = 0;
                for (std::size_t k = 0; k < scene.solids.size(); ++k) {
                    const double exact = k + 1 == scene.solids.size() ? 1 : 0;
                    const Vec3& v = trace.back().states[k].velocity;
                    error = std::max(error, (v - Vec3(exact, 0, 0)).norm());
                }
                return error;
            }};
}

// Five balls, e = 1: the first hits at 1 m/s and only the last leaves, at 1 m/s.
Scene cradle(const std::string& name, const std::string& what, double gap)
{
    constexpr double R = 0.05;
    Scene scene;
    scene.name = name;
    scene.what = what;
    for (int k = 0; k < 5; ++k) {
        const double x = k == 0 ? -2 * R - 0.05 : (k - 1) * (2 * R + gap);
        scene.solids.push_back({Solid::Form::ball, Vec3::Constant(2 * R), 1, {{x, 0, 0}}});
    }
    scene.solids[0].start.velocity = {1, 0, 0};
    scene.gravity = {0, 0, 0};
    scene.restitution = 1;
    scene.duration = 0.3;
    scene.metrics = {cradle_error()};
    return scene;
}

int flips(const Trace& trace)
{
    int count = 0;
    double last = 1;
    for (const Sample& sample : trace) {
        const State& state = sample.states[0];
        const double omega_y = (state.orientation.conjugate() * state.omega).y();
        if (omega_y * last < 0) {
            ++count;
            last = omega_y;
        }
    }
    return count;
}

// A box spinning about its middle axis turns over and over: ten times in 20 s.
Scene dzhanibekov()
{
    Scene scene;
    scene.name = "j_rotor";
    scene.what = "free box spinning about its middle axis, 20 s";
    scene.solids = {{Solid::Form::box, {0.3, 0.2, 0.05}, 3, {}}};
    scene.solids[0].start.omega = {0.1, 10, 0};
    scene.gravity = {0, 0, 0};
    scene.duration = 20;
    const auto L = [](const Scene& s, const Sample& at) {
        return angular_momentum(s.solids[0], at.states[0]);
    };
    const auto energy = [](const Scene& s, const Trace& trace) {
        return 100 * (kinetic_energy(s.solids[0], trace.back().states[0]) /
                          kinetic_energy(s.solids[0], trace.front().states[0]) -
                      1);
    };
    const auto turn_of_L = [L](const Scene& s, const Trace& trace) {
        const Vec3 a = L(s, trace.front());
        const Vec3 b = L(s, trace.back());
        return 180 / 3.14159265358979323846 * std::atan2(a.cross(b).norm(), a.dot(b));
    };
    scene.metrics = {
        {"drift of the energy", "%", 0, energy},
        {"turn of L", "deg", 0, turn_of_L},
        {"flips", "1", 10, [](const Scene&, const Trace& trace) { return flips(trace); }}};
    return scene;
}

std::vector<Scene> stack_scenes(Extent extent)
{
    std::vector<Scene> list = {
        stack("d_stack10", std::vector<double>(10, 8.0), extent == Extent::full ? 10 : 2),
        stack("e2_ratio", {1, 100}, extent == Extent::full ? 5 : 2),
        stack("e5_ratio", {1, 1, 1, 1, 100}, extent == Extent::full ? 5 : 2)};
    list[0].what = "stack of 10 boxes, 8 kg each";
    list[1].what = "100 kg on 1 kg";
    list[2].what = "100 kg on four boxes of 1 kg";
    return list;
}

std::vector<Scene> flight_scenes()
{
    return {cradle("i_cradle", "five touching balls, e = 1", 0),
            cradle("i_cradle_gap", "five balls 1 mm apart, e = 1", 1e-3), dzhanibekov()};
}

} // namespace

std::vector<Scene> all_scenes(Extent extent)
{
    std::vector<Scene> all;
    for (const auto& part : {drop_scenes(), sliding_scenes(), timber_scenes(), stack_scenes(extent),
                             flight_scenes(), heap_scenes()}) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

} // namespace hyoryu::bench
