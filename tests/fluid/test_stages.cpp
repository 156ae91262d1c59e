// SPDX-License-Identifier: MIT
// Every effect that is summed in a stage, by the list of slots: what the fused loops make of its
// columns against the same terms one pair at a time in double.
#include "dice.hpp"
#include "hyoryu/fluid/fluid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyoryu::test_stages {
namespace {

// Fluid alone on a jittered lattice of an edge, spacing and seed; each column has its own numbers.
Fluid make_cloud(const FluidEffects& effects, const FluidParameters& parameters, Dice& dice)
{
    constexpr int edge = 9;
    Fluid fluid;
    fluid.parameters = parameters;
    const real dp = parameters.spacing;
    fluid.kernel = make_kernel(parameters.h, dp, 3);
    fluid.effects = effects;
    allocate(fluid, edge * edge * edge, 0, 0);
    Store& store = fluid.particles.fluid;
    const auto off = [&](real most) {
        const real x = dice.between(-most, most);
        const real y = dice.between(-most, most);
        return Vec3(x, y, dice.between(-most, most));
    };
    for (int k = 0; k < edge * edge * edge; ++k) {
        const Vec3 lattice(k % edge, k / edge % edge, k / edge / edge);
        store[field::position][k] = dp * (lattice + off(0.2));
        store[field::velocity][k] = off(0.5);
        store[field::density][k] = 1005 + dice.between(-10, 10);
    }
    return fluid;
}

/// Calls `look(effects)` with the term of each model of each slot held alone, by its defaults.
void each_alone(const FluidParameters& parameters, const auto& look)
{
    for_each(ModelSlots<AllSlots>{}, [&](auto slot) {
        const auto each = [&]<class... Models>(const std::variant<Models...>&) {
            const auto one = [&]<class Model>(const Model& model) {
                if constexpr (!std::same_as<Model, Off>) {
                    FluidEffects effects;
                    model.fill(effects[slot], parameters);
                    look(effects);
                }
            };
            (one(Models{}), ...);
        };
        each(FluidChoices{}[slot]);
    });
}

real length(const Vec3& v)
{
    return v.norm();
}
real length(real v)
{
    return std::abs(v);
}

void expect_same_column(const Store& fast, const Store& clearly, auto column, real tolerance)
{
    real largest = 0;
    for (const auto& value : clearly[column]) {
        largest = std::max(largest, length(value));
    }
    ASSERT_GT(largest, 0) << column.info.name;
    for (Index k = 0; k < fast.size(); ++k) {
        ASSERT_LE(length(fast[column][k] - clearly[column][k]), tolerance * largest)
            << column.info.name << " of row " << k;
    }
}

// The terms of a pass that are on, summed clearly into columns that are zero.
template <class Pass>
void sum_clearly(const Fluid& fluid, Store& store)
{
    const auto place = [&](Index slot) {
        return StoreRow{&store, fluid.neighbours.fluid.row[static_cast<std::size_t>(slot)]};
    };
    const FluidTerms terms{{}, {}, fluid.effects, {}};
    Pass::call(terms, [&](const auto&... term) {
        if constexpr (sizeof...(term) > 0) {
            (clear(store, typename std::remove_cvref_t<decltype(term)>::Writes{}), ...);
            using List = RecordList<Stored, std::remove_cvref_t<decltype(term)>...>;
            sweep_reference<List>(fluid.neighbours.fluid_fluid, place, fluid.kernel, term...);
        }
    });
}

// The columns of the effects of a stage.
template <class Stage>
void expect_same_stage(const Fluid& fluid, const Store& clearly, real tolerance)
{
    for_each_effect(fluid.effects, [&]<class Effect>(const Effect&) {
        if constexpr (InStage<Effect, Stage>) {
            for_each(typename Effect::Writes{}, [&](auto column) {
                expect_same_column(fluid.particles.fluid, clearly, column, tolerance);
            });
        }
    });
}

TEST(Stages, SumEveryEffectAsItsReferenceDoes)
{
    Dice dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 3)));
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        for (const real spacing : {0.1, 0.013}) {
            const real h = 1.5 * spacing;
            const FluidParameters parameters{.eos = {1000, 30},
                                             .spacing = spacing,
                                             .h = h,
                                             .mass = 1000 * spacing * spacing * spacing,
                                             .precision = precision};
            // Places in units of 1e-6 spacings, a hundred roundings; double has its own.
            const real tolerance = precision == Precision::single_precision ? 2e-5 : 1e-12;
            each_alone(parameters, [&](const FluidEffects& effects) {
                Fluid fluid = make_cloud(effects, parameters, dice);
                update_neighbours(fluid);
                update_pressure(fluid);
                update_forces(fluid, 1e-4);
                Store clearly = fluid.particles.fluid;
                sum_clearly<pass::FluidForces>(fluid, clearly);
                expect_same_stage<stage::Forces>(fluid, clearly, tolerance);
                sum_clearly<pass::CrowdingSums>(fluid, clearly);
                shift(fluid, 1e-4);
                expect_same_stage<stage::Crowding>(fluid, clearly, tolerance);
            });
        }
    }
}

} // namespace
} // namespace hyoryu::test_stages
