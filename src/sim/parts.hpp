// SPDX-License-Identifier: MIT
// Functions that the start of a simulation shares with its steps.
#pragma once

#include "hyoryu/core/built_effects.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <string_view>

namespace hyoryu {

// Optional parts of a step besides the effects of the fluid, by the names of the plan.
struct RigidMotion {
    static constexpr std::string_view name = "rigid_motion";
};
struct BodyLoad {
    static constexpr std::string_view name = "body_load";
};
struct JointSeepage {
    static constexpr std::string_view name = "seepage";
};
struct MovingWalls {
    static constexpr std::string_view name = "moving_walls";
};
struct SurfaceBarrier {
    static constexpr std::string_view name = "wall_barrier";
};
struct Sponges {
    static constexpr std::string_view name = "sponge";
};
struct RoughBeds {
    static constexpr std::string_view name = "bed_friction";
};
struct WaveAbsorption {
    static constexpr std::string_view name = "wave_absorption";
};
struct OpenSides {
    static constexpr std::string_view name = "open_boundary";
};
struct Gauges {
    static constexpr std::string_view name = "gauges";
};

/// Whether joints under standing bodies are open to water.
inline bool has_seepage(const Simulation& sim)
{
    return is_built<JointSeepage> && !sim.seepage.open.empty();
}

/// Sets positions and velocities of body particles to those after free flight for the time `ahead`
/// [s].
void fly_bodies(Simulation& sim, double ahead);

/// Lists where they are due; the only moment at which fluid rows come and go.
void update_lists(Simulation& sim);

} // namespace hyoryu
