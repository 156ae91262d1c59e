// SPDX-License-Identifier: MIT
#include "hyoryu/sim/covered_walls.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/covered_share.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

constexpr real uncovered = -1; // no moving wall is near

// Notes the displaced masses of the rows that a moving wall may reach before the next lists.
void find_rows(Simulation& sim, const std::vector<MovedWall>& covers)
{
    const FixedWalls& walls = sim.fluid->fixed_walls;
    const Store& store = sim.fluid->particles.wall;
    const auto x = store[field::position];
    const auto id = store.id();
    const Periods periods = periods_of(sim.scene);
    const double margin = 2 * sim.scene.spacing; // lists are made anew after less
    sim.covered.mass.assign(at(store.size() - walls.moving_rows), uncovered);
    parallel_for(walls.moving_rows, store.size(), [&](Index row) {
        if (uncovered_share(covers, x[row], 2 * margin, periods) < 1) {
            const auto index = static_cast<std::int32_t>(id[row] - walls.first_number);
            sim.covered.mass[at(row - walls.moving_rows)] = walls.make(index).displaced_mass;
        }
    });
}

void set_masses(Simulation& sim, const std::vector<MovedWall>& covers)
{
    Store& store = sim.fluid->particles.wall;
    const auto x = store[field::position];
    const auto mass = store[field::displaced_mass];
    const Index first = sim.fluid->fixed_walls.moving_rows;
    const Periods periods = periods_of(sim.scene);
    parallel_for(first, store.size(), [&](Index row) {
        if (const real own = sim.covered.mass[at(row - first)]; own != uncovered) {
            const double share = uncovered_share(covers, x[row], sim.scene.spacing, periods);
            mass[row] = own * static_cast<real>(share);
        }
    });
}

} // namespace

CoveredWalls covered_walls(const Simulation& sim)
{
    const auto is_moving = [](const Wall& wall) { return moves(wall.motion); };
    CoveredWalls covered;
    covered.needed = sim.fluid->moving_walls && !std::ranges::all_of(sim.scene.walls, is_moving);
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
    const std::vector<MovedWall> covers = moving_covers(sim.scene, sim.barrier->solids, time);
    if (fresh) {
        find_rows(sim, covers);
    }
    set_masses(sim, covers);
    covered.builds = sim.fluid->neighbours.builds;
    covered.ways = std::move(ways);
}

} // namespace hyoryu
