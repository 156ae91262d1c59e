// SPDX-License-Identifier: MIT
// The water that enters a joint: its inertia while the sides part, and the sound that carries the
// pressure of the rims into it.
#pragma once

#include "hyoryu/core/types.hpp"

namespace hyoryu {

/// The inflow into a joint. Its section counts as at least a spacing high: the unevenness of real
/// joints.
struct Inflow {
    double opening = 0;     // mean speed at which the sides part [m/s]
    double area = 0;        // of the joint [m2]
    double section = 0;     // of the wet part of the rim [m2]
    double rim = 0;         // length of the wet part of the rim [m]
    double open = 0;        // length of the rim that no other solid closes [m]
    double push = 0;        // of the joint, without the drop [N]
    double mass = infinity; // that parts [kg]
};

/// What a joint keeps from step to step. The flow Q into it is the growth of the volume between its
/// sides; a uniform pressure p in it does the work p Q.
struct JointInflow {
    bool known = false;  // whether the joint has been there for a step
    double opening = 0;  // Q divided by the area: mean speed at which the sides part [m/s]
    double pressure = 0; // mean of the joint, without drops [Pa]
    double drop = 0;     // of the pressure, for the acceleration of the water [Pa]
};

/// The drop of the pressure by the growth of the flow, rho l / (3 S) [kg/m4]: that in a slot of
/// uniform width, closed at its end, whose sides part evenly. `path`: l, the area divided by the
/// length of the rim; `section`: S, through which the water enters [m2].
double joint_inertance(double density, double path, double section);

/// What the pressure and the motion of a joint depend on.
struct JointResponse {
    double inertance = 0; // I [kg/m4]
    double mobility = 0;  // M: dQ/dt by a unit of pressure in the joint [m4/kg]
};

/// The drop I dQ/dt, between zero and a limit such as the pressure of the joint. The inflow slows
/// what causes it: dQ/dt falls by the drop times the mobility, whatever else moves the bodies or
/// holds them. The last drop d is therefore taken on by a step of Newton's method,
///
///     d' = d + (I dQ/dt - d) / (1 + I M),   dQ/dt as measured over the last step,
///
/// which ends at I dQ/dt, for a free body at once. `last`: d, `growth`: dQ/dt.
double inertia_drop(double last, const JointResponse& joint, double growth, double limit);

/// The drop rho u^2 / 2 by Bernoulli's law, u the flow divided by the wet section of the rim; the
/// dry part admits air. Implicit in the speed over a step dt, which the drop itself lowers:
/// m (v' - v) = m dt max(dv/dt, 0) - dt k v'^2, k = rho A^3 / (2 section^2). `growth`: A dv/dt.
double bernoulli_drop(const Inflow& in, double density, double growth, double dt);

/// The pressure of a joint, or its push, after a step in which that of its rims has become `rims`.
/// A jump spreads by sound in l / 2c, the mean time from the rim, l as above with all of the open
/// rim: a pulse shorter than that acts on a part of the joint only. With the whole pulse at once,
/// water that stops at the side of a light body would throw it up. A fall, and a growth by at most
/// a factor of e in this time, are followed at once: a delay would feed oscillations. `part`: the
/// step divided by this time.
double spread_by_sound(double last, double rims, double part);

} // namespace hyoryu
