// SPDX-License-Identifier: MIT
#include "packing_lists.hpp"

#include "near_points.hpp"

#include "hyoryu/core/parallel.hpp"

namespace hyoryu {

namespace {

constexpr Index block_rows = 256;

// Pairs side by side: as many whatever the machine.
using Lanes = Pack<double, 32>;

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

// Room to search in, kept from row to row.
struct Found {
    std::vector<float> squared; // distances of a run of points [m2]
    std::vector<std::int32_t> rows;
};

// The points within a distance of a place. Distances in single precision decide, which is as well:
// lists reach farther than the kernel.
void find(const CellGrid& grid, const Vec3& x, float distance, Found& found)
{
    const Eigen::Vector3f own = (x - grid.origin).cast<float>();
    std::size_t count = 0;
    for_runs_about(grid, x, [&](std::size_t begin, std::size_t end) {
        const std::size_t length = end - begin;
        found.squared.resize(std::max(found.squared.size(), length));
        found.rows.resize(std::max(found.rows.size(), count + length));
        for (std::size_t k = 0; k < length; ++k) {
            found.squared[k] = sq(grid.x[begin + k] - own.x()) + sq(grid.y[begin + k] - own.y()) +
                               sq(grid.z[begin + k] - own.z());
        }
        for (std::size_t k = 0; k < length; ++k) {
            found.rows[count] = grid.order[begin + k]; // the next one overwrites what is too far
            count += found.squared[k] < sq(distance) ? 1 : 0;
        }
    });
    found.rows.resize(count);
}

void add(std::span<const std::int32_t> rows, Index own, PackingLists::Block& block)
{
    const std::size_t first = block.entries.size();
    block.entries.insert(block.entries.end(), rows.begin(), rows.end());
    while (block.entries.size() % Lanes::lanes != 0) {
        block.entries.push_back(static_cast<std::int32_t>(own));
    }
    block.heads.push_back({first, block.entries.size()});
}

} // namespace

void make_lists(std::span<const Vec3> points, Index moving, double reach, PackingLists& lists)
{
    CellGrid grid;
    build(grid, points, 0, reach);
    const Index blocks = (moving + block_rows - 1) / block_rows;
    lists.blocks.resize(at(blocks));
    parallel_blocks(0, blocks, [&](Index b) {
        PackingLists::Block& block = lists.blocks[at(b)];
        block.entries.clear();
        block.heads.clear();
        Found found;
        const Index last = std::min((b + 1) * block_rows, moving);
        for (Index i = b * block_rows; i < last; ++i) {
            find(grid, points[at(i)], static_cast<float>(reach), found);
            add(found.rows, i, block);
        }
    });
}

Vec3 pressure_sum(const PackingLists& lists, std::span<const Vec3> points,
                  const PackingPressure& pressure, std::size_t i)
{
    const std::span depth = pressure.depth;
    const PackingLists::Block& block = lists.blocks[i / block_rows];
    const PackingLists::Head& head = block.heads[i % block_rows];
    const Vec3& x = points[i];
    const Lanes own = std::max(depth[i], 0.0);
    Vec<Lanes> sum;
    for (std::size_t k = head.first; k < head.last; k += Lanes::lanes) {
        Vec<Lanes> r;
        Lanes its;
        Lanes volume;
        for (int lane = 0; lane < Lanes::lanes; ++lane) {
            const auto j =
                static_cast<std::size_t>(block.entries[k + static_cast<std::size_t>(lane)]);
            const Vec3 way = x - points[j];
            r.x.value[lane] = way.x();
            r.y.value[lane] = way.y();
            r.z.value[lane] = way.z();
            const bool fluid = j < depth.size();
            its.value[lane] = fluid ? depth[j] : depth[i] - pressure.down.dot(way);
            volume.value[lane] = fluid ? 1 : pressure.solid;
        }
        sum += volume * (own + positive(its)) * pressure.kernel(r).f * r;
    }
    return {lane_sum(sum.x), lane_sum(sum.y), lane_sum(sum.z)};
}

} // namespace hyoryu
