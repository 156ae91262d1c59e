// SPDX-License-Identifier: MIT
// Lattices of particles whose forces are known: domains that repeat themselves, crowds.
#include "mixtures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hyoryu::test_lattices {
namespace {

// A cube that repeats itself in every direction is everywhere inside: on its lattice nothing pulls,
// and a shift of all places by any way changes no sum beyond the rounding of places.
TEST(Periodic, ALatticeHasNoSides)
{
    for (const auto formulation : {FormulationKind::sph, FormulationKind::mps}) {
        Fluid fluid = make_mixture(
            {Precision::double_precision, widest_instruction_set(), false, false, formulation});
        constexpr int n = 10;
        allocate(fluid, n * n * n, 0, 0);
        fluid.domain_min = Vec3(0, 0, 0);
        fluid.domain_max = Vec3::Constant(n * dp);
        fluid.period = Vec3::Constant(n * dp);
        for (int k = 0; k < n * n * n; ++k) {
            fluid.particles.fluid[field::position][at(k)] =
                dp * (Vec3(k % n, k / n % n, k / n / n) + Vec3(0.4, 7.3, -3.2));
            fluid.particles.fluid[field::density][at(k)] = 1003;
        }
        update_neighbours(fluid);
        update_pressure(fluid);
        update_forces(fluid, 1e-4);
        EXPECT_EQ(fluid.particles.fluid.size(), n * n * n);
        const real scale = 2 * fluid.particles.fluid[field::pressure][0] * dp * dp;
        for (int k = 0; k < n * n * n; ++k) {
            // The period is that of the tiles, whole units of single precision: 1e-7 of it.
            EXPECT_LT(fluid.particles.fluid[field::force][at(k)].norm(), 1e-5 * scale) << k;
        }
    }
}

// A pair across a side: as far apart and as strong as anywhere else.
TEST(Periodic, APairAcrossASideIsAPair)
{
    Fluid fluid = make_mixture({Precision::double_precision, widest_instruction_set(), true, true});
    allocate(fluid, 2, 0, 0);
    fluid.domain_min = Vec3(0, 0, 0);
    fluid.domain_max = Vec3::Constant(3);
    fluid.period = Vec3(3, 0, 0);
    Vec3 across(0, 0, 0);
    for (const real middle : {1.5, 0.0}) {
        fluid.neighbours = {};
        fluid.particles.fluid[field::position][0] = {middle - 0.06, 1, 1};
        fluid.particles.fluid[field::position][1] = {middle + 0.05, 1.02, 1};
        fluid.particles.fluid[field::density][0] = 1003;
        fluid.particles.fluid[field::density][1] = 1005;
        update_neighbours(fluid);
        update_pressure(fluid);
        update_forces(fluid, 1e-4);
        const auto F = fluid.particles.fluid[field::force];
        ASSERT_GT(F[0].norm(), 0);
        ASSERT_EQ(F[0], Vec3(-F[1]));
        const Vec3 on_left = fluid.particles.fluid[field::density][0] == 1003 ? F[0] : F[1];
        if (middle == 1.5) {
            across = on_left;
        } else {
            EXPECT_LT((on_left - across).norm(), 1e-5 * across.norm());
        }
    }
}

// The sum of shifting points to where particles are dense, a shift goes the other way and at most
// 0.05 spacings, and a translating periodic lattice is left alone.
TEST(Shifting, LeavesALatticeAndEvensOutACrowd)
{
    Fluid fluid =
        make_mixture({Precision::double_precision, widest_instruction_set(), false, false});
    const Kernel& kernel = fluid.kernel;
    fluid.effects[slot::shifting] = Shifting{8, 1 / kernel(Vec<real>{dp, 0, 0}).w};
    constexpr int n = 10;
    allocate(fluid, n * n * n, 0, 0);
    fluid.domain_min = Vec3(0, 0, 0);
    fluid.domain_max = Vec3::Constant(n * dp);
    fluid.period = Vec3::Constant(n * dp);
    for (const bool crowd : {false, true}) {
        fluid.neighbours = {};
        for (int k = 0; k < n * n * n; ++k) {
            fluid.particles.fluid[field::position][at(k)] =
                dp * (Vec3(k % n, k / n % n, k / n / n) + Vec3(0.5, 0.5, 0.5));
            fluid.particles.fluid[field::velocity][at(k)] = {1, 0, 0};
            fluid.particles.fluid[field::density][at(k)] = 1000;
        }
        const Vec3 middle = dp * Vec3(5.5, 5.5, 5.5);
        const Vec3 away = crowd ? Vec3(0.3 * dp, 0, 0) : Vec3(0, 0, 0);
        fluid.particles.fluid[field::position][555] = middle + away;
        update_neighbours(fluid);
        update_pressure(fluid);
        const std::vector<Vec3> before(fluid.particles.fluid[field::position].begin(),
                                       fluid.particles.fluid[field::position].end());
        shift(fluid, 1e-3);
        for (Index k = 0; k < n * n * n; ++k) {
            const Vec3 way = fluid.particles.fluid[field::position][at(k)] - before[at(k)];
            if (!crowd) {
                EXPECT_LT(way.norm(), 1e-6 * dp) << k;
            } else if ((before[at(k)] - middle - away).norm() < 1e-9) {
                EXPECT_LT(way.x(), -1e-3 * dp);
                EXPECT_LE(way.norm(), 0.0501 * dp);
            }
        }
    }
}

// Wendland's C2 kernel in three dimensions.
real wendland(real distance, real h)
{
    const real q = distance / h;
    return q < 2 ? 21 / (16 * std::numbers::pi * h * h * h) * std::pow(1 - q / 2, 4) * (2 * q + 1)
                 : 0;
}

constexpr int across = 10; // particles along a side of a cube that repeats itself

// A jittered lattice that fills the cube, of which `layers` layers are wall.
Fluid make_cube(const FluidEffects& effects, int layers, real jitter)
{
    Fluid fluid =
        make_mixture({Precision::double_precision, widest_instruction_set(), false, false});
    fluid.effects = effects;
    const int walls = layers * across * across;
    const int all = across * across * across;
    allocate(fluid, all - walls, walls, 0);
    fluid.domain_min = Vec3(0, 0, 0);
    fluid.domain_max = Vec3::Constant(across * dp);
    fluid.period = Vec3::Constant(across * dp);
    std::ranges::fill(fluid.particles.wall.owner(), -1);
    std::mt19937 random(7);
    std::uniform_real_distribution<real> off(-jitter, jitter);
    for (int k = 0; k < all; ++k) {
        Store& store = k < walls ? fluid.particles.wall : fluid.particles.fluid;
        const int row = k < walls ? k : k - walls;
        const real jx = off(random) + 0.5;
        const real jy = off(random) + 0.5;
        store[field::position][row] =
            dp * (Vec3(k % across, k / across % across, k / across / across) +
                  Vec3(jx, jy, off(random) + 0.5));
        store[field::density][row] = 1003;
    }
    return fluid;
}

Shifting even_shifting()
{
    const Kernel kernel = make_kernel(1.5 * dp, dp, 3);
    return {8, 1 / kernel(Vec<real>{dp, 0, 0}).w};
}

// sum V_i V_j W over the pairs of fluid with fluid and walls.
real concentration(Fluid& fluid)
{
    const Particles& p = fluid.particles;
    const auto x = p.fluid[field::position];
    const auto V = p.fluid[field::volume];
    real sum = 0;
    for (const Store* others : {&p.fluid, &p.wall}) {
        const auto y = (*others)[field::position];
        const auto U = (*others)[field::volume];
        for (Index i = 0; i < p.fluid.size(); ++i) {
            for (Index j = 0; j < others->size(); ++j) {
                Vec3 r = x[i] - y[j];
                r -= across * dp * (r / (across * dp)).array().round().matrix();
                sum += V[i] * U[j] * wendland(r.norm(), fluid.parameters.h);
            }
        }
    }
    return sum;
}

// Conservative shifting lowers the concentration of the particles and, in total, what the densities
// have taken over and owe by as much: among fluid and between fluid and walls, against sums over
// all pairs. A shift of a thousandth of a spacing leaves a second order below a hundredth of the
// change. Without further shifts the densities take over what they owe, exp(-t/tau) of it less in a
// time t, tau = 100 h/c0; steps of tau/1000 follow that exponential to one in a thousand.
TEST(Shifting, LowersTheDensityAsMuchAsTheConcentration)
{
    for (const int layers : {0, 3}) {
        FluidEffects effects;
        effects[slot::shifting] = ConservativeShifting{even_shifting()};
        Fluid fluid = make_cube(effects, layers, 0.1);
        std::ranges::fill(fluid.particles.fluid[field::velocity], Vec3(0, 1, 0));
        update_neighbours(fluid);
        update_pressure(fluid);
        const auto V = fluid.particles.fluid[field::volume];
        const auto rho = fluid.particles.fluid[field::density];
        const auto owed = fluid.particles.fluid[field::owed_density];
        const std::vector<real> before(rho.begin(), rho.end());
        const real crowded = concentration(fluid);
        shift(fluid, 2e-4);
        real taken = 0;
        real left = 0;
        for (Index i = 0; i < fluid.particles.fluid.size(); ++i) {
            taken += V[i] * (rho[i] / before[at(i)] - 1);
            left += V[i] * owed[i] / before[at(i)];
        }
        const real expected = concentration(fluid) - crowded;
        EXPECT_LT(expected, 0);
        EXPECT_NEAR((taken + left) / expected, 1, 0.02) << layers;

        std::ranges::fill(fluid.particles.fluid[field::velocity], Vec3(0, 0, 0));
        const real owed_before = owed[7];
        const real sum = rho[7] + owed[7];
        const real tau = 100 * fluid.parameters.h / fluid.parameters.eos.c0;
        for (int step = 0; step < 1000; ++step) {
            shift(fluid, tau / 1000);
        }
        EXPECT_NEAR(owed[7] / owed_before, std::exp(-1), 1e-3);
        EXPECT_NEAR(rho[7] + owed[7], sum, 1e-9 * sum);
    }
}

// Neither column is there without the option.
TEST(Shifting, PlainShiftingHasNoColumnsOfTheConservativeOne)
{
    FluidEffects effects;
    effects[slot::shifting] = even_shifting();
    const Fluid fluid = make_cube(effects, 0, 0.1);
    EXPECT_FALSE(fluid.particles.fluid.has(field::concentration_gradient));
    EXPECT_FALSE(fluid.particles.fluid.has(field::owed_density));
}

} // namespace
} // namespace hyoryu::test_lattices
