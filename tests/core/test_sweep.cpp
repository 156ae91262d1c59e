// SPDX-License-Identifier: MIT
// The fused sweep against hand-made numbers, its scalar reference, and the promise of the absent
// effect.
#include "hyoryu/core/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hyoryu {
namespace {

/// f = q_j - q_i along r, with a made-up field: the density.
struct Spring {
    static constexpr std::string_view name = "spring";
    using Reads = Fields<Density>;
    using Writes = Fields<Force>;
    template <class N>
    void operator()(const Pair<N>& ij, const auto& i, const auto& j, auto& sum) const
    {
        sum[field::force] += (i[field::density] + j[field::density]) * ij.f * ij.r;
    }
};

struct Count {
    static constexpr std::string_view name = "count";
    using Reads = Fields<>;
    using Writes = Fields<ShepardSum>;
    template <class N>
    void operator()(const Pair<N>& ij, const auto&, const auto&, auto& sum) const
    {
        sum[field::shepard_sum] += ij.w;
    }
};

struct Cloud {
    Particles particles;
    PairList pairs;
    Records<Fields<Position, Density>> records;
    Kernel kernel;
    CellGrid grid;

    explicit Cloud(const std::vector<Vec3>& points, real h, int dimensions)
        : kernel(make_kernel(h, h / 1.5, dimensions))
    {
        particles.allocate(Fields<Position, Density, Force, ShepardSum>{},
                           static_cast<Index>(points.size()), 0, 0);
        for (std::size_t k = 0; k < points.size(); ++k) {
            particles[field::position][k] = points[k];
            particles[field::density][k] = 1.0 + 0.1 * static_cast<real>(k % 7);
        }
        build(grid, particles[field::position], 0, kernel.support / 2);
        const CellGrid* const grids[] = {&grid};
        pairs.build(particles[field::position], particles.fluid(), grids, kernel.support);
        records.load(particles);
    }
};

std::vector<Vec3> random_points(int n, real edge)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<real> at(0, edge);
    std::vector<Vec3> points;
    for (int k = 0; k < n; ++k) {
        const real x = at(random);
        const real y = at(random);
        points.emplace_back(x, y, at(random));
    }
    return points;
}

TEST(Sweep, MatchesTheScalarReference)
{
    Cloud fast(random_points(900, 1.0), 0.1, 3);
    Cloud clear_ = Cloud(random_points(900, 1.0), 0.1, 3);
    sweep(fast.particles, fast.pairs, fast.records, fast.kernel, Spring{}, Count{});
    sweep_reference(clear_.particles, clear_.pairs, clear_.records, clear_.kernel, Spring{},
                    Count{});
    for (std::size_t k = 0; k < 900; ++k) {
        const Vec3 a = fast.particles[field::force][k];
        const Vec3 b = clear_.particles[field::force][k];
        // The sums differ only in their order: about a hundred roundings.
        EXPECT_NEAR((a - b).norm(), 0, 1e-12 * (1 + b.norm()));
        EXPECT_NEAR(fast.particles[field::shepard_sum][k], clear_.particles[field::shepard_sum][k],
                    1e-12 * clear_.particles[field::shepard_sum][k]);
    }
}

TEST(Sweep, FindsEveryPairThatBruteForceFinds)
{
    const auto points = random_points(300, 0.6);
    Cloud cloud(points, 0.08, 3);
    sweep(cloud.particles, cloud.pairs, cloud.records, cloud.kernel, Count{});
    for (std::size_t i = 0; i < points.size(); ++i) {
        real w = 0;
        for (const Vec3& p : points) {
            const Vec3 r = points[i] - p;
            w += cloud.kernel(Vec<real>{r.x(), r.y(), r.z()}).w;
        }
        EXPECT_NEAR(cloud.particles[field::shepard_sum][i], w, 1e-12 * w);
    }
}

TEST(Sweep, ActionEqualsReaction)
{
    Cloud two({{0, 0, 0}, {0.03, 0.05, 0.02}}, 0.1, 3);
    sweep(two.particles, two.pairs, two.records, two.kernel, Spring{});
    const Vec3 a = two.particles[field::force][0];
    const Vec3 b = two.particles[field::force][1];
    EXPECT_GT(a.norm(), 0);
    EXPECT_EQ(a, Vec3(-b)); // bit for bit: one pair, one expression
}

TEST(Sweep, AnAbsentTermChangesNoBit)
{
    Cloud with(random_points(500, 0.8), 0.1, 3);
    Cloud without(random_points(500, 0.8), 0.1, 3);
    sweep(with.particles, with.pairs, with.records, with.kernel, Off{}, Spring{}, Off{});
    sweep(without.particles, without.pairs, without.records, without.kernel, Spring{});
    for (std::size_t k = 0; k < 500; ++k) {
        EXPECT_EQ(with.particles[field::force][k], without.particles[field::force][k]);
    }
}

TEST(Sweep, TheSameBitsForAnyNumberOfThreads)
{
    std::vector<Vec3> first;
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        Cloud cloud(random_points(6000, 1.0), 0.06, 3);
        sweep(cloud.particles, cloud.pairs, cloud.records, cloud.kernel, Spring{}, Count{});
        const auto forces = cloud.particles[field::force];
        if (first.empty()) {
            first.assign(forces.begin(), forces.end());
        }
        EXPECT_TRUE(std::equal(first.begin(), first.end(), forces.begin()))
            << threads << " threads";
    }
    set_threads(0);
}

TEST(Kernel, IsOneAndLinearOnItsLattice)
{
    for (const int dimensions : {2, 3}) {
        const real dp = 0.1;
        const Kernel kernel = make_kernel(1.5 * dp, dp, dimensions);
        real one = 0;
        real moment = 0;
        const int reach_y = dimensions == 2 ? 0 : 4;
        for (int i = -4; i <= 4; ++i) {
            for (int j = -reach_y; j <= reach_y; ++j) {
                for (int k = -4; k <= 4; ++k) {
                    const auto pair = kernel(Vec<real>{i * dp, j * dp, k * dp});
                    one += pair.w * std::pow(dp, dimensions);
                    moment -= pair.f * sq(i * dp) * std::pow(dp, dimensions);
                }
            }
        }
        EXPECT_NEAR(one, 1, 1e-14);
        EXPECT_NEAR(moment, 1, 1e-14);
    }
}

TEST(Kernel, EndsAtItsSupportAndStaysFiniteFarAway)
{
    const Kernel kernel = make_kernel(0.15, 0.1, 3);
    EXPECT_EQ(kernel(Vec<real>{0.3, 0, 0}).f, 0);
    EXPECT_LT(kernel(Vec<real>{0.29, 0, 0}).f, 0);
    EXPECT_EQ(kernel(Vec<real>{1e30, 0, 0}).w, 0);
}

TEST(Kernel, FIsTheDerivativeOfWOverR)
{
    const Kernel kernel = make_kernel(0.15, 0.1, 3);
    const real r = 0.12;
    const real e = 1e-6;
    const real slope =
        (kernel(Vec<real>{r + e, 0, 0}).w - kernel(Vec<real>{r - e, 0, 0}).w) / (2 * e);
    // W and F are calibrated apart, by less than 1 % on this lattice (0.06 % and the sum of W).
    EXPECT_NEAR(kernel(Vec<real>{r, 0, 0}).f * r / slope, 1, 0.01);
}

} // namespace
} // namespace hyoryu
