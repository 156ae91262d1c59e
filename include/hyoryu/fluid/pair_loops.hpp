// SPDX-License-Identifier: MIT
// The pair loops of the fluid: which terms are summed together over which pairs. They are compiled
// once for each instruction set and chosen at start.
#pragma once

#include "hyoryu/fluid/effects.hpp"
#include "hyoryu/fluid/formulation.hpp"
#include "hyoryu/fluid/parting.hpp"
#include "hyoryu/fluid/wall.hpp"

#include <array>
#include <tuple>

namespace hyoryu {

/// All that a particle shows its neighbours: one record of 32 bytes in single precision.
using Stored = Fields<Position, Velocity, Volume, Pressure>;

/// The terms of a run with their parameters.
struct FluidTerms {
    WallExtrapolation extrapolation;
    SolidBackstop backstop;
    FluidEffects effects;
    SolidBackstop collision;
};

/// The passes that belong to no effect, each with the terms that it sums together; those of a stage
/// take in the terms of the effects that name it.
namespace pass {

/// solid <- fluid: the pressure before a solid
struct Extrapolation {
    static void call(const auto&, const FluidTerms& terms, const auto& f)
    {
        f(terms.extrapolation);
    }
};
/// fluid <- fluid: pressure and what belongs to it
struct FluidForces {
    template <class Formulation>
    static void call(Formulation, const FluidTerms& terms, const auto& f)
    {
        with_terms_of<stage::Forces>(terms.effects, [&](const auto&... more) {
            f(typename Formulation::FluidPressure{}, more...);
        });
    }
};
/// fluid <- solid: pressure and backstop
struct SolidForces {
    template <class Formulation>
    static void call(Formulation, const FluidTerms& terms, const auto& f)
    {
        f(typename Formulation::SolidPressure{}, terms.backstop);
    }
};
/// solid <- fluid: the reaction of pressure and backstop
struct SolidLoads {
    static void call(const auto&, const FluidTerms& terms, const auto& f)
    {
        f(WallPressureForce{}, terms.backstop);
    }
};
/// body <- solid and back: pressure in thin films
using FilmForces = PassOf<WallPressureForce>;
/// fluid <- fluid: continuity, viscosity and what else depends on velocities
struct FluidRates {
    static void call(const auto&, const FluidTerms& terms, const auto& f)
    {
        with_terms_of<stage::Rates>(terms.effects,
                                    [&](const auto&... more) { f(Continuity{}, more...); });
    }
};
/// fluid <- solid: continuity
using SolidRates = PassOf<SolidContinuity>;
/// fluid <- fluid and solid: crowding
struct CrowdingSums {
    static void call(const auto&, const FluidTerms& terms, const auto& f)
    {
        with_terms_of<stage::Crowding>(terms.effects, f);
    }
};

} // namespace pass

using AllPasses = JoinedPasses<
    PassList<pass::Extrapolation, pass::FluidForces, pass::SolidForces, pass::SolidLoads,
             pass::FilmForces, pass::FluidRates, pass::SolidRates, pass::CrowdingSums>,
    EffectPasses>::type;

/// The loops of a formulation in the number Real, one for each pass, each over one block of lists.
template <class Real, class Formulation = Sph>
struct PairLoops {
    using View = SweepView<Stored, Real, typename Formulation::PairKernel>;
    using Row = RecordRow<Stored, Real>;
    using Loop = void (*)(const View& view, Index block, Row* local, const FluidTerms& terms);

    int lanes = 1; // of a pack
    std::array<Loop, static_cast<std::size_t>(AllPasses::count)> loop{};
};

/// Of every formulation, in either precision.
using FluidLoops = std::tuple<PairLoops<float, Sph>, PairLoops<double, Sph>, PairLoops<float, Mps>,
                              PairLoops<double, Mps>>;

/// The loops for an instruction set, which must be available.
const FluidLoops& fluid_loops(InstructionSet set);

} // namespace hyoryu
