// SPDX-License-Identifier: MIT
// The numbers of a weakly compressible fluid that do not change during a run.
#pragma once

#include "hyoryu/core/kernel.hpp"
#include "hyoryu/core/types.hpp"

#include <string_view>

namespace hyoryu {

/// Linear equation of state p = c0^2 (rho - rho0). At Mach 0.1 it equals Tait's law to the accuracy
/// of weak compressibility, and it is invertible, which walls need.
struct EquationOfState {
    real rho0 = 1000; // reference density [kg/m3]
    real c0 = 1;      // speed of sound [m/s]

    template <class N>
    N pressure(const N& rho) const // [Pa]
    {
        return sq(c0) * (rho - rho0);
    }
    template <class N>
    N density(const N& p) const // [kg/m3]
    {
        return rho0 + p * (1 / sq(c0));
    }
};

/// The number of pair arithmetic; state, sums over bodies and the bodies are double in either case.
enum class Precision { single_precision, double_precision };

constexpr std::string_view name(Precision precision)
{
    return precision == Precision::single_precision ? "single" : "double";
}

/// How the equations become sums over pairs.
enum class FormulationKind { sph, mps };

/// A fluid of equal particles; in two dimensions masses and forces are per metre of width.
struct FluidParameters {
    int dimensions = 3;
    FormulationKind formulation = FormulationKind::sph;
    EquationOfState eos;
    real spacing = 0;                           // dp [m]
    real h = 0;                                 // smoothing length [m]
    KernelShape kernel = KernelShape::wendland; // of gradients
    real mass = 0;             // of a particle, rho0 times the volume of its cell [kg]
    Vec3 gravity{0, 0, -9.81}; // g [m/s2]
    Vec3 drive{0, 0, 0};       // acceleration besides gravity, not part of hydrostatics [m/s2]
    real cfl = 0.6;            // scales the acoustic, force and viscous limits
    Precision precision = Precision::single_precision;
};

/// Mass of a cube of the spacing at rest, which a particle of a wall stands in for [kg].
inline real mass_of_cube(const FluidParameters& f)
{
    return f.eos.rho0 * f.spacing * f.spacing * (f.dimensions == 3 ? f.spacing : 1);
}

} // namespace hyoryu
