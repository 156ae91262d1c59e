// SPDX-License-Identifier: MIT
// Sums in fixed point: exact in any order, and never a silent wrong number.
#include "../dice.hpp"
#include "hyoryu/core/fixed_sum.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace hyoryu::test_fixed_sum {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Terms of either sign and of sizes over so many decades below a reference.
std::vector<double> terms(Dice& dice, int count, double reference, double decades)
{
    std::vector<double> terms;
    for (int k = 0; k < count; ++k) {
        const double size = reference * std::pow(10.0, dice.between(-decades, 3));
        terms.push_back(dice.chance(0.5) ? size : -size);
    }
    return terms;
}

void shuffle(Dice& dice, std::vector<double>& values)
{
    for (std::size_t k = values.size(); k-- > 1;) {
        std::swap(values[k], values[static_cast<std::size_t>(dice.below(static_cast<int>(k) + 1))]);
    }
}

/// The sum of terms dealt out at random to some partial sums.
double dealt_out(Dice& dice, const std::vector<double>& terms, const FixedUnit& unit)
{
    std::vector<FixedSum> parts(static_cast<std::size_t>(1 + dice.below(9)));
    for (const double term : terms) {
        parts[static_cast<std::size_t>(dice.below(static_cast<int>(parts.size())))].add(term, unit);
    }
    FixedSum all;
    for (const FixedSum& part : parts) {
        all.add(part);
    }
    return all.value(unit);
}

class FixedSumFamily : public testing::TestWithParam<int> {};

TEST_P(FixedSumFamily, HasTheSameBitsInAnyOrderAndIsTheSum)
{
    Dice dice(static_cast<std::uint64_t>(GetParam()));
    for (int draw = 0; draw < 20; ++draw) {
        const double reference = std::pow(10.0, dice.between(-30, 30));
        const FixedUnit unit = fixed_unit(reference);
        std::vector<double> values = terms(dice, 1 + dice.below(2000), reference, 12);
        const double all = dealt_out(dice, values, unit);
        long double expected = 0; // 64 digits of an x86, 53 elsewhere
        double size = 0;
        for (const double value : values) {
            expected += value;
            size += std::abs(value);
        }
        const double rounding = static_cast<double>(std::numeric_limits<long double>::epsilon()) *
                                static_cast<double>(values.size()) * size;
        const double cut_off = static_cast<double>(values.size()) * unit.size;
        EXPECT_NEAR(all, static_cast<double>(expected),
                    rounding + cut_off + std::abs(all) * std::numeric_limits<double>::epsilon());
        for (int k = 0; k < 5; ++k) {
            shuffle(dice, values);
            EXPECT_EQ(dealt_out(dice, values, unit), all);
        }
    }
}

TEST_P(FixedSumFamily, IsNotANumberWhereATermIsNotFiniteOrTooLarge)
{
    Dice dice(static_cast<std::uint64_t>(GetParam()));
    for (const double bad : {nan, infinity, -infinity, 1e9, -1e9, 1e300}) {
        const double reference = std::pow(2.0, dice.below(60) - 30);
        const FixedUnit unit = fixed_unit(reference);
        std::vector<double> values = terms(dice, 50, reference, 10);
        values.push_back(bad * reference);
        values.push_back(-bad * reference); // the sum would be in range again
        shuffle(dice, values);
        EXPECT_TRUE(std::isnan(dealt_out(dice, values, unit))) << bad;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FixedSumFamily, testing::Range(1, 6));

TEST(FixedSum, ManyOfTheLargestTermsStayInRange)
{
    const FixedUnit unit = fixed_unit(1);
    const double largest = std::nextafter(0x1p25, 0);
    FixedSum sum;
    sum.add(largest, unit);
    for (int k = 0; k < 30; ++k) { // 2^30 terms
        const FixedSum half = sum;
        sum.add(half);
    }
    EXPECT_EQ(sum.value(unit), std::ldexp(largest, 30));
    FixedSum more;
    more.add(0x1p25, unit);
    EXPECT_TRUE(std::isnan(more.value(unit)));
}

TEST(FixedSum, AReferenceThatIsNoScaleIsNoFault)
{
    for (const double reference : {0.0, -1.0, nan, infinity, 1e-320, 1e300}) {
        const FixedUnit unit = fixed_unit(reference);
        EXPECT_EQ(unit.size * unit.inverse, 1);
        FixedSum sum;
        sum.add(unit.size, unit);
        EXPECT_EQ(sum.value(unit), unit.size);
    }
}

/// Points in a box, sorted into tiles; `order` permutes their rows.
Tiles tiles_of(const std::vector<Vec3>& x, const std::vector<std::int64_t>& id, double edge)
{
    SortSpace space;
    const Vec3 far = Vec3::Constant(infinity);
    const TileLattice lattice = make_lattice(Vec3::Zero(), edge);
    Tiles tiles;
    make_tiles(tiles, lattice, x, space, sort_rows(lattice, {x, id}, -far, far, space));
    return tiles;
}

TEST_P(FixedSumFamily, OfTilesDependsNeitherOnRowsNorOnThreads)
{
    Dice dice(static_cast<std::uint64_t>(GetParam()));
    for (const double edge : {0.06, 0.3}) {
        constexpr int count = 20000;
        std::vector<Vec3> x;
        std::vector<std::int64_t> id(count);
        std::iota(id.begin(), id.end(), 0);
        for (int k = 0; k < count; ++k) {
            const double a = dice.between(0, 1);
            const double b = dice.between(0, 1);
            x.push_back({a, b, dice.between(0, 1)});
        }
        const FixedUnits<2> units{fixed_unit(1), fixed_unit(1e-3)};
        const auto total = [&] {
            const auto term = [&](Index i) {
                const Vec3& r = x[static_cast<std::size_t>(i)];
                return std::array{r.x() / 3, 1e-3 * r.y() * r.z()};
            };
            return sums_by_tile<2>(tiles_of(x, id, edge), units, term).values(units);
        };
        set_threads(1);
        const auto expected = total();
        for (std::size_t k = x.size(); k-- > 1;) {
            const auto other = static_cast<std::size_t>(dice.below(static_cast<int>(k) + 1));
            std::swap(x[k], x[other]);
            std::swap(id[k], id[other]);
        }
        for (const int threads : {1, 2, 3, 4}) {
            set_threads(threads);
            EXPECT_EQ(total(), expected) << threads << " threads";
        }
        long double plain = 0;
        for (const Vec3& r : x) {
            plain += static_cast<long double>(r.x()) / 3;
        }
        EXPECT_NEAR(expected[0], static_cast<double>(plain), 1e-12 * expected[0]);
    }
    set_threads(0);
}

} // namespace
} // namespace hyoryu::test_fixed_sum
