// SPDX-License-Identifier: MIT
// The pair terms: hand-made numbers, antisymmetry, the vector text against the scalar one.
#include "hyoryu/fluid/fluid.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hyoryu {
namespace {

using One = Record<Stored, real>;

One particle(real x, real vx, real V, real p)
{
    One record;
    record[field::position] = {x, 0, 0};
    record[field::velocity] = {vx, 0, 0};
    record[field::volume] = V;
    record[field::pressure] = p;
    return record;
}

// A pair with F = -2 at r = (0.5, 0, 0), so that every expected number can be had by hand.
const Pair<real> hand{{0.5, 0, 0}, 0.5, 0.25, 3.0, -2.0};

TEST(Terms, PressureForceByHand)
{
    Record<Fields<Force>, real> sum;
    PressureForce{}(hand, particle(0.5, 0, 2, 10), particle(0, 0, 3, 30), sum);
    EXPECT_DOUBLE_EQ(sum[field::force].x, 2 * 3 * 40 * 2 * 0.5);
    EXPECT_DOUBLE_EQ(sum[field::force].y, 0);
}

TEST(Terms, WallsDoNotPull)
{
    Record<Fields<Force>, real> sum;
    WallPressureForce{}(hand, particle(0.5, 0, 2, -10), particle(0, 0, 3, 0), sum);
    EXPECT_EQ(sum[field::force].x, 0);
    PressureForce{}(hand, particle(0.5, 0, 2, -10), particle(0, 0, 3, 0), sum);
    EXPECT_LT(sum[field::force].x, 0);
}

TEST(Terms, ContinuityByHand)
{
    Record<Fields<DensityRate>, real> sum;
    // Approach at 4 m/s: V_j v.r F = 3 * (-4 * 0.5) * (-2)
    Continuity{}(hand, particle(0.5, -4, 2, 0), particle(0, 0, 3, 0), sum);
    EXPECT_DOUBLE_EQ(sum[field::density_rate], 12);
}

TEST(Terms, ViscosityByHand)
{
    Record<Fields<ViscousForce>, real> sum;
    const Viscosity viscosity{1000, 0.5, 0}; // h = 0 switches the regularisation off
    viscosity(hand, particle(0.5, -4, 2, 0), particle(0, 0, 3, 0), sum);
    // V V rho0 kappa (v.r)/r^2 F r = 6 * 1000 * 0.5 * (-2/0.25) * (-2) * 0.5
    EXPECT_DOUBLE_EQ(sum[field::viscous_force].x, 24000);
}

TEST(Terms, HydrostaticPressureDoesNotDiffuse)
{
    EquationOfState eos{1000, 20};
    const Vec3 g{0, 0, -9.81};
    const DensityDiffusion fourtakas{1.0, eos, Vec3(eos.rho0 / sq(eos.c0) * g)};
    const Pair<real> upright{{0, 0, 0.1}, 0.1, 0.01, 3.0, -2.0}; // i above j
    One i = particle(0, 0, 1, 0);
    One j = particle(0, 0, 1, 1000 * 9.81 * 0.1);
    Record<Fields<DiffusionRate>, real> sum;
    fourtakas(upright, i, j, sum);
    EXPECT_NEAR(sum[field::diffusion_rate], 0, 1e-12);
    const DensityDiffusion molteni{1.0, eos, Vec3(Vec3::Zero())};
    molteni(upright, i, j, sum);
    EXPECT_GT(sum[field::diffusion_rate], 1); // it would lift the density of the upper particle
}

TEST(Terms, WallTakesTheHydrostaticPressureOfItsDepth)
{
    const EquationOfState eos{1000, 1e6}; // so stiff that rho = rho0
    const WallExtrapolation wall{eos, {0, 0, -9.81}};
    const Pair<real> below{
        {0, 0, -0.2}, 0.2, 0.04, 3.0, -2.0}; // wall particle 0.2 m under the fluid
    Record<WallExtrapolation::Writes, real> sum;
    wall(below, particle(0, 0, 1, 0), particle(0, 0, 1, 500), sum);
    EXPECT_DOUBLE_EQ(sum[field::shepard_sum], 3);
    EXPECT_NEAR(sum[field::pressure_sum] / sum[field::shepard_sum], 500 + 1000 * 9.81 * 0.2, 1e-6);
}

TEST(Terms, BackstopStopsOnlyWhatApproaches)
{
    const SolidBackstop stop{1.0, 1.0}; // spacing 1: the hand pair is at half a spacing, kappa = 1
    Record<Fields<Force>, real> sum;
    stop(hand, particle(0.5, 4, 1, 0), particle(0, 0, 1, 0), sum);
    EXPECT_EQ(sum[field::force].x, 0);
    stop(hand, particle(0.5, -4, 1, 0), particle(0, 0, 1, 0), sum);
    EXPECT_NEAR(sum[field::force].x, 4, 1e-9); // -1 * (-2)/0.25 * 0.5
    Record<Fields<Force>, real> far;
    stop(Pair<real>{{1.5, 0, 0}, 1.5, 2.25, 3, -2}, particle(1.5, -4, 1, 0), particle(0, 0, 1, 0),
         far);
    EXPECT_EQ(far[field::force].x, 0);
}

// Every term that ships: what i feels from j is the negative of what j feels from i, bit for bit,
// and a pack gives what its lanes give one by one.
template <class Term>
void expect_pairwise(const Term& term, auto written)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<real> at(-1, 1);
    const Kernel kernel = make_kernel(0.9, 0.6, 3);
    for (int k = 0; k < 50; ++k) {
        One a = particle(at(random), at(random), 1 + 0.1 * at(random), at(random));
        One b = particle(at(random), at(random), 1 + 0.1 * at(random), at(random));
        a[field::position].y = at(random);
        b[field::velocity].z = at(random);
        Record<typename Term::Writes, real> ab;
        Record<typename Term::Writes, real> ba;
        term(kernel(a[field::position] - b[field::position]), a, b, ab);
        term(kernel(b[field::position] - a[field::position]), b, a, ba);
        EXPECT_EQ(ab[written].x, -ba[written].x);
        EXPECT_EQ(ab[written].y, -ba[written].y);
        EXPECT_EQ(ab[written].z, -ba[written].z);
    }
}

TEST(Terms, ForcesAreAntisymmetricBitForBit)
{
    expect_pairwise(PressureForce{}, field::force);
    expect_pairwise(WallPressureForce{}, field::force);
    expect_pairwise(SolidBackstop{0.6, 2.0}, field::force);
    expect_pairwise(Viscosity{1000, 0.1, 0.9}, field::viscous_force);
}

TEST(Effects, AnAbsentEffectHasNoColumn)
{
    Fluid bare;
    allocate(bare, 4, 0, 0);
    EXPECT_FALSE(bare.particles.has(field::viscous_force));
    EXPECT_FALSE(bare.particles.has(field::diffusion_rate));
    EXPECT_FALSE(bare.particles.has(field::shepard_sum)); // no solids
    Fluid full;
    full.effects.diffusion = DensityDiffusion{};
    full.effects.viscosity = Viscosity{};
    allocate(full, 4, 2, 0);
    EXPECT_TRUE(full.particles.has(field::viscous_force));
    EXPECT_TRUE(full.particles.has(field::diffusion_rate));
    EXPECT_TRUE(full.particles.has(field::shepard_sum));
}

} // namespace
} // namespace hyoryu
