// SPDX-License-Identifier: MIT
#include "solid_cells.hpp"

#include <cmath>
#include <utility>

namespace hyoryu {

SolidCells solid_cells(const Scene& scene, const Filling& filling, std::vector<float> wall_cubes,
                       const FillNeighbours* neighbours)
{
    SolidCells all{filling.wall, std::move(wall_cubes)};
    if (neighbours != nullptr) {
        const std::vector<Vec3>& walls = neighbours->walls();
        const std::vector<float>& cubes = neighbours->wall_cubes();
        all.points.insert(all.points.end(), walls.begin(), walls.end());
        all.cubes.insert(all.cubes.end(), cubes.begin(), cubes.end());
    }
    const double cube = std::pow(scene.spacing, scene.dimensions);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        for (const Vec3& p : filling.bodies[b].points) {
            all.points.push_back(scene.bodies[b].position + scene.bodies[b].rotation * p);
            all.cubes.push_back(static_cast<float>(filling.bodies[b].particle_volume / cube));
        }
    }
    return all;
}

} // namespace hyoryu
