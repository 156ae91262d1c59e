// SPDX-License-Identifier: MIT
// The datasets of particles in a state.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <set>
#include <string>

namespace hyoryu {

inline constexpr const char* tiles_of_fluid = "fluid/tiles";

/// The datasets with a value for each fluid particle.
std::set<std::string> fluid_columns(const Simulation& sim);

/// The tiles of that name; empty without them. Throws IoError if they are incomplete.
Tiles tiles_in(const Snapshot& state, const std::string& name);

/// Throws IoError: a dataset does not fit the tiles of its particles.
[[noreturn]] void refuse_rows(const std::string& name);

} // namespace hyoryu
