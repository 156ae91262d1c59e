// SPDX-License-Identifier: MIT
// Functions shared by the parts of open sides: the flow of a lane, its velocity and density.
#pragma once

#include "hyoryu/fluid/open_boundary.hpp"

namespace hyoryu {

/// Less water than this is dry: nothing is emitted [spacings].
inline constexpr real least_rows = 1.5;

/// The flow of the station of a lane, of the nearest one beside the window.
const StationFlow& station_of(const Carpet& carpet, int lane);

/// Velocity of the carpet into the domain at a height [m/s].
real speed_at(const Carpet& carpet, const StationFlow& flow, real bed, real z);

/// Density of water at rest below a level, rho0 above it [kg/m3].
real density_at(const FluidParameters& f, real level, real z);

} // namespace hyoryu
