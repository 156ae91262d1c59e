// SPDX-License-Identifier: MIT
// Buildings from footprints: prisms that stand on the ground, each a wall.
#pragma once

#include "geojson.hpp"
#include "place_fault.hpp"

#include "hyoryu/scene/scene.hpp"

namespace hyoryu {

/// Walls from footprints, with what is wrong with them or worth knowing.
struct Buildings {
    std::vector<Wall> walls;
    std::vector<PlaceFault> faults;
    std::vector<PlaceFault> warnings;
};

/// The first wall of the scene that is terrain, or none.
const Wall* terrain_of(const Scene& scene);

/// The prisms on footprints in the coordinates of the terrain, or in the axes of the case without
/// one. A prism reaches from three spacings below the lowest ground under it to its height above
/// that ground, which is the terrain, or else all walls that do not move. Footprints wholly beside
/// the terrain are left out. A footprint without a name becomes PREFIX.N, N its number in the file.
Buildings place_buildings(const std::vector<Footprint>& footprints, const std::string& prefix,
                          const Scene& scene);

} // namespace hyoryu
