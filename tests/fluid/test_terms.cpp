// SPDX-License-Identifier: MIT
// The pair terms: hand-made numbers, antisymmetry, the vector text against the scalar one.
#include "hyoryu/fluid/fluid.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hyoryu::test_terms {
namespace {

using One =
    Record<Union<Stored,
                 Fields<TurbulentViscosity, PressureGradient, GradientCorrection, MixedCorrection>>,
           real>;

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

TEST(Terms, QuadraticViscosityActsOnApproachAlone)
{
    const Viscosity viscosity{1000, 0, 0, 3};
    Record<Fields<ViscousForce>, real> closing;
    viscosity(hand, particle(0.5, -4, 2, 0), particle(0, 0, 3, 0), closing);
    // V V rho0 beta (-v.r)(v.r)/r^2 F r = 6 * 1000 * 3 * 2 * (-2/0.25) * (-2) * 0.5
    EXPECT_DOUBLE_EQ(closing[field::viscous_force].x, 288000);
    Record<Fields<ViscousForce>, real> parting;
    viscosity(hand, particle(0.5, 4, 2, 0), particle(0, 0, 3, 0), parting);
    EXPECT_EQ(parting[field::viscous_force].x, 0);
}

TEST(Terms, QuadraticViscosityNeedsNoAlpha)
{
    const FluidParameters fluid{.eos = {1000, 30}, .spacing = 0.1, .h = 0.15};
    std::variant<Off, Viscosity> slot;
    ArtificialViscosity{0, 0}.fill(slot, fluid);
    EXPECT_TRUE(std::holds_alternative<Off>(slot));
    ArtificialViscosity{0, 3}.fill(slot, fluid);
    ASSERT_TRUE(std::holds_alternative<Viscosity>(slot));
    EXPECT_EQ(std::get<Viscosity>(slot).kappa, 0);
    EXPECT_EQ(std::get<Viscosity>(slot).beta, 3);
}

TEST(Terms, MorrisViscosityByHand)
{
    Record<Fields<ViscousForce>, real> sum;
    // V V 2 mu F dv = 6 * 2 * 0.5 * (-2) * (-4)
    MorrisViscosity{0.5}(hand, particle(0.5, -4, 2, 0), particle(0, 0, 3, 0), sum);
    EXPECT_DOUBLE_EQ(sum[field::viscous_force].x, 48);
}

// du/dz = z on a lattice: the force on a unit of volume is mu d2u/dz2, to the rounding of the
// calibration of the kernel.
TEST(Terms, MorrisViscosityIsExactOnALattice)
{
    constexpr real dp = 0.1;
    const Kernel kernel = make_kernel(1.5 * dp, dp, 3);
    const real V = dp * dp * dp;
    Record<Fields<ViscousForce>, real> sum;
    for (int k = 0; k < 7 * 7 * 7; ++k) {
        const Vec3 x = dp * Vec3(k % 7 - 3, k / 7 % 7 - 3, k / 49 - 3);
        One j = particle(x.x(), sq(x.z()) / 2, V, 0);
        MorrisViscosity{0.3}(kernel(Vec<real>{-x.x(), -x.y(), -x.z()}), particle(0, 0, V, 0), j,
                             sum);
    }
    EXPECT_NEAR(sum[field::viscous_force].x, 0.3 * V, 1e-12 * V);
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
    EXPECT_NEAR(sum[field::pressure] / sum[field::shepard_sum], 500 + 1000 * 9.81 * 0.2, 1e-6);
}

// A lattice of fluid in uniform shear over a wall: the velocity shown in the wall is the line.
TEST(Terms, MirroredVelocityContinuesAShear)
{
    constexpr real dp = 0.1;
    const Kernel kernel = make_kernel(1.5 * dp, dp, 3);
    const Vec3 u(0.3, -0.2, 0);
    const Vec3 shear(2, 1, 0); // dv/dz
    for (const real depth : {0.5 * dp, 1.5 * dp}) {
        Record<NoSlip::Writes, real> sum;
        One wall = particle(0, 0, 1, 0);
        wall[field::position].z = -depth;
        for (int k = 0; k < 7 * 7 * 3; ++k) {
            const Vec3 x = dp * Vec3(k % 7 - 3, k / 7 % 7 - 3, k / 49 + 0.5);
            const Vec3 v = u + x.z() * shear;
            One fluid = particle(x.x(), v.x(), 1, 0);
            fluid[field::position] = {x.x(), x.y(), x.z()};
            fluid[field::velocity] = {v.x(), v.y(), v.z()};
            NoSlip{}(kernel(wall[field::position] - fluid[field::position]), wall, fluid, sum);
        }
        const auto mean = [&](const Vec<real>& a) {
            return Vec3(Vec3(a.x, a.y, a.z) / sum[field::shepard_sum]);
        };
        const Vec3 v = mirrored_velocity(u, mean(sum[field::velocity_sum]),
                                         mean(sum[field::offset_sum]), depth, dp);
        EXPECT_LT((v - (u - depth * shear)).norm(), 1e-12) << depth;
    }
}

TEST(Terms, EddyViscosityByHand)
{
    // Pure shear du/dz = 3: E_xz = 3, |S| = sqrt(2 S:S) = 3.
    EXPECT_DOUBLE_EQ(eddy_viscosity(Vec3(0, 0, 0), Vec3(0, 3, 0), 0.1), 0.03);
    // Strain 2 along x, -2 along z: |S| = sqrt(2 (4 + 4)) = 4.
    EXPECT_DOUBLE_EQ(eddy_viscosity(Vec3(4, 0, -4), Vec3(0, 0, 0), 0.1), 0.04);
    Record<EddyViscosity::Writes, real> sum;
    const EddyViscosity eddies{1000, 0.4, 0, 5, 0.1};
    One i = particle(0.5, -4, 2, 0);
    One j = particle(0, 0, 3, 0);
    i[field::turbulent_viscosity] = 0.03;
    j[field::turbulent_viscosity] = 0.01;
    eddies(hand, i, j, sum);
    // kappa = 0.4 + 5 (0.03 + 0.01); the rest as for Viscosity above.
    EXPECT_DOUBLE_EQ(sum[field::viscous_force].x, 24000 * 0.6 / 0.5);
}

// With the exact gradient a linear pressure does not diffuse.
TEST(Terms, LinearPressureDoesNotDiffuseRenormalised)
{
    const RenormalisedDiffusion antuono{1.0, {1000, 20}};
    const Pair<real> apart{{0.1, 0, 0.2}, std::sqrt(0.05), 0.05, 3.0, -2.0};
    One i = particle(0.1, 0, 1, 100 + 7);
    One j = particle(0, 0, 1, 100);
    i[field::pressure_gradient] = j[field::pressure_gradient] = {70, 0, 0};
    Record<Fields<DiffusionRate>, real> sum;
    antuono(apart, i, j, sum);
    EXPECT_NEAR(sum[field::diffusion_rate], 0, 1e-12);
    j[field::pressure] = 90;
    antuono(apart, i, j, sum);
    EXPECT_LT(sum[field::diffusion_rate], 0);
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
        for (One* one : {&a, &b}) {
            (*one)[field::turbulent_viscosity] = sq(at(random));
            (*one)[field::gradient_correction] = {at(random), 0.1, at(random)};
            (*one)[field::mixed_correction] = {0.2, at(random), at(random)};
        }
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
    expect_pairwise(CorrectedGradient{}, field::force);
    expect_pairwise(WallPressureForce{}, field::force);
    expect_pairwise(SolidBackstop{0.6, 2.0}, field::force);
    expect_pairwise(Viscosity{1000, 0.1, 0.9}, field::viscous_force);
    expect_pairwise(Viscosity{1000, 0.1, 0.9, 3}, field::viscous_force);
    expect_pairwise(MorrisViscosity{0.7}, field::viscous_force);
    expect_pairwise(EddyViscosity{1000, 0.1, 0.9, 5, 0.1}, field::viscous_force);
}

TEST(Effects, AnAbsentEffectHasNoColumn)
{
    Fluid bare;
    allocate(bare, 4, 0, 0);
    EXPECT_FALSE(bare.particles.fluid.has(field::viscous_force));
    EXPECT_FALSE(bare.particles.fluid.has(field::diffusion_rate));
    EXPECT_FALSE(bare.particles.fluid.has(field::shepard_sum)); // no solids
    EXPECT_FALSE(bare.particles.fluid.has(field::strain));
    EXPECT_FALSE(bare.particles.fluid.has(field::moments));
    EXPECT_FALSE(bare.particles.fluid.has(field::depth));
    Fluid full;
    full.effects[slot::diffusion] = DensityDiffusion{};
    full.effects[slot::viscosity] = Viscosity{};
    allocate(full, 4, 2, 0);
    EXPECT_TRUE(full.particles.fluid.has(field::viscous_force));
    EXPECT_TRUE(full.particles.fluid.has(field::diffusion_rate));
    EXPECT_TRUE(full.particles.fluid.has(field::shepard_sum));
    EXPECT_FALSE(full.particles.fluid.has(field::strain));
    EXPECT_FALSE(full.particles.wall.has(field::velocity_sum));
    Fluid rare;
    rare.effects[slot::diffusion] = RenormalisedDiffusion{};
    rare.effects[slot::viscosity] = EddyViscosity{};
    rare.effects[slot::slip] = NoSlip{};
    allocate(rare, 4, 2, 0);
    EXPECT_TRUE(rare.particles.fluid.has(field::moments));
    EXPECT_TRUE(rare.particles.fluid.has(field::strain));
    EXPECT_TRUE(rare.particles.wall.has(field::velocity_sum));
    EXPECT_TRUE(rare.particles.wall.has(field::depth));
}

} // namespace
} // namespace hyoryu::test_terms
