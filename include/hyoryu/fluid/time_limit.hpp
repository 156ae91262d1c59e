// SPDX-License-Identifier: MIT
// The limits of the time step, each with its name and source.
#pragma once

#include "hyoryu/core/types.hpp"

#include <array>
#include <span>
#include <string_view>

namespace hyoryu {

struct FluidParameters;

/// One limit of the time step.
struct TimeLimit {
    std::string_view name;
    real dt = infinity; // [s]
};

/// acoustic: CFL h/(c0 + |v|max) (CFL of h, default 0.6, stable to 1.2 with the position-Verlet
/// split); force: 0.25 sqrt(h/|a|max); viscous: 0.125 h^2/nu. Source: Monaghan (1992); Morris et
/// al. (1997). `nu`: the effective kinematic viscosity [m2/s].
std::array<TimeLimit, 3> fluid_limits(const FluidParameters& fluid, real top_speed,
                                      real top_acceleration, real nu);

/// 2 (h/c0) sqrt(M / (s N m)): the limit of explicit coupling for a light body of mass M with N
/// particles in its surface layer and fluid particles of mass m (measured: 2 is stable, 4 is not);
/// shorter with the isotropic kernel, as the acoustic one. `stiffness` s [1]: the compression of
/// the fluid before a solid that approaches it, over that of the plain continuity.
TimeLimit body_limit(const FluidParameters& fluid, real body_mass, Index surface_particles,
                     real stiffness);

/// The shortest of the limits.
TimeLimit shortest(std::span<const TimeLimit> limits);

} // namespace hyoryu
