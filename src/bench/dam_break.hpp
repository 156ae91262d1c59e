// SPDX-License-Identifier: MIT
// The reference scene: a dam break with a column.
#pragma once

#include "hyoryu/bench/bench.hpp"
#include "hyoryu/sim/simulation.hpp"

namespace hyoryu::bench {

/// The fluid of the reference scene [m3].
inline constexpr double reference_volume = 0.4 * 0.67 * 0.3;

/// The water of example 01_DamBreak of DualSPHysics, its tank and its column, at the given spacing
/// [m]: artificial viscosity 0.05, sound speed 20 sqrt(g H), the other effects as by default.
Simulation make_dam_break(double spacing);

/// Advances to that time [s], or restores the state in `folder` if it fits the scene. A state that
/// was computed is saved there; with an empty folder nothing is saved.
void develop(Simulation& sim, double time, const std::filesystem::path& folder);

/// Times steps from the present state on, by one thread and by all in turn.
StepRates measure_steps(Simulation& sim, const std::string& name, const Extent& extent,
                        int threads);

} // namespace hyoryu::bench
