// SPDX-License-Identifier: MIT
// Particles of walls from their surfaces, each by itself: a lattice or shells behind the surface
// number all places where a wall may have a particle, and a filling keeps the numbers of those
// where it has one, as runs. So a wall is made again where water comes, and stored nowhere.
#pragma once

#include "hyoryu/fluid/fixed_walls.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <span>

namespace hyoryu {

/// Makes the particles of a filling again: those of index k of `filling.wall`, bit for bit.
/// `surfaces`: of each wall, as `surface_of` gives them. They and the walls of the scene must stay
/// where they are in memory while the maker is used. The depth is 0 where fluid slips.
WallMaker wall_maker(const Scene& scene, const Filling& filling,
                     std::span<const SolidSurface> surfaces);

} // namespace hyoryu
