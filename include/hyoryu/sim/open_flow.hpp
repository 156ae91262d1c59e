// SPDX-License-Identifier: MIT
// Open sides in a run: the flow that is asked for at each moment drives the carpets.
#pragma once

#include "hyoryu/fluid/open_boundary.hpp"
#include "hyoryu/scene/open_settings.hpp"
#include "hyoryu/sim/open_bodies.hpp"

#include <vector>

namespace hyoryu {

struct Simulation;

/// The carpets of a scene, and the still water there at the start.
struct OpenFlow {
    OpenBoundary boundary;
    std::vector<std::vector<StillWater>> still; // of each carpet, by station
    std::vector<LeftBody> left;                 // in the order in which they left
    double most = infinity;                     // rows of fluid that the run may hold
    bool runs() const { return !boundary.carpets.empty(); }
};

/// Extends the domain of the particles as far as the carpets reach; before any tiles are made.
void extend_domain(const Scene& scene, Fluid& fluid);

/// Makes the carpets of the scene with its first particles; before the first lists.
void start_open(Simulation& sim);

/// After the drift to the middle of a step: counts what crossed, and makes new lists where those
/// are due, with new columns of the carpets. Throws RoomError if the run holds too many then,
/// except at the start.
void renew_open(Simulation& sim);

/// After the kick of a step of dt: the flow at the end of the step, and the velocities of carpets.
void drive_open(Simulation& sim, double dt);

/// After the drift to the end of a step: counts what crossed, and sets the densities.
void close_open(Simulation& sim);

/// The values of an open side in a row of open.csv.
struct OpenReading {
    double level = 0;     // mean of the carpet where it is wet; of the ground where none is [m]
    double velocity = 0;  // mean into the domain [m/s]
    double discharge = 0; // into the domain now [m3/s]; m2/s in two dimensions
    double volume_in = 0, volume_out = 0; // through the plane since the start [m3]
    double volume_asked = 0;              // net, of depth x velocity [m3]
};
OpenReading reading_of(const Simulation& sim, std::size_t carpet);

} // namespace hyoryu
