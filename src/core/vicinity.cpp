// SPDX-License-Identifier: MIT
// Algorithm, tile by tile: the chunks of the other set about the tile are collected by their
// bounds, up to a fixed number at a time; each chunk of the tile tests those that its own bounds
// are near to, point against point, until all of its points are marked. The chunk that marked a
// point is tried first by the next.
#include "hyoryu/core/vicinity.hpp"

#include "chunk_boxes.hpp"
#include "hyoryu/core/parallel.hpp"

namespace hyoryu {

namespace {

// A chunk of the other set as the tile sees it.
struct OtherChunk {
    ChunkBox box;
    std::array<float, 3> step{}; // from its tile to the one that looks [m]
    Index first = 0, last = 0;
};

// The chunks of the other set that are tested together.
struct Batch {
    std::array<OtherChunk, 256> chunk;
    std::size_t count = 0;
};

class TileMarker {
public:
    TileMarker(const Tiles& points, const Tiles& others, std::span<const std::uint8_t> counted,
               real radius, std::span<std::uint8_t> marks)
        : points_(points), others_(others), counted_(counted), marks_(marks)
    {
        const auto edge = static_cast<float>(points.lattice.edge.maxCoeff());
        const float reach = static_cast<float>(radius) + rounding_of_positions * edge;
        squared_radius_ = reach * reach;
    }

    void mark(Index tile) const
    {
        ChunkBox bounds = points_.box[at(points_.chunk_start[at(tile)])];
        for (Index chunk = points_.chunk_start[at(tile)] + 1;
             chunk < points_.chunk_start[at(tile + 1)]; ++chunk) {
            bounds = joined(bounds, points_.box[at(chunk)]);
        }
        Batch batch;
        points_.lattice.for_beside(
            points_.tile[at(tile)], [&](std::uint64_t number, const std::array<int, 3>& way) {
                const Index other = others_.find(number);
                if (other >= 0) {
                    look_at_tile(tile, other, step_to(points_.lattice.edge, way), bounds, batch);
                }
            });
        look_at_batch(tile, batch);
    }

private:
    void look_at_tile(Index tile, Index other, const std::array<float, 3>& step,
                      const ChunkBox& bounds, Batch& batch) const
    {
        const Index end = others_.start[at(other + 1)];
        Index first = others_.start[at(other)];
        for (Index chunk = others_.chunk_start[at(other)]; first < end;
             ++chunk, first += chunk_slots) {
            const ChunkBox box = shifted(others_.box[at(chunk)], step);
            if (!is_near(box, bounds, squared_radius_)) {
                continue;
            }
            batch.chunk[batch.count++] = {box, step, first,
                                          std::min<Index>(first + chunk_slots, end)};
            if (batch.count == batch.chunk.size()) {
                look_at_batch(tile, batch);
            }
        }
    }

    void look_at_batch(Index tile, Batch& batch) const
    {
        std::size_t found_last = 0;
        const Index first_chunk = points_.chunk_start[at(tile)];
        for (Index chunk = first_chunk; chunk < points_.chunk_start[at(tile + 1)]; ++chunk) {
            const Index first = points_.start[at(tile)] + chunk_slots * (chunk - first_chunk);
            const Index last = std::min<Index>(first + chunk_slots, points_.start[at(tile + 1)]);
            Index left = std::count(marks_.begin() + first, marks_.begin() + last, 0);
            const std::size_t begin = found_last;
            for (std::size_t k = 0; k < batch.count && left > 0; ++k) {
                // The order is that of the batch, but for the chunk that found one last.
                const std::size_t other = k == 0 ? begin : k <= begin ? k - 1 : k;
                if (!is_near(points_.box[at(chunk)], batch.chunk[other].box, squared_radius_)) {
                    continue;
                }
                const Index found = mark_chunk(first, last, batch.chunk[other]);
                left -= found;
                found_last = found > 0 ? other : found_last;
            }
        }
        batch.count = 0;
    }

    // Marks the points of a chunk that are near a point of another; returns the number of new
    // marks.
    Index mark_chunk(Index first, Index last, const OtherChunk& other) const
    {
        Index found = 0;
        for (Index i = first; i < last; ++i) {
            if (marks_[at(i)] == 0 && any_near(i, other)) {
                marks_[at(i)] = 1;
                ++found;
            }
        }
        return found;
    }

    bool any_near(Index i, const OtherChunk& other) const
    {
        const float x = points_.x[at(i)] - other.step[0];
        const float y = points_.y[at(i)] - other.step[1];
        const float z = points_.z[at(i)] - other.step[2];
        for (Index j = other.first; j < other.last; ++j) {
            const float dx = others_.x[at(j)] - x;
            const float dy = others_.y[at(j)] - y;
            const float dz = others_.z[at(j)] - z;
            if (dx * dx + dy * dy + dz * dz <= squared_radius_ &&
                (counted_.empty() || counted_[at(j)] != 0)) {
                return true;
            }
        }
        return false;
    }

    const Tiles& points_;
    const Tiles& others_;
    std::span<const std::uint8_t> counted_;
    std::span<std::uint8_t> marks_;
    float squared_radius_ = 0;
};

} // namespace

void mark_near(const Tiles& points, const Tiles& others, std::span<const std::uint8_t> counted,
               real radius, std::span<std::uint8_t> marks)
{
    expects(marks.size() == at(points.count()));
    if (points.tiles() == 0 || others.tiles() == 0) {
        return;
    }
    expects(radius <= points.lattice.edge.minCoeff());
    const TileMarker marker(points, others, counted, radius, marks);
    parallel_blocks(0, points.tiles(), [&](Index tile) { marker.mark(tile); });
}

} // namespace hyoryu
