// SPDX-License-Identifier: MIT
// The pair loops of the fluid: which terms are summed together over which pairs. They are compiled
// once for each instruction set and chosen at start.
#pragma once

#include "hyoryu/fluid/corrected_wall.hpp"
#include "hyoryu/fluid/effects.hpp"
#include "hyoryu/fluid/formulation.hpp"
#include "hyoryu/fluid/parting.hpp"
#include "hyoryu/fluid/wall.hpp"

#include <array>
#include <tuple>

namespace hyoryu {

/// The common records, which serve most loops: 32 bytes in single precision.
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

/// f(pressure, more...): the pressure term of the fluid among itself.
template <class Formulation>
void with_pressure(Formulation, const FluidTerms& terms, const auto& f, const auto&... more)
{
    if constexpr (Formulation::may_correct) {
        if (const auto* corrected = held<CorrectedGradient>(terms.effects)) {
            f(*corrected, more...);
            return;
        }
    }
    f(typename Formulation::FluidPressure{}, more...);
}
/// f(pressure, more...): the pressure term between fluid and solids; `plain` without correction.
template <class Formulation>
void with_solid_pressure(Formulation, const FluidTerms& terms, const auto& plain, const auto& f,
                         const auto&... more)
{
    if constexpr (Formulation::may_correct) {
        if (held<CorrectedGradient>(terms.effects) != nullptr) {
            f(CorrectedWallForce{}, more...);
            return;
        }
    }
    f(plain, more...);
}
/// f(continuity, more...): the continuity that belongs to that pressure, and sums for the next.
template <class Formulation>
void with_continuity(Formulation, const FluidTerms& terms, const auto& plain, const auto& corrected,
                     const auto& f, const auto&... more)
{
    if constexpr (Formulation::may_correct) {
        if (held<CorrectedGradient>(terms.effects) != nullptr) {
            f(corrected, GradientMoments{}, more...);
            return;
        }
    }
    f(plain, more...);
}

/// solid <- fluid: the pressure before a solid
struct Extrapolation {
    static void call(const auto&, const FluidTerms& terms, const auto& f)
    {
        f(terms.extrapolation);
    }
};
/// fluid <- fluid: pressure and what belongs to it
struct FluidForces {
    static void call(auto formulation, const FluidTerms& terms, const auto& f)
    {
        with_terms_of<stage::Forces>(terms.effects, [&](const auto&... more) {
            with_pressure(formulation, terms, f, more...);
        });
    }
};
/// fluid <- solid: pressure and backstop
struct SolidForces {
    template <class Formulation>
    static void call(Formulation, const FluidTerms& terms, const auto& f)
    {
        with_solid_pressure(Formulation{}, terms, typename Formulation::SolidPressure{}, f,
                            terms.backstop);
    }
};
/// solid <- fluid: the reaction of pressure and backstop
struct SolidLoads {
    static void call(auto formulation, const FluidTerms& terms, const auto& f)
    {
        with_solid_pressure(formulation, terms, WallPressureForce{}, f, terms.backstop);
    }
};
/// body <- solid and back: pressure in thin films
using FilmForces = PassOf<WallPressureForce>;
/// fluid <- fluid: continuity, viscosity and what else depends on velocities
struct FluidRates {
    static void call(auto formulation, const FluidTerms& terms, const auto& f)
    {
        with_terms_of<stage::Rates>(terms.effects, [&](const auto&... more) {
            with_continuity(formulation, terms, Continuity{}, CorrectedContinuity{}, f, more...);
        });
    }
};
/// fluid <- solid: continuity
struct SolidRates {
    static void call(auto formulation, const FluidTerms& terms, const auto& f)
    {
        with_continuity(formulation, terms, SolidContinuity{}, SolidContinuity{}, f);
    }
};
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
    using View = SweepView<Real, typename Formulation::PairKernel>;
    /// `local`: room for the records of all chunks of the block. Both it and the records of the
    /// view have the list `RecordList<Stored, ...>` of the terms that the pass sums.
    using Loop = void (*)(const View& view, Index block, std::byte* local, const FluidTerms& terms);

    int lanes = 1; // of a pack
    std::array<Loop, static_cast<std::size_t>(AllPasses::count)> loop{};
};

/// Of every formulation, in either precision.
using FluidLoops = std::tuple<PairLoops<float, Sph>, PairLoops<double, Sph>, PairLoops<float, Mps>,
                              PairLoops<double, Mps>>;

/// The loops for an instruction set, which must be available.
const FluidLoops& fluid_loops(InstructionSet set);

} // namespace hyoryu
