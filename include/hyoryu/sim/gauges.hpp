// SPDX-License-Identifier: MIT
// Gauges: readings of instruments at a point, on a line, a plane or a structure.
#pragma once

#include "hyoryu/scene/gauge_columns.hpp"

#include <span>
#include <vector>

namespace hyoryu {

struct Simulation;

/// Forces on the wall or body of one force gauge.
struct GaugedForce {
    int target = 0;                // body, or -1 - wall
    Vec3 pressure{0, 0, 0};        // by the fluid in the last step, and by films [N]
    Vec3 viscous{0, 0, 0};         // by the fluid in the last step [N]
    Vec3 fluid_impulse{0, 0, 0};   // of both since the start [N s]
    Vec3 contact_impulse{0, 0, 0}; // of bodies and walls since the start [N s]
    Vec3 contact_at_row{0, 0, 0};  // the same at the row before [N s]
};

/// The samples that the filter of one column still sees. The exponential mean keeps two, both of
/// the last reading that is a number: itself, and the sum of the weights in it [1].
struct FilterMemory {
    GaugeFilter filter = GaugeFilter::none;
    double window = 0;          // [s]
    std::vector<double> times;  // [s]
    std::vector<double> values; // in the unit of the column
};

/// State of the gauges. Empty in a scene without gauges; the forces also without force gauges.
struct GaugeMemory {
    double last_row = 0;               // time of it [s]
    std::vector<GaugedForce> forces;   // of the force gauges, in the order of the scene
    std::vector<FilterMemory> filters; // of the filtered columns, in the order of the columns
};

GaugeMemory make_gauge_memory(const Scene& scene);

/// Columns of `gauges.csv` behind the time.
std::vector<Table::Head> gauge_heads(const Scene& scene);

/// Adds the impulses of fluid and contact in the present step of length dt to the force gauges.
/// Called between the step of the bodies and the new viscous forces.
void book_forces(Simulation& sim, double dt);

/// Raw readings, gauge after gauge. elevation: height at which the fluid fills half of the kernel
/// volume outside solids, NaN where there is none; pressure: kernel average of p + rho g . (x -
/// x_f) over the fluid about each point of the face, as walls take it over (Adami, Hu & Adams 2012,
/// eq. 27), at least 0, the pressure of the air; velocity: kernel average, NaN if dry; front:
/// farthest place of the fluid along the axis; flux: sum of V v.n over the fluid, weighted with its
/// distance from the plane by a hat of half width 2 dp, which is the exact flux of a uniform stream
/// on a lattice. Called by all ranks, which send their terms to rank 0: only there are the readings
/// of the fluid valid.
std::vector<double> read_gauges(const Simulation& sim);

/// The next row of `gauges.csv` behind the time: raw and filtered readings. Mean and median are of
/// the rows in the window; the exponential mean is of all rows so far, each weighted with
/// exp(-age/window) over the time since the row before, and so that of time 0 with nothing. No
/// filter counts rows that are NaN, nor the force at time 0, which no step has computed: its
/// filtered reading is the raw one. Called by all ranks, for rank 0.
std::vector<double> next_gauge_row(Simulation& sim);

} // namespace hyoryu
