// SPDX-License-Identifier: MIT
// Forces on the walls and bodies that are gauged, summed over the steps between rows.
#include "hyoryu/sim/gauges.hpp"

#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/fluid/totals.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Sum of the viscous forces on the particles of a wall or body; zero where the fluid slips.
Vec3 viscous_force(const Simulation& sim, int target)
{
    const Store& store = target >= 0 ? sim.fluid->particles.body : sim.fluid->particles.wall;
    if (!sticks_to_solids(*sim.fluid) || !store.has(field::viscous_force)) {
        return Vec3::Zero();
    }
    const auto F = store[field::viscous_force];
    const auto owner = store.owner();
    const Rows rows = target >= 0 ? sim.body_particles.of[at(target)] : store.rows();
    const Vec3 none = Vec3::Zero();
    const FixedUnit unit = sum_units(sim.fluid->parameters).force;
    const auto term = [&](Index k) -> const Vec3& {
        const Index row = rows.begin + k;
        return owner[row] == target ? F[row] : none;
    };
    // All processes know the friction on all bodies.
    Comm* const sharing = target >= 0 ? nullptr : comm_of(*sim.fluid);
    return vector_sum_over_ranks(sharing, rows.size(), unit, term);
}

// With its part of the forces on particles of walls that it meets.
Vec3 force_on_wall(const Loads& loads, std::size_t wall)
{
    return loads.at_junctions.empty() ? loads.walls[wall]
                                      : Vec3(loads.walls[wall] + loads.at_junctions[wall]);
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
                                                : force_on_wall(sim.loads, at(-1 - force.target));
            force.viscous = viscous_force(sim, force.target);
            force.pressure = both - force.viscous;
            force.fluid_impulse += dt * both;
        }
        force.contact_impulse += contact_impulse(sim.contacts, force.target);
    }
}

} // namespace hyoryu
