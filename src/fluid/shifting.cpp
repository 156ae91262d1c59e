// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/shifting.hpp"

#include "sharing.hpp"
#include "sweeps.hpp"

#include "hyoryu/fluid/fluid.hpp"

#include <algorithm>

namespace hyoryu {
namespace {

const Shifting* shifting_of(const FluidEffects& effects)
{
    if (const auto* conservative = held<ConservativeShifting>(effects)) {
        return &conservative->shifting;
    }
    return held<Shifting>(effects);
}

// The solids first, since they count half in the sum over pairs of which both particles move.
void sum_crowding(Fluid& fluid, const FluidTerms& terms)
{
    Store& store = fluid.particles.fluid;
    clear(store, StageWrites<stage::Crowding>{});
    run<pass::CrowdingSums>(fluid, fluid.neighbours.fluid_solid, to_fluid(fluid), terms);
    if (store.has(field::concentration_gradient)) {
        const auto G = store[field::concentration_gradient];
        parallel_for(0, store.size(), [&](Index i) { G[i] *= real(0.5); });
    }
    run<pass::CrowdingSums>(fluid, fluid.neighbours.fluid_fluid, to_fluid(fluid), terms);
}

// Adds the change of concentration by the shifts d(i) to what the densities owe, of which they take
// over the share [1].
void follow_concentration(Fluid& fluid, real share, const auto& d)
{
    Store& store = fluid.particles.fluid;
    const auto rho = store[field::density];
    const auto owed = store[field::owed_density];
    const auto G = store[field::concentration_gradient];
    parallel_for(0, store.size(), [&](Index i) {
        const real all = owed[i] + 2 * rho[i] * d(i).dot(G[i]);
        rho[i] += share * all;
        owed[i] = all - share * all;
    });
}

} // namespace

void shift(Fluid& fluid, real dt)
{
    const Shifting* shifting = shifting_of(fluid.effects);
    if (shifting == nullptr) {
        return;
    }
    sum_crowding(fluid, terms_of(fluid, dt));
    constexpr real most_spacings = 0.05;
    Store& store = fluid.particles.fluid;
    const FluidParameters& f = fluid.parameters;
    const real fastest = largest_of_all(fluid, top_speed(fluid));
    const real scale = shifting->coefficient * f.h * fastest * dt;
    const auto x = store[field::position];
    const auto S = store[field::shift_gradient];
    const auto way = [&](Index i) -> Vec3 {
        const real far = scale * S[i].norm();
        const real most = most_spacings * f.spacing;
        return -(far > most ? most / far : 1) * scale * S[i];
    };
    if (held<ConservativeShifting>(fluid.effects) != nullptr) {
        const real time = ConservativeShifting::release * f.h / f.eos.c0;
        follow_concentration(fluid, std::min(dt / time, real(1)), way);
    }
    parallel_for(0, store.size(), [&](Index i) { x[i] += way(i); });
}

} // namespace hyoryu
