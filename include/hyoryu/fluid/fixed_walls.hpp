// SPDX-License-Identifier: MIT
// Walls that do not move. A particle of theirs exists, with a row in the store of the walls, while
// a fluid particle, or a body particle that fluid is near, is within the reach of the neighbour
// lists. It is made from its surface when that comes and dropped when it leaves: walls away from
// fluid use no memory for positions, columns, records or lists. Which particles exist follows from
// the places of fluid and bodies when lists are made, not from the history.
#pragma once

#include "hyoryu/core/tiles.hpp"
#include "hyoryu/ranks/cuts.hpp"

#include <functional>

namespace hyoryu {

/// A wall particle as its surface makes it.
struct WallPoint {
    Vec3 place{0, 0, 0};     // [m]
    real depth = 0;          // behind the surface [m]; 0 where fluid slips
    real displaced_mass = 0; // see `DisplacedMass` [kg]
    std::int32_t owner = -1; // -1 - (index of the wall)
};

/// Makes the wall particle of an index, the same one each time. Several threads may call it at
/// once.
using WallMaker = std::function<WallPoint(std::int32_t index)>;

/// Indices [first, first + count).
struct IndexRun {
    std::int32_t first = 0;
    std::int32_t count = 0;
};

/// A particle of a tile, while its candidates are put in order.
struct WallCandidate {
    std::uint64_t cell = 0;
    std::int32_t index = 0;
    Vec3 place{0, 0, 0}; // [m]
};

struct FixedWalls {
    WallMaker make;
    std::int64_t first_number = 0; // of the particle of index 0; the others follow
    Index count = 0;               // of particles, whether they exist or not

    // The particles of each tile, as runs of indices.
    std::vector<std::uint64_t> tile;    // that have any, ascending
    std::vector<std::int32_t> start{0}; // first run of each tile; one entry more
    std::vector<IndexRun> run;

    Index moving_rows = 0; // of the store, before those of fixed walls: of walls that move

    // Candidates: the particles of the tiles that touch one with fluid or wet bodies, in the order
    // of cells and numbers. `candidates.row` holds their indices.
    std::vector<std::int32_t> near; // their tiles, as indices into `tile`, ascending
    Tiles candidates;
    std::vector<std::uint8_t> exists; // by candidate

    // Memory of `update_rows`, kept from one time to the next.
    std::vector<std::uint8_t> touched, marks;
    std::vector<std::int32_t> row_of, old_row;
    Tiles last_candidates;
    std::vector<std::vector<WallCandidate>> made; // by worker
};

/// Appends a run of particles of a tile, joined to the last run if it continues that. Tiles and, in
/// a tile, indices must come in ascending order; `start` gets its last entry from the caller.
void append_run(FixedWalls& walls, std::uint64_t tile, const IndexRun& run);

/// Notes which tile each of some particles is in, by index ascending; none exists yet.
void sort_into_tiles(FixedWalls& walls, const TileLattice& lattice,
                     std::span<const std::int32_t> index, std::span<const Vec3> place);

/// The points near which wall particles exist: fluid particles, or body particles near fluid.
struct Waters {
    const Tiles& tiles;
    std::span<const std::uint8_t> counted; // by point: whether it counts; empty: all do
};

/// Which wall particles exist: those in own tiles within `reach` of these points.
struct WallReach {
    real reach = 0; // [m]; at most the edge of a tile
    TileRange own;
};

/// Makes the particles that are within reach of waters and drops all others. Rows come in the order
/// of tiles, cells and numbers; those that stay keep their values, new ones are zero but for
/// position, number, owner, displaced mass and depth. Returns whether anything changed. `room` as
/// in Store::gather.
bool update_rows(FixedWalls& walls, std::span<const Waters> waters, const WallReach& which,
                 Store& store, std::span<std::byte> room);

/// The tiles of the particles that exist, for a store that has no others.
void make_tiles(const FixedWalls& walls, Tiles& tiles);

} // namespace hyoryu
