// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/memory.hpp"

#include <numeric>

namespace hyoryu {

namespace {

template <class... T>
std::size_t held(const std::vector<T>&... columns)
{
    return (0 + ... + (columns.capacity() * sizeof(T)));
}

std::size_t held(const Tiles& t)
{
    return held(t.tile, t.start, t.row, t.x, t.y, t.z, t.chunk_start, t.box);
}

std::size_t held(const DisplacementSpace& space)
{
    return held(space.box, space.fluid, space.wall, space.body);
}

std::size_t held(const FixedWalls& w)
{
    std::size_t bytes = held(w.candidates) + held(w.last_candidates);
    for (const std::vector<WallCandidate>& of_worker : w.made) {
        bytes += held(of_worker);
    }
    return bytes +
           held(w.tile, w.start, w.run, w.near, w.exists, w.touched, w.marks, w.row_of, w.old_row);
}

template <class Real>
std::size_t held(const PairData<Real>& data)
{
    std::size_t bytes = data.common.bytes() + data.wide.bytes();
    for (const RecordMemory& local : data.local) {
        bytes += local.bytes();
    }
    return bytes;
}

} // namespace

std::vector<MemoryUse> memory_of(const Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const SortSpace& s = n.space;
    std::size_t lists = 0;
    for (const PairList* list : {&n.fluid_fluid, &n.fluid_solid, &n.wall_fluid, &n.body_fluid,
                                 &n.body_solid, &n.wall_body}) {
        lists += list->bytes();
    }
    return {{"columns", bytes_of(fluid.particles)},
            {"fixed walls", held(fluid.fixed_walls)},
            {"records", std::visit([](const auto& data) { return held(data); }, fluid.pair_data)},
            {"lists", lists},
            {"tiles", held(n.fluid) + held(n.wall) + held(n.body)},
            {"motion of tiles", held(n.fluid_motion) + held(n.wall_motion) + held(n.body_motion)},
            {"sorting", held(s.key, s.key_swap) + held(s.row, s.row_swap, s.histogram)},
            {"marks", held(n.met, n.wet_body) + held(n.wet_walls, n.owner)}};
}

std::size_t total(const std::vector<MemoryUse>& parts)
{
    return std::accumulate(parts.begin(), parts.end(), std::size_t(0),
                           [](std::size_t sum, const MemoryUse& use) { return sum + use.bytes; });
}

} // namespace hyoryu
