// SPDX-License-Identifier: MIT
// Wall particles computed one by one from the surface of a wall. A lattice or shells behind the
// surface number all places where a wall may have a particle; a filling stores the numbers of the
// occupied places as runs. Wall particles are recomputed where water arrives instead of being
// stored.
#pragma once

#include "hyoryu/fluid/fixed_walls.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <span>

namespace hyoryu {

/// Makes the particles of a filling again: those of index k of `filling.wall`, bit for bit.
/// `surfaces`: of each wall, as `surface_of` gives them. They and the walls of the scene must stay
/// where they are in memory while the maker is used. The depth is 0 where fluid slips. `cube_mass`:
/// see `mass_of_cube` [kg].
WallMaker wall_maker(const Scene& scene, const Filling& filling,
                     std::span<const SolidSurface> surfaces, real cube_mass);

} // namespace hyoryu
