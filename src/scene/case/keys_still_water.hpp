// SPDX-License-Identifier: MIT
// The extent of still water, which follows from all walls.
#pragma once

#include "keys_walls.hpp"
#include "place_buildings.hpp"
#include "scene/surfaces/seeded_water.hpp"

namespace hyoryu {

/// Gives a block of still water the box about it, or notes why there is none.
inline void find_box(Reading& reading, const std::string& key, const SeededCells& cells,
                     FluidBlock& block, const Scene& scene)
{
    if (!cells.fault.empty()) {
        reading.error(block.place, -1, key + ".seed", cells.fault,
                      terrain_of(scene) != nullptr
                          ? "move the seed to ground below the level, or raise the level; both are "
                            "in the axes of the scene, which `origin`, `azimuth_deg` and `datum` "
                            "of the terrain set"
                          : "move the seed to a place of the scene at which the water is more than "
                            "half a spacing deep, or raise the level");
        return;
    }
    const Bounds box = box_about(cells);
    Vec3 size = box.max - box.min;
    size.y() = scene.dimensions == 2 ? 1 : size.y();
    block.centre = (box.min + box.max) / 2;
    block.shape = BoxShape{size};
    if (cells.leak) {
        reading.warn(block.place, key,
                     fmt::format("the water reaches the edge of the scene at ({:.4g}, {:.4g}, "
                                 "{:.4g}) m, where no wall holds it",
                                 cells.leak->x(), cells.leak->y(), cells.leak->z()),
                     "add a basin with open = [\"+z\", \"-z\"] about the scene, or an [[open]] "
                     "window; where the ground ends before the scene, let both end there");
    }
}

/// Gives all blocks of still water their boxes; two that are connected are a mistake.
inline void find_still_water(TableReader& root, Scene& scene)
{
    Reading& reading = root.reading();
    if (!scene.fluid || !reading.places_known()) {
        return; // walls or numbers are mistaken: no place follows from them
    }
    std::vector<FluidBlock>& blocks = scene.fluid->blocks;
    std::vector<SeededCells> found;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (!blocks[b].seeded) {
            continue;
        }
        const std::string key = fmt::format("fluid.block[{}]", b);
        const SeededWater& water = *blocks[b].seeded;
        if (!(scene.gravity.z() < 0) || scene.gravity.head<2>().norm() > 0) {
            reading.error(blocks[b].place, -1, key + ".shape", "still water needs gravity along -z",
                          "leave `gravity` out: the default is [0, 0, -9.81]");
            continue;
        }
        blocks[b].centre = {water.seed.x(), water.seed.y(), water.level};
        SeededCells cells = seeded_cells(scene, b, domain_of(scene));
        find_box(reading, key, cells, blocks[b], scene);
        for (const SeededCells& other : found) {
            if (share_a_cell(cells, other)) {
                reading.error(blocks[b].place, -1, key + ".seed",
                              "is connected with still water that an earlier block fills",
                              "remove one of them, or close the gap between them");
            }
        }
        found.push_back(std::move(cells));
    }
}

} // namespace hyoryu
