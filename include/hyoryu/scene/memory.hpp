// SPDX-License-Identifier: MIT
// What a run will hold in memory.
#pragma once

#include "hyoryu/scene/disk.hpp"

namespace hyoryu {

/// Largest resident memory of a run [B]: the program, what lives all the time, and the most of what
/// comes and goes: frames and checkpoints on their way, at the end the tables of results.h5.
/// Needs `plan.fields`. Measured on 70 shipped cases; see the constants.
double memory_bytes(const Scene& scene, const Plan& plan, const Course& course);

} // namespace hyoryu
