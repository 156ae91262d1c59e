// SPDX-License-Identifier: MIT
// The books: energy, momentum, and whether they close.
#pragma once

#include "hyoryu/core/types.hpp"

namespace hyoryu {

struct Simulation;

/// Energies [J] and momentum [kg m/s] at one moment; per metre of width in two dimensions.
struct Totals {
    double fluid_kinetic = 0;
    double fluid_potential = 0; // -m g . x, zero at the origin
    double fluid_internal = 0;  // of compression: m c0^2 (ln(rho/rho0) + rho0/rho - 1)
    double body_kinetic = 0;
    double body_potential = 0;
    Vec3 momentum{0, 0, 0};    // of fluid and bodies
    double momentum_scale = 0; // sum of |m v|: what the momentum is compared with
};

/// What has come and gone since the start.
struct Ledger {
    Totals start;
    double contact_loss = 0;        // energy lost in contacts [J]
    Vec3 wall_impulse{0, 0, 0};     // by walls and locked axes on fluid and bodies [N s]
    Vec3 gravity_impulse{0, 0, 0};  // [N s]
    double worst_closure = 0;       // largest |dP - impulses| of a step over the momentum scale [1]
    double worst_density_error = 0; // largest |rho/rho0 - 1| of the fluid so far
    Index worst_in_solids = 0;      // most fluid particles inside solids in any frame so far
};

Totals totals(const Simulation& sim);

/// State of the books before a step.
struct OpenBooks {
    Vec3 momentum{0, 0, 0};
    Vec3 lost{0, 0, 0};
    double scale = 0;
};
OpenBooks open_books(const Simulation& sim);
/// Books what the step of length dt did and checks that momentum closes.
void close_books(Simulation& sim, const OpenBooks& before, double dt);

} // namespace hyoryu
