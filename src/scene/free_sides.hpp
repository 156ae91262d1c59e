// SPDX-License-Identifier: MIT
// Water with nothing beside or below it that holds it.
#pragma once

#include "hyoryu/scene/fill.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hyoryu {

/// The marks of `fluid_cut` without those of particles that are not at rest at the start: a level
/// way, or one down, leads from them to an empty place, or to water whose surface is higher or
/// lower by more than a spacing, within the support of the kernel [m] before it leads to a solid.
/// `first`: number of fluid particles to look at, from the first one on. `solids`: positions of the
/// particles of walls and bodies [m].
std::vector<std::uint8_t> free_to_move(const Scene& scene, const Filling& filling,
                                       std::size_t first, std::span<const Vec3> solids,
                                       double support);

} // namespace hyoryu
