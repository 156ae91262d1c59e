// SPDX-License-Identifier: MIT
// Ghosts: copies of particles of other ranks in a case distributed over several processes. A fluid
// of one process has none.
#pragma once

#include "hyoryu/fluid/list_schedule.hpp"
#include "hyoryu/ranks/halo.hpp"
#include "hyoryu/ranks/reduction.hpp"

#include <optional>

namespace hyoryu {

struct Fluid;

/// The ghosts of one kind of particles.
struct GhostsOfKind {
    Halo halo;
    Links links; // of the ghosts that neighbour lists read; only these are updated in a step
    Tiles tiles;
    DisplacementSpace motion; // of their tiles, and which own tiles touch them
};

/// The particles of other ranks that this one may read.
struct Ghosts {
    Comm& comm;
    Cuts cuts;
    std::optional<Cuts> next_cuts; // from the next lists on; the same on all ranks
    GhostsOfKind fluid, wall, body;
    Particles particles; // row k is point k of the tiles of its kind
    real moved = 0;      // largest displacement of own particles when places were shared [m]
    std::vector<std::uint8_t> wet_body; // by point: whether fluid is near
    std::vector<Parcel> outbox, inbox;  // memory of messages
    Underway solids, velocities;        // at most one of them is begun at a time
    Index inner = 0; // number of blocks of fluid pairs without ghosts; they come first
};

/// Makes the fluid that of one rank. Its store must then have the fluid particles of its range of
/// tiles and no others.
void share(Fluid& fluid, Comm& comm, const Cuts& cuts);

/// Updates ghosts on other ranks with the positions and all other fields that a step reads before
/// new velocities are known. Nothing before the first lists.
void share_places(Fluid& fluid);

/// Sets every ghost value that a step sends again to not-a-number, so that reading a value that was
/// not sent shows in the results. Velocities hold until new ones are known, and places of walls
/// that do not move hold for good. Debug builds do so in every step.
void poison_ghosts(Ghosts& ghosts, const Fluid& fluid);

/// Gives all ranks the pressures and kernel sums of all body particles, as joints need them.
void replicate_body_pressures(Fluid& fluid);

/// The connection with the other ranks; null without ranks.
Comm* comm_of(const Fluid& fluid);
/// The numbers of tiles of this rank; all without ranks.
TileRange own_tiles(const Fluid& fluid);

/// The sum of a count over all ranks.
Index count_over_ranks(const Fluid& fluid, Index count);
/// The largest of a number over all ranks; not-a-number if any is.
real largest_of_all(const Fluid& fluid, real number);

} // namespace hyoryu
