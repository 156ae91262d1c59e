// SPDX-License-Identifier: MIT
// The pair loops of the fluid: which terms are summed together over which pairs. They are compiled
// once for each instruction set and chosen at start.
#pragma once

#include "hyoryu/fluid/effects.hpp"
#include "hyoryu/fluid/formulation.hpp"

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

/// The loops of a formulation in the number Real, each over one block of lists.
template <class Real, class Formulation = Sph>
struct PairLoops {
    using View = SweepView<Stored, Real, typename Formulation::PairKernel>;
    using Row = RecordRow<Stored, Real>;
    using Loop = void (*)(const View& view, Index block, Row* local, const FluidTerms& terms);

    int lanes = 1;                // of a pack
    Loop extrapolation = nullptr; // solid <- fluid: the pressure before a solid
    Loop fluid_forces = nullptr;  // fluid <- fluid: pressure and diffusion
    Loop solid_forces = nullptr;  // fluid <- solid: pressure and backstop
    Loop solid_loads = nullptr;   // solid <- fluid: pressure and backstop
    Loop film_forces = nullptr;   // body <- solid and back: pressure in thin films
    Loop fluid_rates = nullptr;   // fluid <- fluid: continuity and viscosity
    Loop solid_rates = nullptr;   // fluid <- solid: continuity
    Loop shifting = nullptr;      // fluid <- fluid or solid: crowding
    Loop collision = nullptr;     // fluid <- fluid: collisions of splashes
    Loop gradient = nullptr;      // fluid <- fluid: gradient of the density
    Loop diffusion = nullptr;     // fluid <- fluid: diffusion that knows it
    Loop mirror = nullptr;        // solid <- fluid: the velocity before a solid
    Loop friction = nullptr;      // fluid <- solid and back: viscosity with that velocity mirrored
    Loop strain = nullptr;        // fluid <- fluid or solid: rate of strain
};

/// Of every formulation, in either precision.
using FluidLoops = std::tuple<PairLoops<float, Sph>, PairLoops<double, Sph>, PairLoops<float, Mps>,
                              PairLoops<double, Mps>>;

/// The loops for an instruction set, which must be available.
const FluidLoops& fluid_loops(InstructionSet set);

} // namespace hyoryu
