// SPDX-License-Identifier: MIT
#include "hyoryu/core/neighbours.hpp"

#include "hyoryu/core/vec.hpp"

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

struct Search {
    real radius;
    std::vector<std::int32_t> found;
    std::size_t count = 0;
    Distances distances;

    // Adds all rows of the grid within the radius of the point, in the order of the cells.
    void add_near(const CellGrid& grid, const Vec3& point);
};

void Search::add_near(const CellGrid& grid, const Vec3& point)
{
    const auto at = grid.cell_of(point);
    std::array<Index, 3> lo{};
    std::array<Index, 3> hi{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto reach = static_cast<Index>(std::ceil((radius + grid.slack) / grid.cell));
        lo[axis] = std::max<Index>(at[axis] - reach, 0);
        hi[axis] = std::min<Index>(at[axis] + reach, grid.count[axis] - 1);
        if (lo[axis] > hi[axis]) {
            return;
        }
    }
    const Vec3 p = point - grid.origin;
    const std::array<float, 3> pf{static_cast<float>(p.x()), static_cast<float>(p.y()),
                                  static_cast<float>(p.z())};
    const float radius_squared = sq(static_cast<float>(radius) + grid.slack);
    for (Index cz = lo[2]; cz <= hi[2]; ++cz) {
        for (Index cy = lo[1]; cy <= hi[1]; ++cy) {
            const Index row = grid.count[0] * (cy + grid.count[1] * cz);
            const std::int32_t begin = grid.start[static_cast<std::size_t>(row + lo[0])];
            const std::int32_t end = grid.start[static_cast<std::size_t>(row + hi[0]) + 1];
            const std::size_t needed = count + static_cast<std::size_t>(end - begin) + 1;
            if (needed > found.size()) {
                found.resize(2 * needed);
            }
            const std::int32_t* const filled = append_near(grid, begin, end, pf, radius_squared,
                                                           distances, found.data() + count);
            count = static_cast<std::size_t>(filled - found.data());
        }
    }
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
    parallel_for_uneven(0, blocks, [&](Index b) {
        Block& block = blocks_[static_cast<std::size_t>(b)];
        block.entries.clear();
        Search search{.radius = radius};
        const Index first = destination.begin + b * block_rows;
        const Index last = std::min(destination.end, first + block_rows);
        for (Index i = first; i < last; ++i) {
            block.start[static_cast<std::size_t>(i - first)] =
                static_cast<std::int32_t>(block.entries.size());
            search.count = 0;
            for (const CellGrid* source : sources) {
                search.add_near(*source, x[static_cast<std::size_t>(i)]);
            }
            for (const std::int32_t j : std::span(search.found).first(search.count)) {
                const bool self = j == i;
                const bool kin = !owner.empty() && owner[static_cast<std::size_t>(i)] ==
                                                       owner[static_cast<std::size_t>(j)];
                if (!self && !kin) {
                    block.entries.push_back(j);
                }
            }
            while (block.entries.size() % lanes != 0) {
                block.entries.push_back(void_row);
            }
        }
        const auto end = static_cast<std::int32_t>(block.entries.size());
        std::fill(block.start.begin() + (last - first), block.start.end(), end);
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
        total += static_cast<Index>(block.entries.size());
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
