// SPDX-License-Identifier: MIT
// The fused sweep against hand-made numbers, its scalar reference, and the promise of the absent
// effect.
#include "hyoryu/core/mps_kernel.hpp"
#include "hyoryu/core/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace hyoryu::test_sweep {
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

// Registers of the widest set that the tests were compiled for.
#if defined(__AVX2__)
constexpr int bytes = 32;
#else
constexpr int bytes = 16;
#endif
using In = Fields<Position, Density>;

template <class Real>
struct Cloud {
    Store particles{Kind::fluid};
    Tiles tiles;
    PairList pairs;
    RecordMemory memory;
    Kernel kernel;

    explicit Cloud(const std::vector<Vec3>& points, real h, int dimensions)
        : kernel(make_kernel(h, h / 1.5, dimensions))
    {
        particles.reset(static_cast<Index>(points.size()));
        particles.add(Fields<Position, Density, Force, ShepardSum>{});
        std::iota(particles.id().begin(), particles.id().end(), 0);
        for (std::size_t k = 0; k < points.size(); ++k) {
            particles[field::position][k] = points[k];
            particles[field::density][k] = 1.0 + 0.1 * static_cast<real>(k % 7);
        }
        const TileLattice lattice = make_lattice({-0.3, 0.1, 0}, 1.4 * kernel.support);
        SortSpace space;
        const Vec3 far = Vec3::Constant(infinity);
        const Index n =
            sort_rows(lattice, {particles[field::position], particles.id()}, -far, far, space);
        make_tiles(tiles, lattice, particles[field::position], space, n);
        const ListSource sources[] = {&tiles};
        pairs.build(tiles, sources,
                    {kernel.support, Pack<Real, bytes>::lanes, widest_instruction_set()});
        Records<In, Real>(memory, n).load(particles, tiles);
    }

    void sweep(const auto&... terms)
    {
        std::vector<std::vector<RecordRow<In, Real>>> local(
            static_cast<std::size_t>(thread_count()));
        for (auto& room : local) {
            room.resize(static_cast<std::size_t>(chunk_slots * pairs.most_chunks()));
        }
        const SweepView<Real> view{
            pairs.blocks().data(), memory.data(), particles.pointers(), tiles.row.data(), 0,
            tiles.lattice.edge,    kernel};
        parallel_blocks(0, static_cast<Index>(pairs.blocks().size()), [&](Index block) {
            sweep_block<bytes>(view, block, local[static_cast<std::size_t>(worker())].data(),
                               terms...);
        });
    }
    void sweep_clearly(const auto&... terms)
    {
        const auto place = [&](Index slot) {
            return StoreRow{&particles, tiles.row[static_cast<std::size_t>(slot)]};
        };
        sweep_reference<In>(pairs, place, kernel, terms...);
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

template <class Real>
class Sweep : public testing::Test {
};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Sweep, Reals);

// What positions and pair arithmetic lose: in single precision the unit of positions, 2^-24 of two
// edges of a tile of 1.4 supports, which changes W and F r of a pair near the middle of the support
// by ten times its share of the support. Sums of a hundred terms of both signs lose less than that.
template <class Real>
constexpr double loss = std::is_same_v<Real, float> ? 2e-6 : 1e-13;

TYPED_TEST(Sweep, MatchesTheScalarReference)
{
    const auto points = random_points(900, 1.0);
    Cloud<TypeParam> fast(points, 0.1, 3);
    Cloud<TypeParam> clear_(points, 0.1, 3);
    fast.sweep(Spring{}, Count{});
    clear_.sweep_clearly(Spring{}, Count{});
    // A force is compared with the sum of its parts, 60 neighbours with |F r| of up to 0.4 W / h.
    const real scale = 60 * 0.4 / 0.1 * fast.kernel.w_scale;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3 a = fast.particles[field::force][k];
        const Vec3 b = clear_.particles[field::force][k];
        EXPECT_NEAR((a - b).norm(), 0, loss<TypeParam> * scale);
        EXPECT_NEAR(fast.particles[field::shepard_sum][k], clear_.particles[field::shepard_sum][k],
                    10 * loss<TypeParam> * clear_.particles[field::shepard_sum][k]);
    }
}

TYPED_TEST(Sweep, FindsEveryPairThatBruteForceFinds)
{
    for (const int dimensions : {2, 3}) {
        auto points = random_points(300, 0.6);
        for (Vec3& p : points) {
            p.y() = dimensions == 2 ? 0 : p.y();
        }
        Cloud<TypeParam> cloud(points, 0.08, dimensions);
        cloud.sweep(Count{});
        for (std::size_t i = 0; i < points.size(); ++i) {
            real w = 0;
            for (const Vec3& p : points) {
                const Vec3 r = points[i] - p;
                w += cloud.kernel(Vec<real>{r.x(), r.y(), r.z()}).w;
            }
            EXPECT_NEAR(cloud.particles[field::shepard_sum][i], w, 10 * loss<TypeParam> * w);
        }
    }
}

// Points of a tile that are near few of the many that it looks at: lists go over what is nothing.
TYPED_TEST(Sweep, CountsNothingAsNothing)
{
    const auto points = random_points(4000, 0.5);
    Cloud<TypeParam> cloud(points, 0.05, 3);
    ASSERT_GT(cloud.pairs.most_chunks(), 128);
    cloud.sweep(Count{});
    for (std::size_t i = 0; i < points.size(); i += 7) {
        real w = 0;
        for (const Vec3& p : points) {
            const Vec3 r = points[i] - p;
            w += cloud.kernel(Vec<real>{r.x(), r.y(), r.z()}).w;
        }
        EXPECT_NEAR(cloud.particles[field::shepard_sum][i], w, 10 * loss<TypeParam> * w);
    }
}

TYPED_TEST(Sweep, ActionEqualsReaction)
{
    // Wherever the two lie, also in different tiles: the edge is 0.42.
    for (int k = 0; k < 50; ++k) {
        const Vec3 a(0.1 * k, 0.013 * k, -0.07 * k);
        Cloud<TypeParam> two({a, a + Vec3(0.03, 0.05, 0.02)}, 0.1, 3);
        two.sweep(Spring{});
        const Vec3 f = two.particles[field::force][0];
        const Vec3 g = two.particles[field::force][1];
        EXPECT_GT(f.norm(), 0);
        EXPECT_EQ(f, Vec3(-g)); // bit for bit: one pair, one expression, exact differences
    }
}

TYPED_TEST(Sweep, AnAbsentTermChangesNoBit)
{
    const auto points = random_points(500, 0.8);
    Cloud<TypeParam> with(points, 0.1, 3);
    Cloud<TypeParam> without(points, 0.1, 3);
    with.sweep(Off{}, Spring{}, Off{});
    without.sweep(Spring{});
    for (std::size_t k = 0; k < points.size(); ++k) {
        EXPECT_EQ(with.particles[field::force][k], without.particles[field::force][k]);
    }
}

TYPED_TEST(Sweep, TheSameBitsForAnyNumberOfThreads)
{
    std::vector<Vec3> first;
    for (const int threads : {1, 2, 3}) {
        set_threads(threads);
        Cloud<TypeParam> cloud(random_points(6000, 1.0), 0.06, 3);
        cloud.sweep(Spring{}, Count{});
        const auto forces = cloud.particles[field::force];
        if (first.empty()) {
            first.assign(forces.begin(), forces.end());
        }
        EXPECT_TRUE(std::equal(first.begin(), first.end(), forces.begin()))
            << threads << " threads";
    }
    set_threads(0);
}

// So many points in one place that 16 bits cannot number those that a tile looks at.
TEST(PairList, SplitsTilesThatSeeTooMuch)
{
    auto points = random_points(1200, 0.01);
    Cloud<float> crowd(points, 0.1, 3);
    const auto more = random_points(70000, 0.4);
    points.insert(points.end(), more.begin(), more.end());
    Cloud<float> crowded(points, 0.01, 3);
    EXPECT_EQ(crowd.pairs.blocks().size(), 1u);
    Index pairs = 0;
    crowd.pairs.for_each_pair([&](Index, Index) { ++pairs; });
    EXPECT_EQ(pairs, 1200 * 1200);
}

TEST(MpsKernel, IsOneAndLinearOnItsLattice)
{
    for (const int dimensions : {2, 3}) {
        const real dp = 0.1;
        const MpsKernel kernel = make_mps_kernel(3 * dp, dp, dimensions);
        const real cell = std::pow(dp, dimensions);
        real one = 0;
        real moment = 0;
        const int reach_y = dimensions == 2 ? 0 : 4;
        for (int i = -4; i <= 4; ++i) {
            for (int j = -reach_y; j <= reach_y; ++j) {
                for (int k = -4; k <= 4; ++k) {
                    const auto pair = kernel(Vec<real>{i * dp, j * dp, k * dp});
                    one += i != 0 || j != 0 || k != 0 ? pair.w * cell : 0;
                    moment -= pair.f * sq(k * dp) * cell;
                }
            }
        }
        EXPECT_NEAR(one, 1, 1e-14);
        EXPECT_NEAR(moment, 1, 1e-14);
    }
}

TEST(MpsKernel, HasTheShapeOfTheWeight)
{
    const real dp = 0.1;
    const MpsKernel kernel = make_mps_kernel(3 * dp, dp, 3);
    const auto w = [&](real r) { return (3 * dp - r) / std::hypot(r, dp / 2); };
    const auto near = kernel(Vec<real>{dp, 0, 0});
    const auto far = kernel(Vec<real>{2 * dp, 0, 0});
    EXPECT_NEAR(near.w / far.w, w(dp) / w(2 * dp), 1e-12);
    // F is the weight over r^2 + (dp/2)^2.
    EXPECT_NEAR(near.f / far.f * far.w / near.w, 4.25 / 1.25, 1e-12);
    EXPECT_LT(near.f, 0);
    EXPECT_EQ(kernel(Vec<real>{0.31, 0, 0}).f, 0);
    EXPECT_EQ(kernel(Vec<real>{1e30, 0, 0}).w, 0);
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
} // namespace hyoryu::test_sweep
