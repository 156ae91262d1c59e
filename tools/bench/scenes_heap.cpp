// SPDX-License-Identifier: MIT
// Heaps: boxes dropped into a basin in columns with small seeded offsets, left to settle.
#include "scene.hpp"

#include "hyoryu/rigid/rigid.hpp"

#include <algorithm>
#include <cstdint>

namespace hyoryu::bench {

namespace {

constexpr double edge = 0.1;     // [m]
constexpr double mass = 0.5;     // [kg]
constexpr double pitch = 0.13;   // of the lattice [m]
constexpr double offset = 0.008; // largest offset along an axis [m]
constexpr double tilt = 0.1;     // largest angle about an axis [rad]

// A number in [-1, 1] that is a function of its place alone. Source: the finaliser of SplitMix64,
// Steele et al. (2014).
double uniform(std::uint64_t place)
{
    std::uint64_t z = (place + 1) * 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    return static_cast<double>(z >> 11) / 4503599627370496.0 - 1; // 2^52
}

Vec3 uniform_vector(std::uint64_t body, std::uint64_t purpose)
{
    const std::uint64_t place = 6 * body + 3 * purpose;
    return {uniform(place), uniform(place + 1), uniform(place + 2)};
}

Body as_body(const Solid& solid, const State& state)
{
    Body body;
    body.shape = box_polytope(solid.size, 3);
    body.position = state.position;
    body.orientation = state.orientation;
    return body;
}

// Deepest overlap of two boxes or of a box and the basin's floor or sides [mm].
double deepest_overlap(const Scene& scene, const Trace& trace)
{
    const std::vector<State>& states = trace.back().states;
    const Vec3 half{scene.ground.size.x() / 2, scene.ground.size.y() / 2, 0};
    double deepest = 0;
    for (std::size_t a = 0; a < states.size(); ++a) {
        const Vec3 span =
            states[a].orientation.toRotationMatrix().cwiseAbs() * scene.solids[a].size / 2;
        const Vec3& x = states[a].position;
        deepest = std::max({deepest, span.z() - x.z(), std::abs(x.x()) + span.x() - half.x(),
                            std::abs(x.y()) + span.y() - half.y()});
        for (std::size_t b = a + 1; b < states.size(); ++b) {
            if ((states[b].position - x).norm() < 1.8 * edge) {
                Rigid pair;
                pair.bodies.push_back(as_body(scene.solids[a], states[a]));
                pair.bodies.push_back(as_body(scene.solids[b], states[b]));
                deepest = std::max(deepest, overlap(pair, 0, 1, 0));
            }
        }
    }
    return 1e3 * deepest;
}

double energy_at_end(const Scene& scene, const Trace& trace)
{
    double sum = 0;
    for (std::size_t k = 0; k < scene.solids.size(); ++k) {
        sum += kinetic_energy(scene.solids[k], trace.back().states[k]);
    }
    return sum;
}

// Boxes whose centre is not inside the basin.
double lost(const Scene& scene, const Trace& trace)
{
    const Vec3 half = scene.ground.size / 2;
    return static_cast<double>(
        std::count_if(trace.back().states.begin(), trace.back().states.end(), [&](const State& s) {
            return !(std::abs(s.position.x()) < half.x() && std::abs(s.position.y()) < half.y() &&
                     s.position.z() > 0);
        }));
}

Scene heap(int boxes, int columns, double duration)
{
    Scene scene;
    scene.name = "heap_" + std::to_string(boxes);
    scene.what = std::to_string(boxes) + " boxes dropped into a basin";
    for (int k = 0; k < boxes; ++k) {
        const int i = k % columns;
        const int j = k / columns % columns;
        const int layer = k / (columns * columns);
        const auto number = static_cast<std::uint64_t>(k);
        const Vec3 place =
            Vec3(i - (columns - 1) / 2.0, j - (columns - 1) / 2.0, layer + 1) * pitch;
        const Vec3 angles = tilt * uniform_vector(number, 1);
        const Quat q(Eigen::AngleAxisd(angles.norm(), angles.normalized()));
        scene.solids.push_back({Solid::Form::box,
                                Vec3::Constant(edge),
                                mass,
                                {place + offset * uniform_vector(number, 0), q}});
    }
    const double width = (columns + 1) * pitch;
    scene.ground = {Ground::Form::basin, {width, width, 3 * width + 2}};
    scene.restitution = 0.2;
    scene.friction = 0.5;
    scene.duration = duration;
    scene.kind = Scene::Kind::heap;
    scene.metrics = {{"worst overlap at the end", "mm", 0, deepest_overlap},
                     {"kinetic energy at the end", "J", 0, energy_at_end},
                     {"boxes lost", "1", 0, lost}};
    return scene;
}

} // namespace

std::vector<Scene> heap_scenes()
{
    std::vector<Scene> list = {heap(10, 2, 2), heap(100, 5, 2), heap(1000, 10, 3)};
    list.back().least = Extent::full;
    return list;
}

} // namespace hyoryu::bench
