// SPDX-License-Identifier: MIT
// Neighbour lists, held against all pairs that there are.
#include "hyoryu/core/neighbours.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

namespace hyoryu::test_neighbours {
namespace {

constexpr real radius = 0.1;

/// Half of the points lie anywhere in a cube and half in its corners, so that a tile sees
/// many and its points are near few of them.
std::vector<Vec3> points(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<real> at(0, 0.5);
    std::vector<Vec3> result;
    for (int k = 0; k < count; ++k) {
        const real x = at(random);
        const real y = at(random);
        const Vec3 point(x, y, at(random));
        result.push_back(
            k % 2 == 0 ? point : Vec3((point.array() / 0.25).floor() * 0.3 + point.array() / 10));
    }
    return result;
}

Tiles tiles_of(const std::vector<Vec3>& points, Index first_slot)
{
    const TileLattice lattice = make_lattice({-0.3, 0.1, 0}, 2 * radius);
    SortSpace space;
    const Vec3 far = Vec3::Constant(infinity);
    std::vector<std::int64_t> id(points.size());
    std::iota(id.begin(), id.end(), 0);
    Tiles tiles;
    make_tiles(tiles, lattice, points, space, sort_rows(lattice, {points, id}, -far, far, space));
    tiles.first_slot = first_slot;
    return tiles;
}

using Pairs = std::multiset<std::pair<Index, Index>>;

/// All pairs of slots that are no farther apart.
Pairs pairs_within(const Tiles& a, const std::vector<Vec3>& xa, const Tiles& b,
                   const std::vector<Vec3>& xb, real reach)
{
    Pairs pairs;
    for (Index i = 0; i < a.count(); ++i) {
        for (Index j = 0; j < b.count(); ++j) {
            const Vec3 r =
                xa[std::size_t(a.row[std::size_t(i)])] - xb[std::size_t(b.row[std::size_t(j)])];
            if (r.norm() <= reach) {
                pairs.emplace(a.first_slot + i, b.first_slot + j);
            }
        }
    }
    return pairs;
}

Pairs pairs_of(const PairList& list)
{
    Pairs pairs;
    list.for_each_pair([&](Index i, Index j) { pairs.emplace(i, j); });
    return pairs;
}

/// Entries between those of a list that are nothing.
int bridges(const PairList& list)
{
    int count = 0;
    for (const ListBlock& block : list.blocks()) {
        const std::uint8_t* entry = block.entry;
        for (Index k = 0; k < block.last - block.first; ++k) {
            int number = block.list[k].start;
            int nothing = 0;
            for (int lane = 0; lane < list.lanes() * block.list[k].packs; ++lane) {
                number += *entry++;
                const bool real_one = block.chunk[number / chunk_slots].count > 0;
                count += real_one ? nothing : 0;
                nothing = real_one ? 0 : nothing + 1;
            }
        }
    }
    return count;
}

TEST(PairList, HoldsEveryPairOnce)
{
    const std::vector<Vec3> fluid = points(1600, 1);
    const std::vector<Vec3> solid = points(1400, 2);
    const Tiles a = tiles_of(fluid, 0);
    const Tiles b = tiles_of(solid, a.count());
    const ListSource both[] = {&a, &b};
    Pairs expected = pairs_within(a, fluid, a, fluid, radius);
    expected.merge(pairs_within(a, fluid, b, solid, radius));
    ASSERT_GT(expected.size(), 100000U);
    for (const InstructionSet set :
         {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        for (const int lanes : {1, 2, 4, 8, 16}) {
            if (available(set)) {
                PairList list;
                list.build(a, both, {radius, lanes, set});
                EXPECT_EQ(pairs_of(list), expected) << name(set) << ", " << lanes << " lanes";
                EXPECT_EQ(list.entries() % lanes, 0);
                EXPECT_GT(bridges(list), 100) << "no list goes over what is nothing";
            }
        }
    }
}

TEST(PairList, LeavesOutTheOwnOwnerAndTheUnwanted)
{
    const std::vector<Vec3> solid = points(900, 3);
    const Tiles tiles = tiles_of(solid, 0);
    const ListSource sources[] = {&tiles};
    std::vector<std::int32_t> owner(solid.size());
    std::vector<std::uint8_t> wanted(solid.size());
    for (std::size_t k = 0; k < solid.size(); ++k) {
        owner[k] = static_cast<std::int32_t>(k % 3);
        wanted[k] = k % 5 != 0;
    }
    PairList list;
    list.build(tiles, sources, {radius, 8, widest_instruction_set()},
               {.owner = owner, .wanted = wanted});
    Pairs expected = pairs_within(tiles, solid, tiles, solid, radius);
    std::erase_if(expected, [&](const auto& pair) {
        const auto own = [&](Index slot) { return owner[std::size_t(slot)]; };
        return wanted[std::size_t(pair.first)] == 0 || own(pair.first) == own(pair.second);
    });
    EXPECT_EQ(pairs_of(list), expected);
}

TEST(PairList, OfPointsThatMeetNothingIsEmpty)
{
    const std::vector<Vec3> one{{0, 0, 0}};
    const std::vector<Vec3> other{{0.15, 0, 0}};
    const Tiles a = tiles_of(one, 0);
    const Tiles b = tiles_of(other, 1);
    const ListSource far[] = {&b};
    PairList list;
    list.build(a, far, {radius, 16, widest_instruction_set()});
    EXPECT_TRUE(list.empty());
    EXPECT_EQ(list.entries(), 0);
    const ListSource own[] = {&a};
    list.build(a, own, {radius, 16, widest_instruction_set()});
    EXPECT_EQ(pairs_of(list), (Pairs{{0, 0}}));
    EXPECT_EQ(list.entries(), 16);
}

// Steps of a byte that lead on where nothing is, whatever a block looks at.
TEST(PairList, EveryThirtyFirstChunkIsNothingAndTheLast)
{
    const std::vector<Vec3> fluid = points(3000, 4);
    const Tiles tiles = tiles_of(fluid, 0);
    const ListSource sources[] = {&tiles};
    PairList list;
    list.build(tiles, sources, {radius, 16, widest_instruction_set()});
    for (const ListBlock& block : list.blocks()) {
        for (std::int32_t chunk = 0; chunk < block.chunks; ++chunk) {
            const bool nothing = chunk % 31 == 30 || chunk + 1 == block.chunks;
            EXPECT_EQ(block.chunk[chunk].count == 0, nothing);
        }
    }
}

} // namespace
} // namespace hyoryu::test_neighbours
