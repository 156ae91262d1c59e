// SPDX-License-Identifier: MIT
// Points sorted into cubic tiles along a Morton curve: a tile is a block of work, its points and
// those about it are few contiguous runs, and positions within it are short numbers.
#pragma once

#include "hyoryu/core/particles.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hyoryu {

/// Space cut into tiles, cubes unless a period asks for other edges, numbered along a Morton curve.
/// A tile has 4^3 cells along a Hilbert curve, by which its points are ordered.
///
/// Positions of pairs are relative to the centre of a tile and are multiples of a unit, a power of
/// two, so that they, their differences and the step from one tile to its neighbour are exact in
/// the number of the pair loops: r_ij = -r_ji bit for bit, whichever tile looks.
struct TileLattice {
    Vec3 origin{0, 0, 0}; // a corner of tiles [m]
    Vec3 edge{1, 1, 1};   // of a tile; multiples of the unit [m]
    /// Tiles after which space repeats itself, by axis, from the origin on; 0: never.
    std::array<std::int64_t, 3> period{0, 0, 0};

    /// Cells on an edge of a tile, and the farthest that a point may lie from the origin, in cells.
    static constexpr int cells = 4;
    static constexpr std::int64_t reach = std::int64_t(1) << 20;

    /// The number of the cell of a point; the tile is all but its last six bits.
    std::uint64_t cell_of(const Vec3& point) const;
    /// The number of the tile of a point, and of a cell.
    std::uint64_t tile_of(const Vec3& point) const;
    static std::uint64_t tile_of_cell(std::uint64_t cell);
    /// Tile indices along x, y, z of the number of a tile, and back.
    static std::array<std::int64_t, 3> place_of(std::uint64_t tile);
    static std::uint64_t tile_at(const std::array<std::int64_t, 3>& place);
    Vec3 centre(std::uint64_t tile) const;
    /// The number of the tile `way` tiles away from a place, wrapped around along axes with a
    /// period.
    std::uint64_t beside(const std::array<std::int64_t, 3>& place,
                         const std::array<int, 3>& way) const;
    /// Calls f(number, way) for the tile and the 26 about it, x fastest.
    void for_beside(std::uint64_t tile, const auto& f) const
    {
        const auto place = place_of(tile);
        for (int k = 0; k < 27; ++k) {
            const std::array<int, 3> way{k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
            f(beside(place, way), way);
        }
    }
    /// The image of a point that lies in the first period.
    Vec3 wrapped(const Vec3& point) const;
    /// The image of a point that is nearest to another; the point itself without periods.
    Vec3 image_near(const Vec3& point, const Vec3& other) const;
    /// Shortest vector between images of points r apart.
    Vec3 shortest(const Vec3& r) const;
    /// The unit of positions for numbers with the given count of binary digits [m].
    real unit(int digits) const;
};

/// The lattice of the least edge that is not below `edge` and a multiple of its units. Along an
/// axis with a period greater than 0 the period is a whole number of tiles, to the unit of single
/// precision; the period must not be shorter than `edge`.
TileLattice make_lattice(const Vec3& origin, real edge, const Vec3& period = Vec3(0, 0, 0));

/// Slots that are consecutive, near each other and tested together when lists are made.
inline constexpr int chunk_slots = 8;

/// Bounds of a chunk, relative to the centre of its tile [m].
struct ChunkBox {
    std::array<float, 3> low, high;
};

/// The points of one kind, sorted. A slot is a place in that order; kinds have their slots one
/// after the other.
struct Tiles {
    TileLattice lattice;
    Index first_slot = 0;
    std::vector<std::uint64_t> tile;          // numbers of the tiles that hold points, ascending
    std::vector<std::int32_t> start{0};       // first point of each tile; one entry more than tiles
    std::vector<std::int32_t> row;            // of each point
    std::vector<float> x, y, z;               // relative to the centre of the tile, when sorted [m]
    std::vector<std::int32_t> chunk_start{0}; // first chunk of each tile; one entry more
    std::vector<ChunkBox> box;                // of each chunk

    Index count() const { return static_cast<Index>(row.size()); }
    Index tiles() const { return static_cast<Index>(tile.size()); }
    /// Index of a tile by its number; -1 if it holds no points.
    Index find(std::uint64_t number) const;
};

/// Scratch memory of sorting, reused by later calls.
struct SortSpace {
    std::vector<std::uint64_t> key, key_swap;
    std::vector<std::int32_t> row, row_swap;
    std::vector<std::int32_t> histogram;
};

/// Positions [m] and numbers of points, by row; a number is held by one point only.
struct NumberedPoints {
    std::span<const Vec3> x;
    std::span<const std::int64_t> id;
};

/// Sorts rows by their cells, and within a cell by the numbers of the points, into `space.key` and
/// `space.row`: the order of the points follows from places and numbers, whatever the order of the
/// rows. Points outside [low, high] come last, in any order; returns how many are inside.
Index sort_rows(const TileLattice& lattice, const NumberedPoints& points, const Vec3& low,
                const Vec3& high, SortSpace& space);

/// Makes tiles of the first `count` sorted rows.
void make_tiles(Tiles& tiles, const TileLattice& lattice, std::span<const Vec3> x,
                const SortSpace& space, Index count);

/// The chunks and their bounds, from the positions that the tiles hold.
void bound_chunks(Tiles& tiles);

} // namespace hyoryu
