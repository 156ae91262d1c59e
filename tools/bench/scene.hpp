// SPDX-License-Identifier: MIT
// The scenes of the contact benchmarks as plain data, the same for every engine. SI.
#pragma once

#include "hyoryu/core/types.hpp"

#include <functional>
#include <string>
#include <vector>

namespace hyoryu::bench {

inline constexpr double g = 9.81; // [m/s2]

/// How a body moves: pose, velocity of the centre of mass and angular velocity in world axes.
struct State {
    Vec3 position{0, 0, 0};              // [m]
    Quat orientation = Quat::Identity(); // body to world
    Vec3 velocity{0, 0, 0};              // [m/s]
    Vec3 omega{0, 0, 0};                 // [rad/s]
};

/// A body of uniform density: a box, or a ball whose diameter is size.x().
struct Solid {
    enum class Form { box, ball };
    Form form = Form::box;
    Vec3 size{1, 1, 1}; // [m]
    double mass = 1;    // [kg]
    State start;
};

/// What does not move. The floor is z = 0; a slab's top is z = 0; a basin's floor is z = 0 with
/// four walls around the z axis, open above.
struct Ground {
    enum class Form { none, floor, slab, basin };
    Form form = Form::none;
    Vec3 size{0, 0, 0}; // of a slab, or of the inside of a basin [m]
};

/// The states of all bodies at one time.
struct Sample {
    double time = 0; // [s]
    std::vector<State> states;
};
using Trace = std::vector<Sample>;

/// How long a benchmark may take.
enum class Extent { quick, full };

struct Scene;

/// A number that the run should give, and how it is read off the run.
struct Metric {
    std::string name;
    std::string unit;
    double exact = 0; // in the metric's unit
    std::function<double(const Scene&, const Trace&)> measure;
};

struct Scene {
    std::string name;
    std::string what; // one line for the tables
    std::vector<Solid> solids;
    Ground ground;
    Vec3 gravity{0, 0, -g};
    double restitution = 0;
    double friction = 0;
    double duration = 1;          // [s]
    Extent least = Extent::quick; // the shortest benchmark that runs it unasked
    // A heap is judged by its end alone, and its cost is told apart into falling and resting.
    enum class Kind { exact, heap } kind = Kind::exact;
    std::vector<Metric> metrics;
};

/// Principal moments of inertia [kg m2].
Vec3 inertia(const Solid& solid);
/// 1/2 m v^2 + 1/2 omega . I omega [J]
double kinetic_energy(const Solid& solid, const State& state);
/// L about the centre of mass, in world axes [kg m2/s].
Vec3 angular_momentum(const Solid& solid, const State& state);

/// Every scene of the benchmark: the peers' table of the contact notes, and the heaps. In a quick
/// benchmark the stacks are watched for a shorter time.
std::vector<Scene> all_scenes(Extent extent);

/// The parts of it.
std::vector<Scene> drop_scenes();
std::vector<Scene> sliding_scenes();
std::vector<Scene> timber_scenes();
std::vector<Scene> heap_scenes();

} // namespace hyoryu::bench
