// SPDX-License-Identifier: MIT
// The inertia of the water that enters a joint while its sides part.
#pragma once

namespace hyoryu {

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

} // namespace hyoryu
