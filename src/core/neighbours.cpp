// SPDX-License-Identifier: MIT
#include "hyoryu/core/neighbours.hpp"

#include "hyoryu/core/vec.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Squared distances of one run of candidates, kept in cache.
struct Distances {
    std::vector<float> squared;
};

// Appends the rows of the run [begin, end) that are within the radius. Branch-free: every candidate is
// written and the end moves on if it is near.
std::int32_t* append_near(const CellGrid& grid, std::int32_t begin, std::int32_t end,
                          const std::array<float, 3>& p, float radius_squared,
                          Distances& distances, std::int32_t* out)
{
    const std::int32_t n = end - begin;
    if (static_cast<std::size_t>(n) > distances.squared.size()) {
        distances.squared.resize(static_cast<std::size_t>(n));
    }
    float* const squared = distances.squared.data();
    const float* const x = grid.x.data() + begin;
    const float* const y = grid.y.data() + begin;
    const float* const z = grid.z.data() + begin;
    for (std::int32_t k = 0; k < n; ++k) {
        squared[k] = sq(x[k] - p[0]) + sq(y[k] - p[1]) + sq(z[k] - p[2]);
    }
    const std::int32_t* const order = grid.order.data() + begin;
    for (std::int32_t k = 0; k < n; ++k) {
        *out = order[k];
        out += squared[k] <= radius_squared ? 1 : 0;
    }
    return out;
}

// Offset from a point to the nearest place of the cell [k, k + 1) x cell, along one axis.
float gap(Index k, real cell, real p)
{
    const real low = static_cast<real>(k) * cell;
    return static_cast<float>(p < low ? low - p : (p > low + cell ? p - low - cell : 0));
}

// Collects the rows near one point after another at the end of a vector.
struct Search {
    real radius;
    std::vector<std::int32_t>& found;
    std::size_t count = 0; // entries of `found` in use
    Distances distances;

    // Adds all rows of the grid within the radius of the point, in the order of the cells.
    void add_near(const CellGrid& grid, const Vec3& point);
    void add_run(const CellGrid& grid, Index row, Index lo, Index hi, const std::array<float, 3>& p);
};

void Search::add_near(const CellGrid& grid, const Vec3& point)
{
    const Vec3 p = point - grid.origin;
    const real reach = radius + grid.slack;
    std::array<Index, 3> lo{};
    std::array<Index, 3> hi{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        lo[a] = std::max<Index>(static_cast<Index>(std::floor((p[axis] - reach) / grid.cell)), 0);
        hi[a] = std::min<Index>(static_cast<Index>(std::floor((p[axis] + reach) / grid.cell)),
                                grid.count[a] - 1);
        if (lo[a] > hi[a]) {
            return;
        }
    }
    const std::array<float, 3> pf{static_cast<float>(p.x()), static_cast<float>(p.y()),
                                  static_cast<float>(p.z())};
    for (Index cz = lo[2]; cz <= hi[2]; ++cz) {
        for (Index cy = lo[1]; cy <= hi[1]; ++cy) {
            // Only the cells of this row that the sphere of the radius can touch.
            const float rest = static_cast<float>(sq(reach)) - sq(gap(cy, grid.cell, p.y())) -
                               sq(gap(cz, grid.cell, p.z()));
            if (rest <= 0) {
                continue;
            }
            const real half = std::sqrt(rest) + grid.slack;
            const auto left = static_cast<Index>(std::floor((p.x() - half) / grid.cell));
            const auto right = static_cast<Index>(std::floor((p.x() + half) / grid.cell));
            add_run(grid, grid.count[0] * (cy + grid.count[1] * cz), std::max(left, lo[0]),
                    std::min(right, hi[0]), pf);
        }
    }
}

void Search::add_run(const CellGrid& grid, Index row, Index lo, Index hi,
                     const std::array<float, 3>& p)
{
    if (lo > hi) {
        return;
    }
    const std::int32_t begin = grid.start[static_cast<std::size_t>(row + lo)];
    const std::int32_t end = grid.start[static_cast<std::size_t>(row + hi) + 1];
    const std::size_t needed = count + static_cast<std::size_t>(end - begin) + 1;
    if (needed > found.size()) {
        found.resize(2 * needed);
    }
    const float radius_squared = sq(static_cast<float>(radius) + grid.slack);
    const std::int32_t* const filled =
        append_near(grid, begin, end, p, radius_squared, distances, found.data() + count);
    count = static_cast<std::size_t>(filled - found.data());
}

} // namespace

void PairList::build(std::span<const Vec3> x, Rows destination,
                     std::span<const CellGrid* const> sources, real radius,
                     std::span<const std::int32_t> owner)
{
    rows_ = destination;
    const auto void_row = static_cast<std::int32_t>(x.size());
    const Index blocks = (destination.size() + block_rows - 1) / block_rows;
    blocks_.resize(static_cast<std::size_t>(blocks));
    parallel_blocks(0, blocks, [&](Index b) {
        Block& block = blocks_[static_cast<std::size_t>(b)];
        Search search{.radius = radius, .found = block.entries};
        const Index first = destination.begin + b * block_rows;
        const Index last = std::min(destination.end, first + block_rows);
        for (Index i = first; i < last; ++i) {
            const std::size_t begin = search.count;
            block.start[static_cast<std::size_t>(i - first)] = static_cast<std::int32_t>(begin);
            for (const CellGrid* source : sources) {
                search.add_near(*source, x[static_cast<std::size_t>(i)]);
            }
            if (!owner.empty()) {
                const std::int32_t own = owner[static_cast<std::size_t>(i)];
                const auto found = block.entries.begin();
                search.count = static_cast<std::size_t>(
                    std::remove_if(found + static_cast<Index>(begin),
                                   found + static_cast<Index>(search.count),
                                   [&](std::int32_t j) { return owner[static_cast<std::size_t>(j)] == own; }) -
                    found);
            }
            block.entries.resize(std::max(block.entries.size(), search.count + lanes));
            while (search.count % lanes != 0) {
                block.entries[search.count++] = void_row;
            }
        }
        std::fill(block.start.begin() + (last - first), block.start.end(),
                  static_cast<std::int32_t>(search.count));
    });
}

void PairList::clear()
{
    rows_ = {};
    blocks_.clear();
}

Index PairList::entries() const
{
    Index total = 0;
    for (const Block& block : blocks_) {
        total += block.start.back();
    }
    return total;
}

std::size_t PairList::bytes() const
{
    std::size_t total = blocks_.capacity() * sizeof(Block);
    for (const Block& block : blocks_) {
        total += block.entries.capacity() * sizeof(std::int32_t);
    }
    return total;
}

} // namespace hyoryu
