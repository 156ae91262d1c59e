// SPDX-License-Identifier: MIT
#include "own_particles.hpp"

#include "hyoryu/core/motion.hpp"
#include "hyoryu/fluid/whole.hpp"
#include "hyoryu/scene/filling_exchange.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// A run of particles in a tile.
struct TileRun {
    std::uint64_t tile = 0;
    IndexRun run;
};

// Joins what all ranks have found.
void join(Comm& comm, FixedWalls& walls)
{
    std::vector<TileRun> own;
    for (std::size_t t = 0; t < walls.tile.size(); ++t) {
        for (std::int32_t k = walls.start[t]; k < walls.start[t + 1]; ++k) {
            own.push_back({walls.tile[t], walls.run[at(k)]});
        }
    }
    std::vector<TileRun> all = gather(comm, std::span<const TileRun>(own)).all;
    std::ranges::sort(all, {}, [](const TileRun& r) { return std::pair(r.tile, r.run.first); });
    walls.tile.clear();
    walls.start.clear();
    walls.run.clear();
    for (const TileRun& one : all) {
        append_run(walls, one.tile, one.run);
    }
    walls.start.push_back(static_cast<std::int32_t>(walls.run.size()));
    std::array<std::int64_t, 2> counts{walls.count, walls.moving_rows};
    comm.add(counts);
    walls.count = counts[0];
    walls.moving_rows = counts[1];
}

} // namespace

bool is_moving(const Scene& scene, std::int32_t wall)
{
    return moves(scene.walls[at(wall)].motion);
}

FixedWalls find_fixed_walls(const Scene& scene, const Filling& filling, const TileLattice& lattice,
                            Comm* comm)
{
    FixedWalls walls;
    std::vector<std::int32_t> index;
    std::vector<Vec3> place;
    for (std::size_t k = 0; k < filling.wall.size(); ++k) {
        if (is_moving(scene, filling.wall_owner[k])) {
            ++walls.moving_rows;
            continue;
        }
        index.push_back(static_cast<std::int32_t>(filling.number_of_wall(k)));
        place.push_back(filling.wall[k]);
    }
    walls.first_number = filling.fluid_count();
    walls.count = static_cast<Index>(index.size());
    if (walls.count > 0) {
        sort_into_tiles(walls, lattice, index, place);
    }
    if (comm != nullptr) {
        join(*comm, walls);
    }
    return walls;
}

Cuts deal_out(const Scene& scene, const TileLattice& lattice, Comm& comm, Filling& filling)
{
    const auto tile_of = [&](const Vec3& x) { return lattice.tile_of(lattice.wrapped(x)); };
    const Cuts cuts = even_cuts(lattice, filling.fluid, comm);
    give_fluid(
        comm, [&](const Vec3& x) { return cuts.owner(tile_of(x)); }, filling);
    give_walls_to_all(
        comm, [&](std::int32_t wall) { return is_moving(scene, wall); }, filling);
    return cuts;
}

} // namespace hyoryu
