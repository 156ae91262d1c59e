// SPDX-License-Identifier: MIT
// Predicted memory of a run.
#pragma once

#include "hyoryu/scene/disk.hpp"

namespace hyoryu {

/// Largest resident memory of a run [B]: the program, permanent data, and the peak of temporary
/// data: frames and checkpoints being written, at the end the tables of results.h5. Needs
/// `plan.fields`. Measured on 70 shipped cases; see the constants.
double memory_bytes(const Scene& scene, const Plan& plan, const Course& course);

/// Fluid particles with which a run takes four fifths of the memory of the machine.
double fluid_in_memory(const Scene& scene, const Plan& plan);

} // namespace hyoryu
