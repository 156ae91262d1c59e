// SPDX-License-Identifier: MIT
// Orders, floors and limits from points that are known.
#include "hyoryu/assess/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hyoryu::test_fit {
namespace {

// Round-off of logarithms of order one.
constexpr double round_off = 1e-12;

std::vector<double> law(const std::vector<double>& x, double factor, double exponent, double floor)
{
    std::vector<double> y;
    for (const double v : x) {
        y.push_back(factor * std::pow(v, exponent) + floor);
    }
    return y;
}

TEST(Power, IsThatOfAnExactLawAndLeavesNoDoubt)
{
    const std::vector<double> x{0.1, 0.05, 0.02, 0.01};
    const auto fit = fit_power(x, law(x, 3, 2, 0));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->exponent, 2, round_off);
    EXPECT_NEAR(fit->low, 2, 1e-10);
    EXPECT_NEAR(fit->high, 2, 1e-10);
    EXPECT_EQ(fit->points, 4);
}

TEST(Power, OfTwoPointsHasNoInterval)
{
    const auto fit = fit_power(std::vector{1.0, 2.0}, std::vector{8.0, 1.0});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->exponent, -3, round_off);
    EXPECT_TRUE(std::isnan(fit->low) && std::isnan(fit->high));
}

TEST(Power, IntervalOfThreePointsByHand)
{
    // In logarithms to the base 10: (0, 0), (1, 1), (2, 1). Slope 1/2, offset 1/6, residuals -1/6,
    // 1/3, -1/6, their squares 1/6; deviation of the slope sqrt(1/6/1/2) = 0.288675; t = 12.706.
    const auto fit = fit_power(std::vector{1.0, 10.0, 100.0}, std::vector{1.0, 10.0, 10.0});
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->exponent, 0.5, round_off);
    EXPECT_NEAR(fit->high - fit->exponent, 12.706 * 0.2886751345948129, 1e-10);
    EXPECT_NEAR(fit->exponent - fit->low, 12.706 * 0.2886751345948129, 1e-10);
}

TEST(Power, LeavesOutWhatHasNoLogarithm)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto fit = fit_power(std::vector{1.0, 2.0, 3.0, 4.0}, std::vector{1.0, 4.0, nan, 0.0});
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->points, 2);
    EXPECT_NEAR(fit->exponent, 2, round_off);
    EXPECT_FALSE(fit_power(std::vector{1.0, 1.0}, std::vector{1.0, 2.0}));
    EXPECT_FALSE(fit_power(std::vector{1.0}, std::vector{1.0}));
}

TEST(Power, IntervalHoldsTheTruthAsOftenAsItSays)
{
    // 2000 fits with normal noise: the share within is 0.95 with a deviation of 0.005, so that
    // 0.93 to 0.97 is four of them.
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.2);
    const std::vector<double> x{0.16, 0.08, 0.04, 0.02, 0.01};
    int held = 0;
    constexpr int tries = 2000;
    for (int k = 0; k < tries; ++k) {
        std::vector<double> y = law(x, 1, 2, 0);
        for (double& v : y) {
            v *= std::exp(noise(random));
        }
        const auto fit = fit_power(x, y);
        ASSERT_TRUE(fit);
        held += fit->low <= 2 && 2 <= fit->high ? 1 : 0;
    }
    EXPECT_GT(held, 0.93 * tries);
    EXPECT_LT(held, 0.97 * tries);
}

TEST(PowerWithFloor, FindsOrderAndFloorOfAnExactLaw)
{
    const std::vector<double> x{0.16, 0.08, 0.04, 0.02, 0.01};
    const auto fit = fit_power_with_floor(x, law(x, 4, 2, 0.003));
    ASSERT_TRUE(fit);
    // Floors are tried in steps of 1/400 of the smallest value, 3.4e-3.
    EXPECT_NEAR(fit->floor, 0.003, 1e-5);
    EXPECT_NEAR(fit->exponent, 2, 0.01);
    EXPECT_NEAR(fit->factor, 4, 0.1);
    EXPECT_LT(fit->misfit, 1e-3);
}

TEST(PowerWithFloor, IsZeroForALawWithoutOne)
{
    const std::vector<double> x{8, 4, 2, 1};
    const auto fit = fit_power_with_floor(x, law(x, 0.5, 1, 0));
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->floor, 0);
    EXPECT_NEAR(fit->exponent, 1, round_off);
}

TEST(PowerWithFloor, NeedsMorePointsThanUnknowns)
{
    const std::vector<double> x{4, 2, 1};
    EXPECT_FALSE(fit_power_with_floor(x, law(x, 1, 1, 0)));
}

TEST(Richardson, FindsLimitAndOrderWhateverTheRatios)
{
    const std::array<double, 3> h{0.01, 0.015, 0.04};
    std::array<double, 3> f{};
    for (std::size_t k = 0; k < 3; ++k) {
        f[k] = 2 - 7 * std::pow(h[k], 1.7);
    }
    const auto found = extrapolate(h, f);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->order, 1.7, 1e-9);
    EXPECT_NEAR(found->limit, 2, 1e-9);
    // 1.25 times the distance from the limit, relative to the finest value.
    EXPECT_NEAR(found->gci, 1.25 * (2 - f[0]) / f[0], 1e-9);
}

TEST(Richardson, AgreesWithTheTableOfItsSource)
{
    // Celik et al. (2008), table 1: N = 18000, 8000, 4500 cells, so r21 = 1.5, r32 = 1.333;
    // phi = 6.063, 5.972, 5.863 gives p = 1.53, limit 6.1685, GCI 2.2 %.
    const auto found = extrapolate({1.0, 1.5, 1.5 * 1.333}, {6.063, 5.972, 5.863});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->order, 1.53, 0.01);
    EXPECT_NEAR(found->limit, 6.1685, 5e-4);
    EXPECT_NEAR(found->gci, 0.022, 5e-4);
}

TEST(Richardson, GivesNoneForValuesThatDoNotConverge)
{
    EXPECT_FALSE(extrapolate({1, 2, 4}, {1.0, 1.1, 1.05})) << "oscillates";
    EXPECT_FALSE(extrapolate({1, 2, 4}, {1.0, 1.4, 1.5})) << "diverges";
    EXPECT_FALSE(extrapolate({1, 2, 4}, {1.0, 1.0, 1.0})) << "does not change";
    EXPECT_FALSE(extrapolate({2, 2, 4}, {1.0, 1.1, 1.3})) << "two grids are the same";
}

TEST(Median, IsTheMiddle)
{
    EXPECT_EQ(median(std::vector{3.0, 1.0, 2.0}), 2);
    EXPECT_EQ(median(std::vector{4.0, 1.0, 3.0, 2.0}), 2.5);
    EXPECT_TRUE(std::isnan(median({})));
}

} // namespace
} // namespace hyoryu::test_fit
