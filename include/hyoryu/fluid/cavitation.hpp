// SPDX-License-Identifier: MIT
// Cavitation: fluid below the void pressure opens cavities instead of bearing tension.
#pragma once

#include "hyoryu/core/particles.hpp"
#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/fluid/slot.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

/// Fluid whose pressure would fall below that of a void opens a cavity C_i >= 0 instead: its
/// density stays constant and further expansion adds to the cavity, which must close before the
/// fluid is compressed again. So rho_i - C_i follows continuity, and the density that pressure and
/// diffusion see is the larger of it and of that at the pressure of the void.
/// Source: the bilinear fluid of Bleich & Sandler (1970); the density kept apart is ours.
struct Cavitation {
    static constexpr std::string_view name = "cavitation";
    using Writes = Fields<Cavity>;
    real density = 0; // of the fluid at the pressure of the void [kg/m3]

    /// Divides the result of continuity for a particle between `rho` and `cavity` [kg/m3].
    void divide(real& rho, real& cavity) const
    {
        const real with_void = rho - cavity;
        rho = std::max(with_void, density);
        cavity = rho - with_void;
    }
};

/// Cavitation, as the user chooses it.
struct VoidCavitation {
    static constexpr std::string_view name = Cavitation::name;
    using Makes = TermList<Cavitation>;
    static constexpr std::string_view model = "void";
    static constexpr std::string_view says = "opens a void where the pressure would otherwise fall "
                                             "below the void pressure, as in a shaken closed tank";
    double pressure = 0; // of the void [Pa]

    static void keys(auto& keys, auto& chosen)
    {
        keys.not_positive("pressure", chosen.pressure, "Pa",
                          "Pressure in the void relative to the air pressure: 0 without air, about "
                          "-99000 Pa for water under atmospheric pressure.");
    }
    std::string why() const
    {
        return fmt::format("`fluid.cavitation.model` is \"void\": opens below {} Pa", pressure);
    }
    void fill(auto& slot, const FluidParameters& f) const
    {
        slot = Cavitation{f.eos.density(pressure)};
    }
};

/// Acts where density moves on.
struct CavitationSlot {
    using Models = std::variant<Off, VoidCavitation>;
    using Terms = TermsOf<Models>;
    static constexpr SlotTable table{
        "cavitation", "Cavitation: voids that open under tension.",
        "; \"none\": the fluid sustains tension.",
        "`fluid.cavitation.model` is \"none\": the fluid sustains tension"};
};

namespace slot {
inline constexpr CavitationSlot cavitation{};
}

} // namespace hyoryu
