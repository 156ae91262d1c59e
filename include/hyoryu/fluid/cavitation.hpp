// SPDX-License-Identifier: MIT
// Water that is torn apart rather than pulled.
#pragma once

#include "hyoryu/core/particles.hpp"

#include <algorithm>

namespace hyoryu {

/// Fluid that would be pulled below the pressure of a void opens one instead: its density stays,
/// and what continuity takes from it further goes to a cavity C_i >= 0, which has to close before
/// the fluid is compressed. So rho_i - C_i follows continuity, and the density that pressure and
/// diffusion see is the larger of it and of that at the pressure of the void.
/// Source: the bilinear fluid of Bleich & Sandler (1970); the density kept apart is ours.
struct Cavitation {
    static constexpr std::string_view name = "cavitation";
    using Writes = Fields<Cavity>;
    real density = 0; // of the fluid at the pressure of the void [kg/m3]

    /// Divides what continuity has made of a particle, `rho` and `cavity` [kg/m3], between the two.
    void divide(real& rho, real& cavity) const
    {
        const real with_void = rho - cavity;
        rho = std::max(with_void, density);
        cavity = rho - with_void;
    }
};

} // namespace hyoryu
