// SPDX-License-Identifier: MIT
#include "hyoryu/sim/covered_walls.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/covered_share.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <utility>

namespace hyoryu {

namespace {

constexpr real uncovered = -1; // no moving wall is near

// Notes the displaced masses of the rows that cover or may be covered before the next lists.
void find_rows(Simulation& sim, const Covers& covers)
{
    const FixedWalls& walls = sim.fluid->fixed_walls;
    const Store& store = sim.fluid->particles.wall;
    const auto x = store[field::position];
    const auto id = store.id();
    const double margin = 2 * sim.scene.spacing; // lists are made anew after less
    sim.covered.mass = sim.covered.of_moving;
    sim.covered.mass.resize(at(store.size()), uncovered);
    parallel_for(walls.moving_rows, store.size(), [&](Index row) {
        if (covers.is_moving_near(x[row], margin)) {
            const auto index = static_cast<std::int32_t>(id[row] - walls.first_number);
            sim.covered.mass[at(row)] = walls.make(index).displaced_mass;
        }
    });
}

void set_masses(Simulation& sim, const Covers& covers, const std::vector<Vec3>& ways)
{
    Store& store = sim.fluid->particles.wall;
    const auto x = store[field::position];
    const auto mass = store[field::displaced_mass];
    const auto owner = store.owner();
    parallel_for(0, store.size(), [&](Index row) {
        const real own = sim.covered.mass[at(row)];
        if (own == uncovered) {
            return;
        }
        const auto wall = at(-1 - owner[row]);
        // Of a moving wall the place itself, not its image in a periodic domain.
        const Vec3 place = row < sim.fluid->fixed_walls.moving_rows
                               ? sim.wall_start[at(row)] + ways[wall]
                               : x[row];
        mass[row] = own * static_cast<real>(covers.share(wall, place, sim.scene.spacing));
    });
}

} // namespace

CoveredWalls covered_walls(const Simulation& sim)
{
    const auto is_moving = [](const Wall& wall) { return moves(wall.motion); };
    CoveredWalls covered;
    covered.needed = sim.fluid->moving_walls && !std::ranges::all_of(sim.scene.walls, is_moving);
    if (covered.needed) {
        const auto mass = std::as_const(sim.fluid->particles.wall)[field::displaced_mass];
        covered.of_moving.assign(mass.begin(), mass.begin() + sim.fluid->fixed_walls.moving_rows);
    }
    return covered;
}

void cover_walls(Simulation& sim, double time)
{
    CoveredWalls& covered = sim.covered;
    if (!covered.needed) {
        return;
    }
    std::vector<Vec3> ways;
    for (const Wall& wall : sim.scene.walls) {
        ways.push_back(displacement(wall.motion, time));
    }
    const bool fresh = covered.builds != sim.fluid->neighbours.builds;
    if (!fresh && ways == covered.ways) {
        return;
    }
    const Covers covers(sim.scene, sim.barrier->solids, time);
    if (fresh) {
        find_rows(sim, covers);
    }
    set_masses(sim, covers, ways);
    covered.builds = sim.fluid->neighbours.builds;
    covered.ways = std::move(ways);
}

} // namespace hyoryu
