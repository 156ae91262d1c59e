// SPDX-License-Identifier: MIT
// The units of sums over particles in fixed point: the scales of a weakly compressible fluid.
#pragma once

#include "hyoryu/core/fixed_sum.hpp"
#include "hyoryu/fluid/parameters.hpp"

namespace hyoryu {

/// In two dimensions those of forces, torques and fluxes are per metre of width.
struct SumUnits {
    FixedUnit velocity; // c0: momentum of a unit of mass [m/s]
    FixedUnit energy;   // c0^2: of a unit of mass [J/kg]
    FixedUnit force;    // rho0 c0^2 dp^(d-1): a density error of one on the face of a particle [N]
    FixedUnit torque;   // of that force at an arm of dp [N m]
    FixedUnit flux;     // c0 dp^(d-1) [m3/s]
};

inline SumUnits sum_units(const FluidParameters& f)
{
    const real face = f.dimensions == 2 ? f.spacing : sq(f.spacing);
    const real force = f.eos.rho0 * sq(f.eos.c0) * face;
    return {.velocity = fixed_unit(f.eos.c0),
            .energy = fixed_unit(sq(f.eos.c0)),
            .force = fixed_unit(force),
            .torque = fixed_unit(force * f.spacing),
            .flux = fixed_unit(f.eos.c0 * face)};
}

} // namespace hyoryu
