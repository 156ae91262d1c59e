// SPDX-License-Identifier: MIT
// Particles of a filling that go from one process to another. Afterwards those of each process are
// in the order of their numbers.
#pragma once

#include "hyoryu/scene/fill.hpp"

#include <functional>

namespace hyoryu {

/// Sends each fluid particle to the process `owner(place)`. Called by all.
void give_fluid(Comm& comm, const std::function<int(const Vec3& place)>& owner, Filling& filling);

/// Gives all processes the particles of the walls for which `which(index of the wall)` holds, and
/// no others. Called by all.
void give_walls_to_all(Comm& comm, const std::function<bool(std::int32_t wall)>& which,
                       Filling& filling);

/// Sends the fluid particles `rows[r]` to rank r, and returns those that came. Called by all.
Filling exchange_fluid(Comm& comm, const Filling& filling,
                       const std::vector<std::vector<std::size_t>>& rows);

/// Some rows of the fluid, and nothing else of a filling.
Filling fluid_of(const Filling& filling, const std::vector<std::size_t>& rows);
/// Adds the fluid of another filling.
void join_fluid(const Filling& more, Filling& filling);
/// Exchanges the fluid particles of two fillings, and nothing else.
void swap_fluid(Filling& a, Filling& b);

} // namespace hyoryu
