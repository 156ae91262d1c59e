// SPDX-License-Identifier: MIT
// The columns of gauges.csv.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/scene/scene.hpp"

#include <vector>

namespace hyoryu {

/// Columns of the raw readings of one gauge. A vector has three, NAME_x, NAME_y, NAME_z. A force
/// gauge has the force of the fluid alone (NAME), its parts by pressure and viscosity
/// (NAME_pressure, NAME_viscous), the contact impulse since the row before over the time since then
/// (NAME_contact: a force only of contact that lasts; of a blow it depends on the time between
/// rows), and the impulses of fluid and contact since the start (NAME_fluid_impulse,
/// NAME_contact_impulse).
std::vector<Table::Head> raw_columns(const Gauge& gauge, int dimensions);

/// Number of leading raw columns that a filter sees: all of them, or the force of the fluid.
std::size_t filtered_columns(const Gauge& gauge);

/// Raw columns, then those of the filter if there is one: NAME_mean, NAME_x_median ...
std::vector<Table::Head> gauge_columns(const Gauge& gauge, int dimensions);

} // namespace hyoryu
