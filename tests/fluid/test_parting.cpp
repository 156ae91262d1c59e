// SPDX-License-Identifier: MIT
// Fluid that parts from solids: what of a change of density goes to the gap.
#include "hyoryu/fluid/parting.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_parting {
namespace {

TEST(Parting, UnderPressureAllGoesToTheDensity)
{
    EXPECT_EQ(to_gap(0, -3, -5), 0) << "still 5 kg/m3 above rest";
    EXPECT_EQ(to_gap(0, 3, -5), 0);
    EXPECT_EQ(to_gap(0, 3, 5), 0) << "tension that the fluid itself made is not cut off";
}

TEST(Parting, AtRestDensityAGapOpensByWhatWouldStretch)
{
    EXPECT_EQ(to_gap(0, -3, 3), 3) << "from rest on, all of it";
    EXPECT_EQ(to_gap(0, -3, 1), 1) << "what the step took from the pressure stays taken";
    EXPECT_EQ(to_gap(0, -3, 7), 3) << "what the fluid stretched itself stays";
    EXPECT_EQ(to_gap(2, -3, -9), 3)
        << "with a gap it does not touch the solids, under pressure or not";
}

TEST(Parting, AGapClosesBeforeThereIsCompression)
{
    EXPECT_EQ(to_gap(2, 1.5, 0), -1.5);
    EXPECT_EQ(to_gap(2, 3, 0), -2) << "the rest compresses";
}

// There and back is nothing, however it is cut into steps: neither density nor gap drifts.
TEST(Parting, AWayOutAndBackLeavesNoTrace)
{
    real rho = 1004; // 4 above rest
    real gap = 0;
    const auto change = [&](real d) {
        rho += d;
        const real kept = to_gap(gap, d, 1000 - rho);
        gap += kept;
        rho += kept;
    };
    for (int k = 0; k < 16; ++k) {
        change(-0.75); // exact in binary
    }
    EXPECT_EQ(rho, 1000);
    EXPECT_EQ(gap, 8);
    for (int k = 0; k < 32; ++k) {
        change(0.375);
    }
    EXPECT_EQ(rho, 1004);
    EXPECT_EQ(gap, 0);
}

// W is scaled so that sum W V = 1 on the lattice: two halves and the row of the particle itself.
TEST(Parting, TheSumBesideAPlaneIsWhatTheRowLeavesOfOne)
{
    constexpr real dp = 0.1;
    for (const int dimensions : {2, 3}) {
        const Kernel kernel = make_kernel(1.5 * dp, dp, dimensions);
        real row = 0;
        for (int x = -3; x <= 3; ++x) {
            for (int y = dimensions == 3 ? -3 : 0; y <= (dimensions == 3 ? 3 : 0); ++y) {
                row += kernel(Vec<real>{x * dp, y * dp, 0}).w;
            }
        }
        const real V = std::pow(dp, dimensions);
        EXPECT_NEAR(V * (2 * sum_beside_plane(kernel, dp, dimensions) + row), 1, 1e-14);
    }
}

} // namespace
} // namespace hyoryu::test_parting
