// SPDX-License-Identifier: MIT
// Compiled once for each instruction set.
#include "../loop_table.hpp"

namespace hyoryu {

namespace {

constexpr int bytes = HYORYU_REGISTER_BYTES;

// f(effect) for the effect that the slot holds. Unlike std::visit it has no way to throw, whose
// code the instruction sets would share.
template <class... Effects>
void with(const std::variant<Effects...>& slot, const auto& f)
{
    const auto try_one = [&]<class Effect>(const Effect* effect) {
        if constexpr (is_built<Effect>) {
            if (effect != nullptr) {
                f(*effect);
            }
        }
    };
    (try_one(std::get_if<Effects>(&slot)), ...);
}

template <class Real, class Formulation>
struct Loops {
    using View = typename PairLoops<Real, Formulation>::View;
    using Row = typename PairLoops<Real, Formulation>::Row;
    using FluidPressure = typename Formulation::FluidPressure;
    using SolidPressure = typename Formulation::SolidPressure;

    static void extrapolation(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        sweep_block<bytes>(view, block, local, terms.extrapolation);
    }
    static void fluid_forces(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        with(terms.effects.diffusion, [&]<class Diffusion>(const Diffusion& diffusion) {
            if constexpr (std::is_same_v<Diffusion, RenormalisedDiffusion>) {
                sweep_block<bytes>(view, block, local, FluidPressure{}); // a loop of its own
            } else {
                sweep_block<bytes>(view, block, local, FluidPressure{}, diffusion);
            }
        });
    }
    static void solid_forces(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        sweep_block<bytes>(view, block, local, SolidPressure{}, terms.backstop);
    }
    static void solid_loads(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        sweep_block<bytes>(view, block, local, WallPressureForce{}, terms.backstop);
    }
    static void film_forces(const View& view, Index block, Row* local, const FluidTerms&)
    {
        sweep_block<bytes>(view, block, local, WallPressureForce{});
    }
    static void fluid_rates(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        with(terms.effects.viscosity, [&](const auto& viscosity) {
            sweep_block<bytes>(view, block, local, Continuity{}, viscosity);
        });
    }
    static void solid_rates(const View& view, Index block, Row* local, const FluidTerms&)
    {
        sweep_block<bytes>(view, block, local, SolidContinuity{});
    }

    static void shifting(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        with(terms.effects.shifting,
             [&](const auto& shift) { sweep_block<bytes>(view, block, local, shift); });
    }

    static void collision(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        if constexpr (is_built<ParticleCollision>) {
            sweep_block<bytes>(view, block, local, terms.collision);
        }
    }
    static void gradient(const View& view, Index block, Row* local, const FluidTerms&)
    {
        if constexpr (is_built<RenormalisedDiffusion>) {
            sweep_block<bytes>(view, block, local, DensityGradient{});
        }
    }
    static void diffusion(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        if (const auto* d = held<RenormalisedDiffusion>(terms.effects.diffusion)) {
            sweep_block<bytes>(view, block, local, *d);
        }
    }
    static void mirror(const View& view, Index block, Row* local, const FluidTerms&)
    {
        if constexpr (is_built<NoSlip>) {
            sweep_block<bytes>(view, block, local, NoSlip{});
        }
    }
    static void friction(const View& view, Index block, Row* local, const FluidTerms& terms)
    {
        with(terms.effects.viscosity, [&]<class V>(const V& viscosity) {
            if constexpr (!std::is_same_v<V, Off>) {
                sweep_block<bytes>(view, block, local, viscosity.at_wall());
            }
        });
    }
    static void strain(const View& view, Index block, Row* local, const FluidTerms&)
    {
        if constexpr (is_built<EddyViscosity>) {
            sweep_block<bytes>(view, block, local, StrainRate{});
        }
    }

    // Where solids feel the opposite of what the fluid does, one loop serves both.
    static constexpr auto loads =
        std::is_same_v<SolidPressure, WallPressureForce> ? solid_forces : solid_loads;
    static constexpr PairLoops<Real, Formulation> table{Pack<Real, bytes>::lanes,
                                                        extrapolation,
                                                        fluid_forces,
                                                        solid_forces,
                                                        loads,
                                                        film_forces,
                                                        fluid_rates,
                                                        solid_rates,
                                                        shifting,
                                                        collision,
                                                        gradient,
                                                        diffusion,
                                                        mirror,
                                                        friction,
                                                        strain};
};

} // namespace

template <>
const FluidLoops* fluid_loops<bytes>()
{
    static constexpr FluidLoops loops{Loops<float, Sph>::table, Loops<double, Sph>::table,
                                      Loops<float, Mps>::table, Loops<double, Mps>::table};
    return &loops;
}

} // namespace hyoryu
