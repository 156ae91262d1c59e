// SPDX-License-Identifier: MIT
// Conservation: energy and momentum of the simulation, the impulses of walls and gravity, and the
// closure error of momentum: the part of its change that the impulses do not explain.
#pragma once

#include "hyoryu/sim/survey.hpp"

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
    double momentum_scale = 0; // sum of |m v|: the reference of the closure error
};

/// Energies and impulses accumulated since the start.
struct Conservation {
    Totals start;
    double contact_loss = 0;        // energy lost in contacts [J]
    Vec3 wall_impulse{0, 0, 0};     // by walls, locked axes and sponges on fluid and bodies [N s]
    Vec3 gravity_impulse{0, 0, 0};  // [N s]
    double worst_closure = 0;       // largest |dP - impulses| of a step over the momentum scale [1]
    double worst_density_error = 0; // largest |rho/rho0 - 1| of the fluid so far
    Index worst_in_solids = 0;      // most fluid particles inside solids in any frame so far
};

Totals totals(const Simulation& sim);

/// Lost momentum and the impulse at open sides, accumulated from the start until a step.
struct OutflowBefore {
    Vec3 lost{0, 0, 0}; // momentum of particles that left the domain
    Vec3 open{0, 0, 0}; // impulse at open sides
};
OutflowBefore outflow_before(const Simulation& sim);
/// Where a step began.
struct StepStart {
    StateSurvey survey;
    OutflowBefore outflow;
};
/// Adds the impulses and losses of a step of length dt and the closure error of its momentum, from
/// its start to the survey of its end.
void update_conservation(Simulation& sim, const StepStart& start, const StateSurvey& end,
                         double dt);

} // namespace hyoryu
