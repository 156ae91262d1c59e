// SPDX-License-Identifier: MIT
// What the results of a run will take on the disk.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Bytes of all files of the results folder at the end of a run of so many steps: frames as they are
/// compressed, histories, checkpoints. Contacts are as many as will happen and are left out.
/// Measured on shipped cases; see the constants.
double disk_bytes(const Scene& scene, const Plan& plan, double steps);

} // namespace hyoryu
