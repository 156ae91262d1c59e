// SPDX-License-Identifier: MIT
// The corrected pressure gradient: energy by its adjoint divergence, accuracy against an exact
// gradient, the loops against the terms one pair at a time.
#include "dice.hpp"
#include "hyoryu/fluid/corrected_wall.hpp"
#include "hyoryu/fluid/fluid.hpp"
#include "hyoryu/fluid/gradient.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace hyoryu::test_gradient {
namespace {

struct Cloud {
    int dimensions = 3;
    real spacing = 0.1;
    int edge = 9;
    real jitter = 0.2; // of a spacing
    Precision precision = Precision::double_precision;
    bool corrected = true;
    FormulationKind formulation = FormulationKind::sph;
};

// Fluid alone, on a jittered lattice, its density drawn at random.
Fluid make_fluid(const Cloud& cloud, Dice& dice)
{
    Fluid fluid;
    const real dp = cloud.spacing;
    FluidParameters& f = fluid.parameters;
    f = {.dimensions = cloud.dimensions, .eos = {1000, 30}, .spacing = dp, .h = 1.5 * dp};
    f.mass = 1000 * std::pow(dp, cloud.dimensions);
    f.precision = cloud.precision;
    f.formulation = cloud.formulation;
    fluid.kernel = make_kernel(f.h, dp, cloud.dimensions);
    fluid.mps_kernel = make_mps_kernel(2 * f.h, dp, cloud.dimensions);
    if (cloud.corrected) {
        fluid.effects[slot::gradient] = CorrectedGradient{};
    }
    const bool plane = cloud.dimensions == 2;
    const int layers = plane ? 1 : cloud.edge;
    allocate(fluid, Index(cloud.edge) * cloud.edge * layers, 0, 0);
    Store& store = fluid.particles.fluid;
    const auto off = [&](real most) {
        const real x = dice.between(-most, most);
        const real y = dice.between(-most, most);
        return Vec3(x, plane ? 0 : y, dice.between(-most, most));
    };
    for (Index k = 0; k < store.size(); ++k) {
        const Vec3 lattice(static_cast<real>(k % cloud.edge),
                           static_cast<real>(k / cloud.edge / cloud.edge),
                           static_cast<real>(k / cloud.edge % cloud.edge));
        store[field::position][k] = dp * (lattice + off(cloud.jitter));
        store[field::velocity][k] = off(0.5);
        store[field::density][k] = 1005 + dice.between(-10, 10);
    }
    return fluid;
}

// The corrections from the places, then forces and rates with them.
void evaluate(Fluid& fluid)
{
    update_neighbours(fluid);
    update_pressure(fluid);
    update_rates(fluid);
    update_pressure(fluid);
    update_forces(fluid, 1e-4);
}

TEST(CorrectedGradient, WorkOfThePressureIsTheChangeOfTheCompression)
{
    Dice dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 11)));
    for (const auto formulation : {FormulationKind::sph, FormulationKind::mps}) {
        for (const auto& [dimensions, spacing] :
             {std::pair{2, 0.1}, {2, 0.013}, {3, 0.1}, {3, 0.013}}) {
            Cloud cloud{dimensions, spacing, dimensions == 2 ? 25 : 9};
            cloud.formulation = formulation;
            Fluid fluid = make_fluid(cloud, dice);
            evaluate(fluid);
            const Store forces = fluid.particles.fluid;
            update_rates(fluid);
            const Store& p = fluid.particles.fluid;
            real work = 0;
            real compression = 0;
            real scale = 0;
            real corrections = 0;
            for (Index i = 0; i < p.size(); ++i) {
                const real of_force = forces[field::velocity][i].dot(forces[field::force][i]);
                work += of_force;
                scale += std::abs(of_force);
                compression += forces[field::pressure][i] * forces[field::volume][i] *
                               p[field::density_rate][i] / p[field::density][i];
                corrections = std::max(corrections, forces[field::gradient_correction][i].norm());
            }
            EXPECT_GT(corrections, 0.05); // else the test is of the plain gradient
            EXPECT_LT(std::abs(work + compression), 1e-12 * scale) << dimensions << " " << spacing;
        }
    }
}

// (F_i/V_i + grad p)/|grad p| of one particle, for a linear pressure that is zero at it.
Vec3 error_at(Index i, Fluid& fluid)
{
    const Vec3 slope(700, fluid.parameters.dimensions == 2 ? 0 : -300, 500); // [Pa/m]
    Store& store = fluid.particles.fluid;
    const Vec3 origin = store[field::position][i];
    for (Index k = 0; k < store.size(); ++k) {
        const Vec3 x = store[field::position][k];
        store[field::density][k] = fluid.parameters.eos.density(slope.dot(x - origin));
    }
    evaluate(fluid);
    return (store[field::force][i] / store[field::volume][i] + slope) / slope.norm();
}

// Whether the least eigenvalue of the moments asks for the whole correction.
bool is_inside(const Store& store, Index i)
{
    const Vec3& m = store[field::mixed_moments][i];
    Mat3 M = store[field::moments][i].asDiagonal();
    M(1, 2) = M(2, 1) = m[0];
    M(0, 2) = M(2, 0) = m[1];
    M(0, 1) = M(1, 0) = m[2];
    M(1, 1) = M(1, 1) == 0 ? 1 : M(1, 1); // in the plane
    return Eigen::SelfAdjointEigenSolver<Mat3>(M).eigenvalues().minCoeff() > 0.95;
}

// About a particle without pressure p_i B_j is nothing, and M_i^-1 makes a linear pressure exact:
// of the error of the plain gradient stays what is not corrected, a tenth in SPH and nothing in
// MPS.
TEST(CorrectedGradient, LeavesItsShareOfTheErrorForALinearPressureAboutAParticle)
{
    const auto seed = static_cast<std::uint64_t>(number_from("HYORYU_SEED", 12));
    for (const auto formulation : {FormulationKind::sph, FormulationKind::mps}) {
        const real stays = formulation == FormulationKind::sph ? 0.1 : 0;
        for (const auto& [dimensions, spacing] :
             {std::pair{2, 0.1}, {2, 0.025}, {3, 0.1}, {3, 0.025}}) {
            const Cloud cloud{.dimensions = dimensions,
                              .spacing = spacing,
                              .edge = dimensions == 2 ? 14 : 10,
                              .jitter = 0.06,
                              .formulation = formulation};
            Dice dice(seed);
            Dice same(seed);
            Fluid fluid = make_fluid(cloud, dice);
            Cloud uncorrected = cloud;
            uncorrected.corrected = false;
            Fluid plain = make_fluid(uncorrected, same);
            evaluate(fluid); // in the order of the tiles from here on
            evaluate(plain);
            int inside = 0;
            for (Index i = 0; i < fluid.particles.fluid.size() && inside < 5; ++i) {
                if (is_inside(fluid.particles.fluid, i)) {
                    ++inside;
                    const Vec3 of_plain = error_at(i, plain);
                    EXPECT_GT(of_plain.norm(), 1e-4) << dimensions << " " << spacing;
                    EXPECT_LT((error_at(i, fluid) - stays * of_plain).norm(), 1e-9)
                        << dimensions << " " << spacing;
                }
            }
            EXPECT_EQ(inside, 5);
        }
    }
}

// How much evens out a lattice in the plane whose columns are crowded in waves along x, at one
// density and pressure: the force by the way that a particle has to go [Pa/m per m].
real evening(bool corrected, real spacing, int seed)
{
    Dice dice(static_cast<std::uint64_t>(seed));
    const Cloud lattice{2, spacing, 100, 0, Precision::double_precision, corrected};
    Fluid fluid = make_fluid(lattice, dice);
    Store& store = fluid.particles.fluid;
    const real wave = 2 * std::numbers::pi_v<real> / (spacing * dice.between(40, 60));
    const real most = dice.between(0.02, 0.05) * spacing;
    for (Index k = 0; k < store.size(); ++k) {
        store[field::position][k].x() += most * std::sin(wave * store[field::position][k].x());
        store[field::density][k] = 1005;
    }
    evaluate(fluid);
    real along = 0;
    real square = 0;
    const real margin = 8 * spacing; // two supports from where the lattice ends
    for (Index k = 0; k < store.size(); ++k) {
        const Vec3 x = store[field::position][k];
        if (std::min(x.x(), x.z()) > margin && std::max(x.x(), x.z()) < 99 * spacing - margin) {
            const real way = -most * std::sin(wave * x.x());
            along += way * store[field::force][k].x() / store[field::volume][k];
            square += way * way;
        }
    }
    return along / square;
}

// Where the number density n of particles of one density varies over many spacings, M = n and the
// force is p sum V (B_i + B_j) F r: of (2 - part) grad n with B = 1 + part (1/n - 1), 2 of the
// plain.
TEST(CorrectedGradient, EvensOutTheParticlesByAsMuchAsItsPartLeaves)
{
    const int first = number_from("HYORYU_SEED", 14);
    for (int seed = first; seed < first + 4; ++seed) {
        for (const real spacing : {0.1, 0.013}) {
            const real plain = evening(false, spacing, seed);
            EXPECT_GT(plain, 0);
            // a wave of 40 spacings is short enough for 0.005 of it
            EXPECT_NEAR(evening(true, spacing, seed) / plain, (2 - 0.9) / 2, 0.01) << seed;
        }
    }
}

void expect_same(const Store& fast, const Store& clearly, auto column, real tolerance)
{
    const auto length = [](const auto& value) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Vec3>) {
            return value.norm();
        } else {
            return std::abs(value);
        }
    };
    real largest = 0;
    for (const auto& value : clearly[column]) {
        largest = std::max(largest, length(value));
    }
    ASSERT_GT(largest, 0) << column.info.name;
    for (Index k = 0; k < fast.size(); ++k) {
        const auto difference =
            std::remove_cvref_t<decltype(fast[column][k])>(fast[column][k] - clearly[column][k]);
        ASSERT_LE(length(difference), tolerance * largest) << column.info.name << " of row " << k;
    }
}

TEST(CorrectedGradient, LoopsEqualTheirReference)
{
    Dice dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 13)));
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        // Places in units of 1e-6 spacings, a hundred roundings; double has its own.
        const real tolerance = precision == Precision::single_precision ? 2e-5 : 1e-12;
        Fluid fluid = make_fluid({3, 0.013, 9, 0.2, precision}, dice);
        fluid.effects[slot::viscosity] = Off{};
        evaluate(fluid);
        fluid.parameters.gravity = {0, 0, -9.81};
        for (real& made : fluid.particles.fluid[field::correction]) {
            made = dice.between(-5, 5);
        }
        Store clearly = fluid.particles.fluid;
        const auto place = [&](Index slot) {
            return StoreRow{&clearly, fluid.neighbours.fluid.row[static_cast<std::size_t>(slot)]};
        };
        const auto sum = [&]<class Term>(const Term& term) {
            clear(clearly, typename Term::Writes{});
            sweep_reference<RecordList<Stored, Term>>(fluid.neighbours.fluid_fluid, place,
                                                      fluid.kernel, term);
        };
        sum(CorrectedGradient{});
        expect_same(fluid.particles.fluid, clearly, field::force, tolerance);
        update_rates(fluid);
        sum(CorrectedContinuity{});
        // What the correction has made relaxes in c0/g.
        const real relaxation = 9.81 / fluid.parameters.eos.c0;
        for (Index i = 0; i < clearly.size(); ++i) {
            real& rate = clearly[field::density_rate][i];
            real& made = clearly[field::correction_rate][i];
            made = clearly[field::density][i] * made - relaxation * clearly[field::correction][i];
            rate = clearly[field::density][i] * rate + made;
        }
        expect_same(fluid.particles.fluid, clearly, field::correction_rate, tolerance);
        expect_same(fluid.particles.fluid, clearly, field::density_rate, tolerance);
        sum(GradientMoments{});
        expect_same(fluid.particles.fluid, clearly, field::moments, tolerance);
        expect_same(fluid.particles.fluid, clearly, field::mixed_moments, tolerance);
    }
}

Eigen::Vector3d as_vector(const Vec<real>& v)
{
    return {v.x, v.y, v.z};
}

// -V V F (p_solid B + p_fluid) r, B of the fluid, where both are pressed; the opposite on the
// solid.
TEST(CorrectedGradient, PressesOnASolidByTheOppositeAndNeverPulls)
{
    using List = Union<Fields<Position>, CorrectedWallForce::Reads>;
    Dice dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 15)));
    const Kernel kernel = make_kernel(0.15, 0.1, 3);
    int pressed = 0;
    for (int k = 0; k < 500; ++k) {
        const auto vector = [&](real most) {
            const real a = dice.between(-most, most);
            const real b = dice.between(-most, most);
            return Vec<real>{a, b, dice.between(-most, most)};
        };
        Record<List, real> fluid;
        Record<List, real> solid;
        fluid[field::gradient_correction] = vector(0.2);
        fluid[field::mixed_correction] = vector(0.2);
        for (auto* row : {&fluid, &solid}) {
            (*row)[field::volume] = dice.between(0.0005, 0.002);
            (*row)[field::pressure] = dice.between(-500, 1500);
        }
        const Vec<real> r = vector(0.1);
        const Pair<real> ij = kernel(r);
        Record<CorrectedWallForce::Writes, real> on_fluid;
        Record<CorrectedWallForce::Writes, real> on_solid;
        CorrectedWallForce{}(ij, fluid, solid, on_fluid);
        CorrectedWallForce{}(kernel(Vec<real>{-r.x, -r.y, -r.z}), solid, fluid, on_solid);
        const Vec3 force = as_vector(on_fluid[field::force]);
        EXPECT_EQ(force, -as_vector(on_solid[field::force]));
        const real p_fluid = fluid[field::pressure];
        const real p_solid = solid[field::pressure];
        const Vec3 mixed = as_vector(fluid[field::mixed_correction]);
        Mat3 B = as_vector(fluid[field::gradient_correction]).asDiagonal();
        B(1, 2) = B(2, 1) = mixed[0];
        B(0, 2) = B(2, 0) = mixed[1];
        B(0, 1) = B(1, 0) = mixed[2];
        B += Mat3::Identity();
        const bool both = p_fluid > 0 && p_solid > 0;
        pressed += both ? 1 : 0;
        const real V = fluid[field::volume] * solid[field::volume];
        const Vec3 expected = -V * ij.f * (p_solid * B * as_vector(r) + p_fluid * as_vector(r));
        EXPECT_LE((force - (both ? expected : Vec3(Vec3::Zero()))).norm(), 1e-12 * expected.norm());
    }
    EXPECT_GT(pressed, 100);
}

TEST(CorrectedGradient, IsPlainAtASurfaceAndMadeInside)
{
    for (const CorrectionRange& range : {sph_correction, mps_correction}) {
        EXPECT_EQ(correction(Mat3::Identity(), range).norm(), 0);
        const Mat3 flat_surface = Vec3(1, 1, 0.499).asDiagonal();
        EXPECT_EQ(correction(flat_surface, range).norm(), 0);
        Mat3 inside = Vec3(1.1, 0.98, 1.05).asDiagonal();
        inside(0, 1) = inside(1, 0) = 0.01;
        const Mat3 whole = correction(inside, range) / range.part + Mat3::Identity();
        EXPECT_LT((whole * inside - Mat3::Identity()).norm(), 1e-14);
        // half of it halfway, by the least eigenvalue, wherever that points
        const real least = (range.surface + range.inside) / 2;
        const Mat3 turn = Eigen::AngleAxis<real>(0.7, Vec3(1, 2, 3).normalized()).matrix();
        const Mat3 between = turn * Vec3(1, least, 1.02).asDiagonal() * turn.transpose();
        const Mat3 half = correction(between, range) * (2 / range.part) + Mat3::Identity();
        EXPECT_LT((half * between - Mat3::Identity()).norm(), 1e-13);
    }
}

TEST(CorrectedGradient, AbsentHasNoColumnAndNoRecords)
{
    Dice dice(1);
    Fluid fluid = make_fluid({.corrected = false}, dice);
    evaluate(fluid);
    EXPECT_FALSE(fluid.particles.fluid.has(field::gradient_correction));
    EXPECT_FALSE(fluid.particles.fluid.has(field::moments));
    std::visit([](const auto& data) { EXPECT_EQ(data.wide.bytes(), 0U); }, fluid.pair_data);
}

} // namespace
} // namespace hyoryu::test_gradient
