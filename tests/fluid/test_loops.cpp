// SPDX-License-Identifier: MIT
// The fused loops of every stage, in both precisions and for every instruction set at hand, against
// the same terms one pair at a time in double.
#include "hyoryu/core/parallel.hpp"
#include "mixtures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hyoryu::test_loops {
namespace {

bool is_mps(const Fluid& fluid)
{
    return fluid.parameters.formulation == FormulationKind::mps;
}

// Adds up what the terms of a stage write, over one list.
void sweep_clearly(Particles& particles, const Fluid& fluid, const PairList& pairs,
                   const auto&... terms)
{
    const FluidNeighbours& n = fluid.neighbours;
    const auto place = [&](Index slot) {
        const auto row_of = [&](Store& store, const Tiles& tiles) {
            return StoreRow{&store, tiles.row[at(slot - tiles.first_slot)]};
        };
        return slot < n.wall.first_slot   ? row_of(particles.fluid, n.fluid)
               : slot < n.body.first_slot ? row_of(particles.wall, n.wall)
                                          : row_of(particles.body, n.body);
    };
    using List = RecordList<Stored, std::remove_cvref_t<decltype(terms)>...>;
    if (is_mps(fluid) && &pairs == &n.fluid_fluid) {
        sweep_reference<List>(pairs, place, fluid.mps_kernel, terms...);
    } else {
        sweep_reference<List>(pairs, place, fluid.kernel, terms...);
    }
}

void clear_all(Particles& particles, auto fields)
{
    clear(particles.fluid, fields);
    clear(particles.wall, fields);
    clear(particles.body, fields);
}

real length(const Vec3& v)
{
    return v.norm();
}
real length(real v)
{
    return std::abs(v);
}

// Every value against the largest of the column, in all stores that are given.
void expect_same(std::initializer_list<std::pair<const Store*, const Store*>> fast_and_clear,
                 auto column, real tolerance, std::string_view what)
{
    real largest_value = 0;
    for (const auto& [fast, clearly] : fast_and_clear) {
        for (const auto& value : (*clearly)[column]) {
            largest_value = std::max(largest_value, length(value));
        }
    }
    ASSERT_GT(largest_value, 0) << what;
    for (const auto& [fast, clearly] : fast_and_clear) {
        for (Index k = 0; k < fast->size(); ++k) {
            ASSERT_LE(length((*fast)[column][k] - (*clearly)[column][k]), tolerance * largest_value)
                << what << " of row " << k;
        }
    }
}
void expect_same_fluid(const Particles& fast, const Particles& clearly, auto column, real tolerance,
                       std::string_view what)
{
    expect_same({{&fast.fluid, &clearly.fluid}}, column, tolerance, what);
}
void expect_same_solids(const Particles& fast, const Particles& clearly, auto column,
                        real tolerance, std::string_view what)
{
    expect_same({{&fast.wall, &clearly.wall}, {&fast.body, &clearly.body}}, column, tolerance,
                what);
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
    const real plane = sum_beside_plane(fluid.kernel, dp, 3);
    int narrowed = 0;
    for (Index k = 0; k < fluid.particles.fluid.size(); ++k) {
        const real room = f.mass * std::max(real(0), plane - of_solids[at(k)]);
        narrowed += room < before[at(k)] ? 1 : 0;
        // 250 kg/m3 beside a plane, places rounded to half a millionth of a spacing: 1e-4 each.
        ASSERT_NEAR(fluid.particles.fluid[field::gap][k], std::min(room, before[at(k)]), 1e-3) << k;
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
        for_solids(clearly, [](Store& solids) { clear(solids, WallExtrapolation::Writes{}); });
        const WallExtrapolation term{fluid.parameters.eos, fluid.parameters.gravity};
        sweep_clearly(clearly, fluid, n.wall_fluid, term);
        sweep_clearly(clearly, fluid, n.body_fluid, term);
        for_solids(clearly, [](Store& solids) {
            for (Index k = 0; k < solids.size(); ++k) {
                real& pressure = solids[field::pressure][k];
                const real weight = solids[field::shepard_sum][k];
                pressure = weight > 0 ? positive(pressure / weight) : 0;
            }
        });
        expect_same_solids(p, clearly, field::pressure, tolerance(), "pressure of solids");
    }
    update_rates(fluid); // of which the corrections of MPS come
    const real dt = 1e-4;
    update_forces(fluid, dt);
    Particles clearly = p;
    clear_all(clearly, Fields<Force>{});
    const SolidBackstop stop{dp, fluid.parameters.mass / (2 * dt)};
    Particles shown = p; // to solids
    clear_all(shown, Fields<Force>{});
    for (Index k = 0; k < p.fluid.size(); ++k) {
        real& pressure = shown.fluid[field::pressure][k];
        pressure = p.fluid[field::gap][k] > 0 ? 0 : pressure;
    }
    if (is_mps(fluid)) {
        sweep_clearly(clearly, fluid, n.fluid_fluid, CorrectedGradient{});
    } else {
        sweep_clearly(clearly, fluid, n.fluid_fluid, PressureForce{});
    }
    for (const PairList* list : {&n.fluid_solid, &n.wall_fluid, &n.body_fluid}) {
        if (is_mps(fluid)) {
            sweep_clearly(shown, fluid, *list, CorrectedWallForce{}, stop);
        } else {
            sweep_clearly(shown, fluid, *list, WallPressureForce{}, stop);
        }
    }
    for (auto store : {&Particles::fluid, &Particles::wall, &Particles::body}) {
        for (Index k = 0; k < (p.*store).size(); ++k) {
            (clearly.*store)[field::force][k] += (shown.*store)[field::force][k];
        }
    }
    sweep_clearly(clearly, fluid, n.body_solid, WallPressureForce{});
    sweep_clearly(clearly, fluid, n.wall_body, WallPressureForce{});
    expect_same_fluid(p, clearly, field::force, tolerance(), "force on fluid");
    expect_same_solids(p, clearly, field::force, tolerance(), "force on solids");
    if (GetParam().diffusion) {
        clear(clearly.fluid, Fields<DiffusionRate>{});
        sweep_clearly(clearly, fluid, n.fluid_fluid,
                      std::get<DensityDiffusion>(fluid.effects[slot::diffusion]));
        expect_same_fluid(p, clearly, field::diffusion_rate, tolerance(), "diffusion");
    }
}

TEST_P(Loops, RatesEqualTheirReference)
{
    Fluid fluid = make_mixture(GetParam());
    const FluidNeighbours& n = fluid.neighbours;
    update_neighbours(fluid);
    update_pressure(fluid);
    update_forces(fluid, 1e-4);
    update_rates(fluid); // of which the corrections of MPS come
    for (Index k = 0; k < fluid.particles.fluid.size(); k += 3) {
        fluid.particles.fluid[field::gap][k] = 100;
    }
    const std::vector<real> gap = copy_of(fluid.particles.fluid[field::gap]);
    update_rates(fluid);
    const Particles& p = fluid.particles;
    Particles clearly = p;
    clear(clearly.fluid, SolidContinuity::Writes{});
    sweep_clearly(clearly, fluid, n.fluid_solid, SolidContinuity{});
    expect_room_for_gaps(fluid, clearly.fluid[field::shepard_sum], gap);
    clear(clearly.fluid, Fields<DensityRate>{});
    if (is_mps(fluid)) {
        clear(clearly.fluid, Fields<CorrectionRate>{});
        sweep_clearly(clearly, fluid, n.fluid_fluid, CorrectedContinuity{});
    } else {
        sweep_clearly(clearly, fluid, n.fluid_fluid, Continuity{});
    }
    sweep_clearly(clearly, fluid, n.fluid_solid, Continuity{});
    for (Index k = 0; k < p.fluid.size(); ++k) {
        if (is_mps(fluid)) {
            clearly.fluid[field::density_rate][k] += clearly.fluid[field::correction_rate][k];
        }
        clearly.fluid[field::density_rate][k] *= p.fluid[field::density][k];
        if (GetParam().diffusion) {
            clearly.fluid[field::density_rate][k] += p.fluid[field::diffusion_rate][k];
        }
    }
    expect_same_fluid(p, clearly, field::density_rate, tolerance(), "rate of density");
    if (GetParam().viscosity) {
        clear(clearly.fluid, Fields<ViscousForce>{});
        sweep_clearly(clearly, fluid, n.fluid_fluid,
                      std::get<Viscosity>(fluid.effects[slot::viscosity]));
        expect_same_fluid(p, clearly, field::viscous_force, tolerance(), "viscous force");
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
    fluid.effects[slot::diffusion] = RenormalisedDiffusion{0.2 * f.h * 30, f.eos};
    fluid.effects[slot::collision] = ParticleCollision{0.5};
    fluid.effects[slot::slip] = NoSlip{};
    std::visit([&](const auto& v) { fluid.effects[slot::viscosity] = v; }, viscosity);
    allocate(fluid, before.fluid.size(), before.wall.size(), before.body.size());
    for (auto store : {&Particles::fluid, &Particles::wall, &Particles::body}) {
        for_each(Fields<Position, Velocity, Density>{}, [&](auto column) {
            std::ranges::copy((before.*store)[column], (fluid.particles.*store)[column].begin());
        });
        std::ranges::copy((before.*store).owner(), (fluid.particles.*store).owner().begin());
    }
    for_solids(fluid.particles, [](Store& solids) {
        for (Index k = 0; k < solids.size(); ++k) {
            solids[field::depth][k] = dp * (0.2 + 0.1 * static_cast<real>(k % 13));
        }
    });
    return fluid;
}

// The particles with the velocities that solids show to the viscosity, one pair at a time.
Particles mirrored_clearly(const Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    Particles clearly = fluid.particles;
    for_solids(clearly, [](Store& solids) { clear(solids, NoSlip::Writes{}); });
    sweep_clearly(clearly, fluid, n.wall_fluid, NoSlip{});
    sweep_clearly(clearly, fluid, n.body_fluid, NoSlip{});
    for_solids(clearly, [](Store& solids) {
        for (Index k = 0; k < solids.size(); ++k) {
            const real w = solids[field::shepard_sum][k];
            Vec3& v = solids[field::velocity][k];
            if (w > 0) {
                v = mirrored_velocity(v, solids[field::velocity_sum][k] / w,
                                      solids[field::offset_sum][k] / w, solids[field::depth][k],
                                      dp);
            }
        }
    });
    return clearly;
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
    clear(clearly.fluid, Fields<DiffusionRate>{});
    clear(clearly.fluid, DensityGradient::Writes{});
    sweep_clearly(clearly, fluid, n.fluid_fluid, DensityGradient{});
    for (Index k = 0; k < p.fluid.size(); ++k) {
        const Vec3& m = clearly.fluid[field::mixed_moments][k];
        Mat3 M = clearly.fluid[field::moments][k].asDiagonal();
        M(1, 2) = M(2, 1) = m[0];
        M(0, 2) = M(2, 0) = m[1];
        M(0, 1) = M(1, 0) = m[2];
        clearly.fluid[field::pressure_gradient][k] =
            M.inverse() * Vec3(clearly.fluid[field::pressure_gradient][k]);
    }
    sweep_clearly(clearly, fluid, n.fluid_fluid,
                  std::get<RenormalisedDiffusion>(fluid.effects[slot::diffusion]));
    // The gradient takes some digits: its matrix is inverted.
    expect_same_fluid(p, clearly, field::diffusion_rate, 5 * tolerance(), "renormalised diffusion");
}

TEST_P(Loops, CollisionsAreTheBackstopOfTheFluid)
{
    Fluid with = make_rare(GetParam(), Viscosity{1000, 0.2, 1.5 * dp});
    Fluid without = make_rare(GetParam(), Viscosity{1000, 0.2, 1.5 * dp});
    without.effects[slot::collision] = Off{};
    const real dt = 1e-4;
    for (Fluid* fluid : {&with, &without}) {
        update_neighbours(*fluid);
        update_pressure(*fluid);
        update_forces(*fluid, dt);
    }
    const Particles& p = with.particles;
    Particles clearly = without.particles;
    sweep_clearly(clearly, with, with.neighbours.fluid_fluid,
                  SolidBackstop{dp, 1.5 * with.parameters.mass / (2 * dt)});
    expect_same_fluid(p, clearly, field::force, tolerance(), "collisions");
    EXPECT_GT((p.fluid[field::force][7] - without.particles.fluid[field::force][7]).norm(), 0);
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
        Particles clearly = mirrored_clearly(fluid);
        clear_all(clearly, Fields<ViscousForce>{});
        const auto rub = [&](const auto& term) {
            sweep_clearly(clearly, fluid, n.fluid_fluid, term);
            for (const PairList* list : {&n.fluid_solid, &n.wall_fluid, &n.body_fluid}) {
                sweep_clearly(clearly, fluid, *list, term.at_wall());
            }
        };
        if (const auto* term = std::get_if<EddyViscosity>(&viscosity)) {
            clear(clearly.fluid, StrainRate::Writes{});
            sweep_clearly(clearly, fluid, n.fluid_fluid, StrainRate{});
            sweep_clearly(clearly, fluid, n.fluid_solid, StrainRate{});
            expect_same_fluid(p, clearly, field::strain, tolerance(), "strain");
            expect_same_fluid(p, clearly, field::mixed_strain, tolerance(), "mixed strain");
            for (Index k = 0; k < p.fluid.size(); ++k) {
                clearly.fluid[field::turbulent_viscosity][k] =
                    eddy_viscosity(clearly.fluid[field::strain][k],
                                   clearly.fluid[field::mixed_strain][k], term->length);
            }
        }
        std::visit(rub, viscosity);
        expect_same_fluid(p, clearly, field::viscous_force, 2 * tolerance(),
                          "viscous force on fluid");
        expect_same_solids(p, clearly, field::viscous_force, 2 * tolerance(),
                           "viscous force on solids");
        Particles rates = p; // continuity sees solids at their own velocities
        clear(rates.fluid, SolidContinuity::Writes{});
        sweep_clearly(rates, fluid, n.fluid_solid, SolidContinuity{});
        for (Index k = 0; k < p.fluid.size(); ++k) {
            rates.fluid[field::solid_rate][k] *= p.fluid[field::density][k];
        }
        expect_same_fluid(p, rates, field::solid_rate, tolerance(), "rate of density by solids");
        Vec3 sum(0, 0, 0);
        real scale = 0;
        for (const Store* store : {&p.fluid, &p.wall, &p.body}) {
            for (const Vec3& force : (*store)[field::viscous_force]) {
                sum += force;
                scale += force.norm();
            }
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
            choices.push_back(
                {precision, set, true, true, FormulationKind::sph, KernelShape::isotropic});
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
            fluid.particles.fluid[field::position][0] = place;
            fluid.particles.fluid[field::position][1] =
                place + dp * Vec3(0.9, 0.4, -0.3 - 0.01 * k);
            fluid.particles.fluid[field::velocity][0] = {0.3, 0.1, 0.2 - 0.013 * k};
            fluid.particles.fluid[field::velocity][1] = {-0.2, 0.3, 0.1};
            fluid.particles.fluid[field::density][0] = 1003.1;
            fluid.particles.fluid[field::density][1] = 1001.7 + 0.1 * k;
            update_neighbours(fluid);
            update_pressure(fluid);
            update_forces(fluid, 1e-4);
            update_rates(fluid);
            const auto F = fluid.particles.fluid[field::force];
            const auto G = fluid.particles.fluid[field::viscous_force];
            ASSERT_GT(F[0].norm(), 0);
            ASSERT_GT(G[0].norm(), 0);
            ASSERT_EQ(F[0], Vec3(-F[1])) << k;
            ASSERT_EQ(G[0], Vec3(-G[1])) << k;
        }
    }
}

} // namespace
} // namespace hyoryu::test_loops
