// SPDX-License-Identifier: MIT
// What the benchmark asks of an engine, and the engines that this build has.
#pragma once

#include "scene.hpp"

#include <limits>
#include <memory>

namespace hyoryu::bench {

/// A scene inside an engine, stepped by a fixed time.
class World {
public:
    virtual ~World() = default;
    virtual void step() = 0;
    virtual State state(int body) const = 0;
    /// Contact points of the last step, as the engine makes them.
    virtual int contacts() const = 0;
};

/// An engine with one choice of its settings.
struct Engine {
    std::string name;
    std::string settings; // one line for the tables
    std::vector<double>
        steps; // time steps to run at; the first is the one that costs are given at [s]
    std::function<std::unique_ptr<World>(const Scene&, double dt)> make;
    std::size_t most_bodies = std::numeric_limits<std::size_t>::max(); // that it has room for
};

/// Hyoryu first, then what was found when this program was configured.
std::vector<Engine> engines();

std::vector<Engine> hyoryu_engines();
std::vector<Engine> bullet_engines();
std::vector<Engine> ode_engines();
std::vector<Engine> mujoco_engines();

} // namespace hyoryu::bench
