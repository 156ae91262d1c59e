// SPDX-License-Identifier: MIT
// The messages by which the stages of a step update ghosts on other ranks.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

/// Adds the listed columns to a delivery, where the store of a kind has them.
template <class... F>
void deliver(Delivery& delivery, const Links& links, const Tiles& tiles, const Store& own,
             Store& ghosts, Fields<F...>)
{
    const auto add = [&](auto field) {
        if (own.has(field)) {
            delivery.add(links, tiles, own, ghosts, field);
        }
    };
    (add(F{}), ...);
}

template <class List>
void deliver_fluid(Delivery& delivery, Fluid& fluid, List fields)
{
    Ghosts& g = *fluid.ghosts;
    deliver(delivery, g.fluid.links, fluid.neighbours.fluid, fluid.particles.fluid,
            g.particles.fluid, fields);
}
template <class List>
void deliver_walls(Delivery& delivery, Fluid& fluid, List fields)
{
    Ghosts& g = *fluid.ghosts;
    deliver(delivery, g.wall.links, fluid.neighbours.wall, fluid.particles.wall, g.particles.wall,
            fields);
}
template <class List>
void deliver_bodies(Delivery& delivery, Fluid& fluid, List fields)
{
    Ghosts& g = *fluid.ghosts;
    deliver(delivery, g.body.links, fluid.neighbours.body, fluid.particles.body, g.particles.body,
            fields);
}

/// Sends columns of the fluid; nothing without ranks.
template <class List>
void share_fluid(Fluid& fluid, List fields)
{
    if (fluid.ghosts) {
        Delivery delivery;
        deliver_fluid(delivery, fluid, fields);
        delivery.send(fluid.ghosts->comm, fluid.ghosts->outbox, fluid.ghosts->inbox);
    }
}
/// Sends columns of walls and bodies; nothing without ranks.
template <class List>
void share_solids(Fluid& fluid, List fields)
{
    if (fluid.ghosts) {
        Delivery delivery;
        deliver_walls(delivery, fluid, fields);
        deliver_bodies(delivery, fluid, fields);
        delivery.send(fluid.ghosts->comm, fluid.ghosts->outbox, fluid.ghosts->inbox);
    }
}

/// Starts sending the pressures and volumes of solid particles to the ranks that have ghosts of
/// them.
void send_pressures(Fluid& fluid);
/// Waits for the pressures of ghosts and loads them into the records. Does nothing if none were
/// sent.
void receive_pressures(Fluid& fluid);

/// The same for the velocities of all particles that move.
void send_velocities(Fluid& fluid);
void receive_velocities(Fluid& fluid);

/// Restricts what is sent to the ghosts that the neighbour lists read. Called after each list
/// build.
void choose_links(Fluid& fluid);
/// The fluid rows that left the range of this rank go to their owners, those that left the domain
/// stay.
void migrate_fluid(Fluid& fluid, const TileLattice& lattice);
/// Tiles and rows of the ghosts, from own tiles that were just made.
void make_ghosts_of_fluid(Fluid& fluid);
void make_ghosts_of_walls(Fluid& fluid);
void make_ghosts_of_bodies(Fluid& fluid);
/// Sends the friction on all body particles to all ranks: it acts a step later, when other ranks
/// may own them.
void replicate_body_friction(Fluid& fluid);
/// Friction on wall particles, on its way to the ranks that own them from now on.
class FrictionOnTheMove {
public:
    /// Sends the friction on own particles to the ranks that own them from now on.
    FrictionOnTheMove(Fluid& fluid, const TileLattice& lattice);
    /// Stores it in the particles after the stores were remade.
    void arrive(Fluid& fluid) const;

private:
    std::vector<Parcel> wall_; // numbers and forces
};

} // namespace hyoryu
