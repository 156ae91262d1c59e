// SPDX-License-Identifier: MIT
#include "hyoryu/sim/covered_walls.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/covered_share.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <span>

namespace hyoryu {

namespace {

// For each wall that moves, the fixed ones that are near it; `ways`: of the walls since time 0 [m].
std::vector<std::vector<int>> near_walls(const Simulation& sim, const std::vector<Vec3>& ways)
{
    const std::vector<SolidSurface>& surfaces = sim.barrier->solids;
    const bool periodic = periods_of(sim.scene).length != Vec3(0, 0, 0);
    std::vector<std::vector<int>> near(sim.scene.walls.size());
    for (std::size_t w = 0; w < near.size(); ++w) {
        if (!moves(sim.scene.walls[w].motion)) {
            continue;
        }
        const Vec3 centre = surfaces[w].centre + ways[w];
        const double reach = surfaces[w].reach + sim.scene.spacing;
        for (const int k : sim.covered.fixed) {
            const SolidSurface& solid = surfaces[at(k)];
            // An image of a wall may be near fixed ones that the wall itself is far from.
            if (!(reach < infinity) || periodic ||
                nearest_from_centre(solid, centre - solid.centre).distance < reach) {
                near[w].push_back(k);
            }
        }
    }
    return near;
}

// Displaced masses of the rows of moving walls with the walls at `ways`.
void set_masses(Simulation& sim, const std::vector<Vec3>& ways)
{
    const std::vector<std::vector<int>> near = near_walls(sim, ways);
    Store& store = sim.fluid->particles.wall;
    const auto mass = store[field::displaced_mass];
    const auto owner = store.owner();
    const std::span<const SolidSurface> surfaces = sim.barrier->solids;
    const Periods periods = periods_of(sim.scene);
    parallel_for(0, static_cast<Index>(sim.covered.mass.size()), [&](Index i) {
        const std::size_t wall = at(-1 - owner[i]);
        const Vec3 place = sim.wall_start[at(i)] + ways[wall]; // not an image in a periodic domain
        mass[i] = sim.covered.mass[at(i)] *
                  static_cast<real>(
                      uncovered_share(surfaces, near[wall], place, sim.scene.spacing, periods));
    });
}

} // namespace

CoveredWalls covered_walls(const Simulation& sim)
{
    CoveredWalls covered;
    std::vector<int> fixed = fixed_walls_of(sim.scene);
    if (sim.fluid->moving_walls && !fixed.empty()) {
        covered.fixed = std::move(fixed);
        const auto mass = sim.fluid->particles.wall[field::displaced_mass];
        covered.mass.assign(mass.begin(), mass.begin() + sim.fluid->fixed_walls.moving_rows);
    }
    return covered;
}

void cover_walls(Simulation& sim, double time)
{
    if (sim.covered.mass.empty()) {
        return;
    }
    std::vector<Vec3> ways;
    for (const Wall& wall : sim.scene.walls) {
        ways.push_back(displacement(wall.motion, time));
    }
    if (ways != sim.covered.ways) {
        set_masses(sim, ways);
        sim.covered.ways = std::move(ways);
    }
    Store& store = sim.fluid->particles.wall;
    const auto rho = store[field::density];
    const auto mass = store[field::displaced_mass];
    const auto V = store[field::volume];
    parallel_for(0, static_cast<Index>(sim.covered.mass.size()),
                 [&](Index i) { V[i] = mass[i] / rho[i]; });
}

} // namespace hyoryu
