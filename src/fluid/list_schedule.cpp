// SPDX-License-Identifier: MIT
// Bounds of displacements by tile, and the choice of the skin with the least cost per step.
#include "hyoryu/fluid/list_schedule.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

real longest(const DisplacementBox& a, const DisplacementBox& b)
{
    return (a.high - b.low).cwiseAbs().cwiseMax((a.low - b.high).cwiseAbs()).squaredNorm();
}

real larger(real a, real b)
{
    return std::max(a, b);
}

} // namespace

void find_touching(const Tiles& tiles, const Tiles& others, std::vector<TileTouch>& touch)
{
    touch.resize(tiles.tile.size());
    parallel_blocks(0, tiles.tiles(), [&](Index t) {
        std::size_t k = 0;
        tiles.lattice.for_beside(tiles.tile[at(t)], [&](std::uint64_t number, const auto&) {
            touch[at(t)][k++] = static_cast<std::int32_t>(others.find(number));
        });
    });
}

real bound_motion(const Tiles& tiles, std::span<const Vec3> x, std::vector<DisplacementBox>& box)
{
    box.resize(tiles.tile.size());
    const real squared = reduce(
        0, tiles.tiles(), real(0),
        [&](Index t) {
            const Vec3 centre = tiles.lattice.centre(tiles.tile[at(t)]);
            DisplacementBox bounds{Vec3::Constant(infinity), Vec3::Constant(-infinity)};
            real most = 0;
            for (Index k = tiles.start[at(t)]; k < tiles.start[at(t + 1)]; ++k) {
                const Vec3 then = centre + Vec3(tiles.x[at(k)], tiles.y[at(k)], tiles.z[at(k)]);
                const Vec3 way = x[at(tiles.row[at(k)])] - then;
                bounds.low = bounds.low.cwiseMin(way);
                bounds.high = bounds.high.cwiseMax(way);
                most = std::max(most, way.squaredNorm());
            }
            box[at(t)] = bounds;
            return most;
        },
        larger);
    return std::sqrt(squared);
}

real relative_motion(const std::vector<DisplacementBox>& boxes,
                     const std::vector<DisplacementBox>& others,
                     const std::vector<TileTouch>& touch)
{
    const real squared = reduce(
        0, static_cast<Index>(touch.size()), real(0),
        [&](Index t) {
            real most = 0;
            for (const std::int32_t other : touch[at(t)]) {
                if (other >= 0) {
                    most = std::max(most, longest(boxes[at(t)], others[at(other)]));
                }
            }
            return most;
        },
        larger);
    return std::sqrt(squared);
}

Skins first_skins(real spacing)
{
    return {0.1 * spacing, 0.2 * spacing};
}

Skins best_skins(const Displacement& motion, long long steps, const EntryCounts& entries,
                 const Skins& now, real support, real spacing)
{
    // Cost of making an entry relative to processing it (measured); a step processes the lists
    // twice.
    constexpr real making = 3;
    constexpr real sweeps = 2;
    constexpr int most_steps = 40;
    const real least_skin = 0.05 * spacing; // smaller skins would be exceeded by noise at once
    const real most_skin = 0.25 * support;
    const auto entries_with = [&](Index count, real skin_now, real skin) {
        const real ratio = (support + skin) / (support + skin_now);
        return static_cast<real>(count) * ratio * ratio * ratio;
    };
    const auto skins_for = [&](int k) {
        const real share = 1.02 * static_cast<real>(k) / static_cast<real>(steps);
        return Skins{std::clamp(share * motion.fluid, least_skin, most_skin),
                     std::clamp(share * motion.solid, least_skin, most_skin)};
    };
    Skins best = now;
    real least = infinity;
    for (int k = 1; k <= most_steps; ++k) {
        const Skins skins = skins_for(k);
        const real lists = entries_with(entries.fluid, now.fluid, skins.fluid) +
                           entries_with(entries.solid, now.solid, skins.solid);
        const real serve = std::min(skins.fluid / motion.fluid, skins.solid / motion.solid) *
                           static_cast<real>(steps);
        const real cost = lists * (sweeps + making / std::max(serve, real(1)));
        if (cost < least) {
            least = cost;
            best = skins;
        }
    }
    return best;
}

} // namespace hyoryu
