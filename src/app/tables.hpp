// SPDX-License-Identifier: MIT
// The columns of the histories, and contacts as plain numbers.
#pragma once

#include "hyoryu/core/snapshot.hpp"
#include "hyoryu/rigid/rigid.hpp"
#include "hyoryu/scene/scene.hpp"

#include <span>
#include <vector>

namespace hyoryu {

// Units say it where two dimensions mean per metre of width.
Table bodies_table(int dimensions);
Table contacts_table(int dimensions);
/// ranks.csv: what each process of a shared run does, since the start of the program.
Table ranks_table();
/// energy.csv; with open sides also their energy and impulse.
Table energy_table(const Scene& scene);
/// open.csv: level, velocity and discharge of each open side, and the volumes that have passed it.
Table open_table(const Scene& scene);
Table gauges_table(std::vector<Table::Head> gauges);

} // namespace hyoryu
