// SPDX-License-Identifier: MIT
// Which points are near others: against all pairs.
#include "../dice.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/core/vicinity.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace hyoryu::test_vicinity {
namespace {

/// Points by slot, and their tiles.
struct Cloud {
    std::vector<Vec3> x;
    Tiles tiles;
};

/// Clusters of points, so that many chunks are near one another, about the unit cube.
Cloud drawn(Dice& dice, const TileLattice& lattice, int count)
{
    std::vector<Vec3> x;
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < count; ++k) {
        const auto vector = [&](double low, double high) {
            const double a = dice.between(low, high);
            const double b = dice.between(low, high);
            return Vec3(a, b, dice.between(low, high));
        };
        middle = dice.chance(0.02) || k == 0 ? vector(0, 1) : middle;
        x.push_back(lattice.wrapped(middle + vector(-0.1, 0.1)));
    }
    std::vector<std::int64_t> id(x.size());
    std::iota(id.begin(), id.end(), 0);
    SortSpace space;
    const Vec3 far = Vec3::Constant(infinity);
    const Index all = sort_rows(lattice, {x, id}, -far, far, space);
    Cloud cloud;
    make_tiles(cloud.tiles, lattice, x, space, all);
    for (const std::int32_t row : cloud.tiles.row) {
        cloud.x.push_back(x[static_cast<std::size_t>(row)]);
    }
    return cloud;
}

/// The distance of a point to the nearest that counts.
double nearest(const Vec3& point, const Cloud& others, const std::vector<std::uint8_t>& counted,
               const TileLattice& lattice)
{
    double least = infinity;
    for (std::size_t k = 0; k < others.x.size(); ++k) {
        if (counted.empty() || counted[k] != 0) {
            least = std::min(least, lattice.shortest(point - others.x[k]).norm());
        }
    }
    return least;
}

TEST(Vicinity, MarksThePointsNearOthersAndNoMore)
{
    const int seed = number_from("HYORYU_SEED", 1);
    for (int k = 0; k < 200; ++k) {
        SCOPED_TRACE(seed + k);
        Dice dice(static_cast<std::uint64_t>(seed + k));
        const double edge = dice.between(0.15, 0.6);
        const Vec3 period = dice.chance(0.3) ? Vec3(1.3, 0, 0) : Vec3(0, 0, 0);
        const TileLattice lattice = make_lattice({-0.01, 0.02, 0}, edge, period);
        const double radius = lattice.edge.minCoeff() * dice.between(0.2, 1);
        const Cloud points = drawn(dice, lattice, 20 + dice.below(1500));
        const Cloud others = drawn(dice, lattice, 20 + dice.below(1500));
        std::vector<std::uint8_t> counted;
        const bool some = dice.chance(0.5);
        for (std::size_t m = 0; some && m < others.x.size(); ++m) {
            counted.push_back(dice.chance(0.5) ? 1 : 0);
        }
        std::vector<std::uint8_t> marks(points.x.size(), 0);
        set_threads(1 + dice.below(3));
        mark_near(points.tiles, others.tiles, counted, radius, marks);
        const double rounding = 1e-5 * lattice.edge.maxCoeff(); // of single precision
        for (std::size_t m = 0; m < points.x.size(); ++m) {
            const double distance = nearest(points.x[m], others, counted, lattice);
            if (std::abs(distance - radius) > rounding) {
                ASSERT_EQ(marks[m] != 0, distance < radius) << m << ", " << distance / radius;
            }
        }
    }
    set_threads(1);
}

} // namespace
} // namespace hyoryu::test_vicinity
