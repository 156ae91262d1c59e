// SPDX-License-Identifier: MIT
// Lattices of particles whose forces are known: domains that repeat themselves, crowds.
#include "mixtures.hpp"

#include <gtest/gtest.h>

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

} // namespace
} // namespace hyoryu::test_lattices
