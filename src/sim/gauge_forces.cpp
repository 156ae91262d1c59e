// SPDX-License-Identifier: MIT
// Forces on the walls and bodies that are gauged, summed over the steps between rows.
#include "hyoryu/sim/gauges.hpp"

#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

// Rows of the particles of a wall or body: those of bodies, of walls that move and of walls that do
// not are each in the order of their owners.
Rows rows_of(const Simulation& sim, const Store& store, int target)
{
    const Index moving = sim.fluid->fixed_walls.moving_rows;
    Rows among = store.rows();
    if (target < 0) {
        const bool moves_itself = moves(sim.scene.walls[at(-1 - target)].motion);
        among = moves_itself ? Rows{0, moving} : Rows{moving, store.size()};
    }
    const auto owners = store.owner().subspan(at(among.begin), at(among.size()));
    // Walls count downward from -1.
    const auto order = [&](std::int32_t a, std::int32_t b) { return target >= 0 ? a < b : a > b; };
    const auto [first, last] = std::equal_range(owners.begin(), owners.end(), target, order);
    return {among.begin + (first - owners.begin()), among.begin + (last - owners.begin())};
}

// Sum of the viscous forces on the particles of a wall or body; zero where the fluid slips.
Vec3 viscous_force(const Simulation& sim, int target)
{
    const Store& store = target >= 0 ? sim.fluid->particles.body : sim.fluid->particles.wall;
    if (!sticks_to_solids(*sim.fluid) || !store.has(field::viscous_force)) {
        return Vec3::Zero();
    }
    const auto F = store[field::viscous_force];
    const Rows rows = rows_of(sim, store, target);
    return sum_of_vectors(rows.size(), sum_units(sim.fluid->parameters).force,
                          [&](Index k) -> const Vec3& { return F[rows.begin + k]; });
}

Vec3 contact_impulse(const std::vector<Contact>& contacts, int target)
{
    Vec3 total = Vec3::Zero();
    for (const Contact& c : contacts) {
        const Vec3 P = c.normal_impulse * c.normal + c.tangential_impulse;
        if (c.a == target) {
            total += P;
        } else if (c.b == target) {
            total -= P;
        }
    }
    return total;
}

} // namespace

void book_forces(Simulation& sim, double dt)
{
    for (GaugedForce& force : sim.gauges.forces) {
        if (sim.fluid) {
            const Vec3 both = force.target >= 0 ? sim.loads.bodies[at(force.target)].force
                                                : sim.loads.walls[at(-1 - force.target)];
            force.viscous = viscous_force(sim, force.target);
            force.pressure = both - force.viscous;
            force.fluid_impulse += dt * both;
        }
        force.contact_impulse += contact_impulse(sim.contacts, force.target);
    }
}

} // namespace hyoryu
