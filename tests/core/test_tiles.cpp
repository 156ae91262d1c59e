// SPDX-License-Identifier: MIT
// The order of points in tiles: a function of their places and numbers.
#include "../dice.hpp"
#include "hyoryu/core/tiles.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numeric>

namespace hyoryu::test_tiles {
namespace {

/// Points by number, with numbers that have gaps.
struct Points {
    std::vector<Vec3> x;
    std::vector<std::int64_t> id;
};

/// A third of the points share their places with others; some lie outside of the unit cube.
Points drawn(Dice& dice, int count)
{
    Points points;
    for (int k = 0; k < count; ++k) {
        const double x = dice.between(-0.1, 1.1);
        const double y = dice.between(-0.1, 1.1);
        const double z = dice.between(-0.1, 1.1);
        const bool again = k > 0 && dice.chance(1.0 / 3);
        const auto other = static_cast<std::size_t>(dice.below(std::max(k, 1)));
        points.x.push_back(again ? points.x[other] : Vec3(x, y, z));
        points.id.push_back(7 * k + dice.below(7));
    }
    return points;
}

Points shuffled(Dice& dice, Points points)
{
    for (std::size_t k = points.x.size(); k-- > 1;) {
        const auto other = static_cast<std::size_t>(dice.below(static_cast<int>(k) + 1));
        std::swap(points.x[k], points.x[other]);
        std::swap(points.id[k], points.id[other]);
    }
    return points;
}

/// The numbers of the points inside of the unit cube in the order of the tiles.
std::vector<std::int64_t> order_of(const Points& points, const TileLattice& lattice)
{
    SortSpace space;
    const Index count =
        sort_rows(lattice, {points.x, points.id}, Vec3::Zero(), Vec3::Ones(), space);
    Tiles tiles;
    make_tiles(tiles, lattice, points.x, space, count);
    std::vector<std::int64_t> order;
    for (const std::int32_t row : tiles.row) {
        order.push_back(points.id[static_cast<std::size_t>(row)]);
    }
    return order;
}

/// The same by an ordered map from cells and numbers.
std::vector<std::int64_t> clear_order(const Points& points, const TileLattice& lattice)
{
    std::map<std::pair<std::uint64_t, std::int64_t>, std::int64_t> sorted;
    for (std::size_t k = 0; k < points.x.size(); ++k) {
        const Vec3& x = points.x[k];
        if (x.minCoeff() >= 0 && x.maxCoeff() <= 1) {
            sorted[{lattice.cell_of(x), points.id[k]}] = points.id[k];
        }
    }
    std::vector<std::int64_t> order;
    for (const auto& [place, id] : sorted) {
        order.push_back(id);
    }
    return order;
}

TEST(Tiles, TheirOrderFollowsFromPlacesAndNumbers)
{
    const auto seed = static_cast<std::uint64_t>(number_from("HYORYU_SEED", 1));
    SCOPED_TRACE(seed);
    Dice dice(seed);
    for (const double edge : {0.03, 0.2, 4.0}) { // from few points in a cell to all in one or two
        for (const int count : {1, 40, 3000, 20000}) {
            const Points points = drawn(dice, count);
            const TileLattice lattice = make_lattice({-0.01, 0.02, 0}, edge);
            const auto expected = clear_order(points, lattice);
            for (const int threads : {1, 3}) {
                set_threads(threads);
                EXPECT_EQ(order_of(points, lattice), expected) << edge << ", " << count;
                EXPECT_EQ(order_of(shuffled(dice, points), lattice), expected)
                    << edge << ", " << count;
            }
        }
    }
    set_threads(0);
}

} // namespace
} // namespace hyoryu::test_tiles
