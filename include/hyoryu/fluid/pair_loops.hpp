// SPDX-License-Identifier: MIT
// The pair loops of the fluid: which terms are summed together over which pairs. They are compiled
// once for each instruction set and chosen at start.
#pragma once

#include "hyoryu/core/mps_kernel.hpp"
#include "hyoryu/fluid/corrected_wall.hpp"
#include "hyoryu/fluid/effects.hpp"
#include "hyoryu/fluid/parting.hpp"
#include "hyoryu/fluid/pressure.hpp"
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

/// corrected() if the gradient is, else plain().
void if_corrected(const FluidTerms& terms, const auto& corrected, const auto& plain)
{
    if constexpr (is_built<CorrectedGradient>) {
        if (held<CorrectedGradient>(terms.effects) != nullptr) {
            corrected();
            return;
        }
    }
    plain();
}

/// solid <- fluid: the pressure before a solid
struct Extrapolation {
    static void call(const FluidTerms& terms, const auto& f) { f(terms.extrapolation); }
};
/// fluid <- fluid: pressure and what belongs to it
struct FluidForces {
    static void call(const FluidTerms& terms, const auto& f)
    {
        with_terms_of<stage::Forces>(terms.effects, [&](const auto&... more) {
            if_corrected(
                terms, [&] { f(CorrectedGradient{}, more...); },
                [&] { f(PressureForce{}, more...); });
        });
    }
};
/// fluid <- solid and solid <- fluid: pressure and backstop
struct SolidForces {
    static void call(const FluidTerms& terms, const auto& f)
    {
        if_corrected(
            terms, [&] { f(CorrectedWallForce{}, terms.backstop); },
            [&] { f(WallPressureForce{}, terms.backstop); });
    }
};
/// body <- solid and back: pressure in thin films
using FilmForces = PassOf<WallPressureForce>;
/// fluid <- fluid: continuity, viscosity and what else depends on velocities
struct FluidRates {
    static void call(const FluidTerms& terms, const auto& f)
    {
        with_terms_of<stage::Rates>(terms.effects, [&](const auto&... more) {
            if_corrected(
                terms, [&] { f(CorrectedContinuity{}, GradientMoments{}, more...); },
                [&] { f(Continuity{}, more...); });
        });
    }
};
/// fluid <- solid: continuity, moments for the next correction, normals of paired walls
struct SolidRates {
    static void call(const FluidTerms& terms, const auto& f)
    {
        const auto with = [&](const auto&... more) {
            if_corrected(
                terms, [&] { f(SolidContinuity{}, GradientMoments{}, more...); },
                [&] { f(SolidContinuity{}, more...); });
        };
        if constexpr (is_built<PairedWalls>) {
            if (held<PairedWalls>(terms.effects) != nullptr) {
                with(PairedWalls::Normal{});
                return;
            }
        }
        with();
    }
};
/// fluid <- fluid and solid: crowding
struct CrowdingSums {
    static void call(const FluidTerms& terms, const auto& f)
    {
        with_terms_of<stage::Crowding>(terms.effects, f);
    }
};

} // namespace pass

using AllPasses =
    JoinedPasses<PassList<pass::Extrapolation, pass::FluidForces, pass::SolidForces,
                          pass::FilmForces, pass::FluidRates, pass::SolidRates, pass::CrowdingSums>,
                 EffectPasses>::type;

/// Passes with solids only, which use the kernel of SPH in either formulation.
using SolidPasses =
    PassList<pass::Extrapolation, pass::SolidForces, pass::FilmForces, pass::SolidRates,
             NoSlip::Mirror, NoSlip::Friction, PairedWalls::Before, PairedWalls::Rates>;

/// The loops of a kernel in the number Real, one for each pass, each over one block of lists; none
/// for `SolidPasses` with the kernel of MPS. SPH and MPS have the same terms.
template <class Real, class PairKernel = Kernel>
struct PairLoops {
    using View = SweepView<Real, PairKernel>;
    /// `local`: room for the records of all chunks of the block. Both it and the records of the
    /// view have the list `RecordList<Stored, ...>` of the terms that the pass sums.
    using Loop = void (*)(const View& view, Index block, std::byte* local, const FluidTerms& terms);

    int lanes = 1; // of a pack
    std::array<Loop, static_cast<std::size_t>(AllPasses::count)> loop{};
};

/// Of every kernel, in either precision.
using FluidLoops = std::tuple<PairLoops<float, Kernel>, PairLoops<double, Kernel>,
                              PairLoops<float, MpsKernel>, PairLoops<double, MpsKernel>>;

/// The loops for an instruction set, which must be available.
const FluidLoops& fluid_loops(InstructionSet set);

} // namespace hyoryu
