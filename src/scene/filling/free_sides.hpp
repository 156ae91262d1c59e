// SPDX-License-Identifier: MIT
// Detection of water that has no support beside or below it.
#pragma once

#include "hyoryu/scene/fill.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hyoryu {

/// The marks of `fluid_cut`, without those of particles that are not at rest at the start. From
/// such a particle a level or downward path leads, within the support of the kernel [m] and before
/// it reaches a solid, to an empty place or to water whose surface differs in height by more than a
/// spacing. `first`: number of fluid particles to look at, from the first one on. `solids`:
/// positions of the particles of walls and bodies [m].
std::vector<std::uint8_t> free_to_move(const Scene& scene, const Filling& filling,
                                       std::size_t first, std::span<const Vec3> solids,
                                       double support);

} // namespace hyoryu
