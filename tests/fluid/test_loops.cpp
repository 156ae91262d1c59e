// SPDX-License-Identifier: MIT
// The fused loops of every stage, in both precisions and for every instruction set at hand, against
// the same terms one pair at a time in double.
#include "hyoryu/core/parallel.hpp"
#include "mixtures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hyoryu {
namespace {

// Adds up what the terms of a stage write, over one list.
void sweep_clearly(Particles& particles, const Fluid& fluid, const PairList& pairs,
                   const auto&... terms)
{
    const FluidNeighbours& n = fluid.neighbours;
    const auto row = [&](Index slot) {
        const Tiles& tiles = slot < n.wall.first_slot   ? n.fluid
                             : slot < n.body.first_slot ? n.wall
                                                        : n.body;
        return Index(tiles.row[at(slot - tiles.first_slot)]);
    };
    if (fluid.parameters.formulation == FormulationKind::mps) {
        sweep_reference<Stored>(particles, pairs, row, fluid.mps_kernel, terms...);
    } else {
        sweep_reference<Stored>(particles, pairs, row, fluid.kernel, terms...);
    }
}

real length(const Vec3& v)
{
    return v.norm();
}
real length(real v)
{
    return std::abs(v);
}

// Every value against the largest of the column.
void expect_same(const auto& fast, const auto& clearly, Rows rows, real tolerance,
                 std::string_view what)
{
    real largest_value = 0;
    for (Index k = rows.begin; k < rows.end; ++k) {
        largest_value = std::max(largest_value, length(clearly[at(k)]));
    }
    ASSERT_GT(largest_value, 0) << what;
    for (Index k = rows.begin; k < rows.end; ++k) {
        ASSERT_LE(length(fast[at(k)] - clearly[at(k)]), tolerance * largest_value)
            << what << " of row " << k;
    }
}

std::vector<real> copy_of(std::span<const real> column)
{
    return {column.begin(), column.end()};
}

// A gap stays as it was unless solids fill more of the support than a plane wall that is touched.
void expect_room_for_gaps(const Fluid& fluid, std::span<const real> of_solids,
                          std::span<const real> before)
{
    const FluidParameters& f = fluid.parameters;
    const real plane = f.formulation == FormulationKind::mps
                           ? sum_beside_plane(fluid.mps_kernel, dp, 3)
                           : sum_beside_plane(fluid.kernel, dp, 3);
    int narrowed = 0;
    for (Index k = 0; k < fluid.particles.fluid().end; ++k) {
        const real room = f.mass * std::max(real(0), plane - of_solids[at(k)]);
        narrowed += room < before[at(k)] ? 1 : 0;
        // 250 kg/m3 beside a plane, places rounded to half a millionth of a spacing: 1e-4 each.
        ASSERT_NEAR(fluid.particles[field::gap][at(k)], std::min(room, before[at(k)]), 1e-3) << k;
    }
    EXPECT_GT(narrowed, 10);
}

class Loops : public testing::TestWithParam<Choice> {
protected:
    // Positions in units of 1e-6 spacings, a hundred roundings; double has its own.
    static real tolerance()
    {
        return GetParam().precision == Precision::single_precision ? 2e-5 : 1e-12;
    }
};

TEST_P(Loops, EveryStageEqualsItsReference)
{
    Fluid fluid = make_mixture(GetParam());
    const FluidNeighbours& n = fluid.neighbours;
    update_neighbours(fluid);
    update_pressure(fluid);
    const Particles& p = fluid.particles;
    {
        Particles clearly = p;
        clear(clearly, p.solid(), WallExtrapolation::Writes{});
        const WallExtrapolation term{fluid.parameters.eos, fluid.parameters.gravity};
        sweep_clearly(clearly, fluid, n.wall_fluid, term);
        sweep_clearly(clearly, fluid, n.body_fluid, term);
        for (Index k = p.solid().begin; k < p.solid().end; ++k) {
            real& pressure = clearly[field::pressure][at(k)];
            const real weight = clearly[field::shepard_sum][at(k)];
            pressure = weight > 0 ? positive(pressure / weight) : 0;
        }
        expect_same(p[field::pressure], clearly[field::pressure], p.solid(), tolerance(),
                    "pressure of solids");
    }
    const real dt = 1e-4;
    update_forces(fluid, dt);
    Particles clearly = p;
    clear(clearly, {0, p.size()}, Fields<Force>{});
    const SolidBackstop stop{dp, fluid.parameters.mass / (2 * dt)};
    Particles shown = p; // to solids
    clear(shown, {0, p.size()}, Fields<Force>{});
    for (Index k = 0; k < p.fluid().end; ++k) {
        real& pressure = shown[field::pressure][at(k)];
        pressure = p[field::gap][at(k)] > 0 ? 0 : pressure;
    }
    if (GetParam().formulation == FormulationKind::mps) {
        clear(clearly, p.fluid(), MpsGradient::Writes{});
        sweep_clearly(clearly, fluid, n.fluid_fluid, MpsGradient{});
        clear(shown, p.fluid(), MpsGradient::Writes{});
        sweep_clearly(shown, fluid, n.fluid_solid, MpsWallGradient{}, stop);
        for_each(MpsGradient::Writes{}, [&](auto column) {
            for (Index k = 0; k < p.fluid().end; ++k) {
                clearly[column][at(k)] += shown[column][at(k)];
            }
        });
        add_corrected_pressure(fluid.parameters, clearly);
    } else {
        sweep_clearly(clearly, fluid, n.fluid_fluid, PressureForce{});
        sweep_clearly(shown, fluid, n.fluid_solid, WallPressureForce{}, stop);
    }
    for (const PairList* list : {&n.wall_fluid, &n.body_fluid}) {
        sweep_clearly(shown, fluid, *list, WallPressureForce{}, stop);
    }
    for (Index k = 0; k < p.size(); ++k) {
        clearly[field::force][at(k)] += shown[field::force][at(k)];
    }
    sweep_clearly(clearly, fluid, n.body_solid, WallPressureForce{});
    sweep_clearly(clearly, fluid, n.wall_body, WallPressureForce{});
    expect_same(p[field::force], clearly[field::force], p.fluid(), tolerance(), "force on fluid");
    expect_same(p[field::force], clearly[field::force], p.solid(), tolerance(), "force on solids");
    if (GetParam().diffusion) {
        clear(clearly, p.fluid(), Fields<DiffusionRate>{});
        sweep_clearly(clearly, fluid, n.fluid_fluid,
                      std::get<DensityDiffusion>(fluid.effects.diffusion));
        expect_same(p[field::diffusion_rate], clearly[field::diffusion_rate], p.fluid(),
                    tolerance(), "diffusion");
    }
}

TEST_P(Loops, RatesEqualTheirReference)
{
    Fluid fluid = make_mixture(GetParam());
    const FluidNeighbours& n = fluid.neighbours;
    update_neighbours(fluid);
    update_pressure(fluid);
    update_forces(fluid, 1e-4);
    const std::vector<real> gap = copy_of(fluid.particles[field::gap]);
    update_rates(fluid);
    const Particles& p = fluid.particles;
    Particles clearly = p;
    clear(clearly, p.fluid(), SolidContinuity::Writes{});
    sweep_clearly(clearly, fluid, n.fluid_solid, SolidContinuity{});
    expect_room_for_gaps(fluid, clearly[field::shepard_sum], gap);
    clear(clearly, p.fluid(), Fields<DensityRate>{});
    sweep_clearly(clearly, fluid, n.fluid_fluid, Continuity{});
    sweep_clearly(clearly, fluid, n.fluid_solid, Continuity{});
    for (Index k = 0; k < p.fluid().end; ++k) {
        clearly[field::density_rate][at(k)] *= p[field::density][at(k)];
        if (GetParam().diffusion) {
            clearly[field::density_rate][at(k)] += p[field::diffusion_rate][at(k)];
        }
    }
    expect_same(p[field::density_rate], clearly[field::density_rate], p.fluid(), tolerance(),
                "rate of density");
    if (GetParam().viscosity) {
        clear(clearly, p.fluid(), Fields<ViscousForce>{});
        sweep_clearly(clearly, fluid, n.fluid_fluid, std::get<Viscosity>(fluid.effects.viscosity));
        expect_same(p[field::viscous_force], clearly[field::viscous_force], p.fluid(), tolerance(),
                    "viscous force");
    }
}

// The mixture with effects that are rare, all on.
Fluid make_rare(const Choice& choice,
                const std::variant<Viscosity, MorrisViscosity, EddyViscosity>& viscosity)
{
    Choice plain = choice;
    plain.diffusion = plain.viscosity = false;
    Fluid fluid = make_mixture(plain);
    const Particles before = fluid.particles;
    const FluidParameters& f = fluid.parameters;
    fluid.effects.diffusion = RenormalisedDiffusion{0.2 * f.h * 30, f.eos};
    fluid.effects.collision = ParticleCollision{0.5};
    fluid.effects.slip = NoSlip{};
    std::visit([&](const auto& v) { fluid.effects.viscosity = v; }, viscosity);
    allocate(fluid, before.fluid().size(), before.wall().size(), before.body().size());
    for_each(Fields<Position, Velocity, Density>{}, [&](auto column) {
        std::ranges::copy(before[column], fluid.particles[column].begin());
    });
    std::ranges::copy(before.owner(), fluid.particles.owner().begin());
    const Rows solids = fluid.particles.solid();
    for (Index k = solids.begin; k < solids.end; ++k) {
        fluid.particles[field::depth][at(k)] = dp * (0.2 + 0.1 * static_cast<real>(k % 13));
    }
    return fluid;
}

// The velocities that solids show to the viscosity, one pair at a time.
std::vector<Vec3> mirrored_clearly(const Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    Particles clearly = fluid.particles;
    clear(clearly, clearly.solid(), NoSlip::Writes{});
    sweep_clearly(clearly, fluid, n.wall_fluid, NoSlip{});
    sweep_clearly(clearly, fluid, n.body_fluid, NoSlip{});
    std::vector<Vec3> v(clearly[field::velocity].begin(), clearly[field::velocity].end());
    for (Index k = clearly.solid().begin; k < clearly.size(); ++k) {
        const real w = clearly[field::shepard_sum][at(k)];
        if (w > 0) {
            v[at(k)] = mirrored_velocity(v[at(k)], clearly[field::velocity_sum][at(k)] / w,
                                         clearly[field::offset_sum][at(k)] / w,
                                         clearly[field::depth][at(k)], dp);
        }
    }
    return v;
}

TEST_P(Loops, RareForcesEqualTheirReference)
{
    Fluid fluid = make_rare(GetParam(), Viscosity{1000, 0.2, 1.5 * dp});
    const FluidNeighbours& n = fluid.neighbours;
    update_neighbours(fluid);
    update_pressure(fluid);
    const real dt = 1e-4;
    update_forces(fluid, dt);
    const Particles& p = fluid.particles;
    Particles clearly = p;
    clear(clearly, p.fluid(), Fields<DiffusionRate>{});
    clear(clearly, p.fluid(), DensityGradient::Writes{});
    sweep_clearly(clearly, fluid, n.fluid_fluid, DensityGradient{});
    for (Index k = 0; k < p.fluid().end; ++k) {
        const Vec3& m = clearly[field::mixed_moments][at(k)];
        Mat3 M = clearly[field::moments][at(k)].asDiagonal();
        M(1, 2) = M(2, 1) = m[0];
        M(0, 2) = M(2, 0) = m[1];
        M(0, 1) = M(1, 0) = m[2];
        clearly[field::velocity][at(k)] = M.inverse() * clearly[field::pressure_gradient][at(k)];
    }
    sweep_clearly(clearly, fluid, n.fluid_fluid,
                  std::get<RenormalisedDiffusion>(fluid.effects.diffusion));
    // The gradient takes some digits: its matrix is inverted.
    expect_same(p[field::diffusion_rate], clearly[field::diffusion_rate], p.fluid(),
                5 * tolerance(), "renormalised diffusion");
}

TEST_P(Loops, CollisionsAreTheBackstopOfTheFluid)
{
    Fluid with = make_rare(GetParam(), Viscosity{1000, 0.2, 1.5 * dp});
    Fluid without = make_rare(GetParam(), Viscosity{1000, 0.2, 1.5 * dp});
    without.effects.collision = Off{};
    const real dt = 1e-4;
    for (Fluid* fluid : {&with, &without}) {
        update_neighbours(*fluid);
        update_pressure(*fluid);
        update_forces(*fluid, dt);
    }
    const Particles& p = with.particles;
    Particles clearly = without.particles;
    if (with.parameters.formulation == FormulationKind::sph) {
        sweep_clearly(clearly, with, with.neighbours.fluid_fluid,
                      SolidBackstop{dp, 1.5 * with.parameters.mass / (2 * dt)});
        expect_same(p[field::force], clearly[field::force], p.fluid(), tolerance(), "collisions");
    }
    EXPECT_GT((p[field::force][7] - without.particles[field::force][7]).norm(), 0);
}

TEST_P(Loops, FrictionAndEddiesEqualTheirReference)
{
    const std::vector<std::variant<Viscosity, MorrisViscosity, EddyViscosity>> viscosities{
        Viscosity{1000, 0.2, 1.5 * dp}, MorrisViscosity{5},
        EddyViscosity{1000, 0.2, 1.5 * dp, 5, 2 * dp}};
    for (const auto& viscosity : viscosities) {
        Fluid fluid = make_rare(GetParam(), viscosity);
        const FluidNeighbours& n = fluid.neighbours;
        update_neighbours(fluid);
        update_pressure(fluid);
        update_forces(fluid, 1e-4);
        update_rates(fluid);
        const Particles& p = fluid.particles;
        Particles clearly = p;
        const std::vector<Vec3> mirrored = mirrored_clearly(fluid);
        std::ranges::copy(mirrored, clearly[field::velocity].begin());
        clear(clearly, {0, p.size()}, Fields<ViscousForce>{});
        const auto rub = [&](const auto& term) {
            sweep_clearly(clearly, fluid, n.fluid_fluid, term);
            for (const PairList* list : {&n.fluid_solid, &n.wall_fluid, &n.body_fluid}) {
                sweep_clearly(clearly, fluid, *list, term.at_wall());
            }
        };
        if (const auto* term = std::get_if<EddyViscosity>(&viscosity)) {
            clear(clearly, p.fluid(), StrainRate::Writes{});
            sweep_clearly(clearly, fluid, n.fluid_fluid, StrainRate{});
            sweep_clearly(clearly, fluid, n.fluid_solid, StrainRate{});
            expect_same(p[field::strain], clearly[field::strain], p.fluid(), tolerance(), "strain");
            expect_same(p[field::mixed_strain], clearly[field::mixed_strain], p.fluid(),
                        tolerance(), "mixed strain");
            for (Index k = 0; k < p.size(); ++k) {
                clearly[field::pressure][at(k)] =
                    k < p.fluid().end
                        ? eddy_viscosity(clearly[field::strain][at(k)],
                                         clearly[field::mixed_strain][at(k)], term->length)
                        : 0;
            }
        }
        std::visit(rub, viscosity);
        expect_same(p[field::viscous_force], clearly[field::viscous_force], p.fluid(),
                    2 * tolerance(), "viscous force on fluid");
        expect_same(p[field::viscous_force], clearly[field::viscous_force], p.solid(),
                    2 * tolerance(), "viscous force on solids");
        Vec3 sum(0, 0, 0);
        real scale = 0;
        for (const Vec3& force : p[field::viscous_force]) {
            sum += force;
            scale += force.norm();
        }
        EXPECT_LT(sum.norm(), tolerance() * scale); // action and reaction
    }
}

// Of the instruction sets that are compiled and that this machine has.
std::vector<Choice> every_choice()
{
    std::vector<Choice> choices;
    for (const auto set :
         {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
        if (!available(set)) {
            continue;
        }
        for (const auto precision : {Precision::single_precision, Precision::double_precision}) {
            for (const bool diffusion : {false, true}) {
                for (const bool viscosity : {false, true}) {
                    choices.push_back({precision, set, diffusion, viscosity});
                }
            }
            choices.push_back({precision, set, true, true, FormulationKind::mps});
        }
    }
    return choices;
}

// Letters, digits and low lines, as the name of a test has to be.
std::string choice_name(const testing::TestParamInfo<Choice>& info)
{
    std::string words = testing::PrintToString(info.param);
    std::erase(words, '-');
    std::ranges::replace(words, ' ', '_');
    return words;
}

INSTANTIATE_TEST_SUITE_P(Fluid, Loops, testing::ValuesIn(every_choice()), choice_name);

// What one particle feels from another is the opposite of what the other feels, bit for bit, in the
// loops that run: contraction and tiles included.
TEST(Loops, TwoParticlesFeelOppositeForces)
{
    for (const auto precision : {Precision::single_precision, Precision::double_precision}) {
        for (int k = 0; k < 40; ++k) {
            Fluid fluid = make_mixture({precision, widest_instruction_set(), true, true});
            allocate(fluid, 2, 0, 0);
            const Vec3 place(0.11 * k, -0.05 * k, 0.3 + 0.017 * k);
            fluid.particles[field::position][0] = place;
            fluid.particles[field::position][1] = place + dp * Vec3(0.9, 0.4, -0.3 - 0.01 * k);
            fluid.particles[field::velocity][0] = {0.3, 0.1, 0.2 - 0.013 * k};
            fluid.particles[field::velocity][1] = {-0.2, 0.3, 0.1};
            fluid.particles[field::density][0] = 1003.1;
            fluid.particles[field::density][1] = 1001.7 + 0.1 * k;
            update_neighbours(fluid);
            update_pressure(fluid);
            update_forces(fluid, 1e-4);
            update_rates(fluid);
            const auto F = fluid.particles[field::force];
            const auto G = fluid.particles[field::viscous_force];
            ASSERT_GT(F[0].norm(), 0);
            ASSERT_GT(G[0].norm(), 0);
            ASSERT_EQ(F[0], Vec3(-F[1])) << k;
            ASSERT_EQ(G[0], Vec3(-G[1])) << k;
        }
    }
}

} // namespace
} // namespace hyoryu
