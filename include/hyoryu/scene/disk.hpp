// SPDX-License-Identifier: MIT
// What the results of a run will take on the disk.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// How a run is expected to go, as far as it shows in the size of its results.
struct Course {
    double steps = 0; // of the whole run
    double fluid = 1; // share of the fluid particles that a frame holds, on average over them [1]
    double fluid_end = 1; // and at the end [1]
    double impacts = 0;   // rows of contacts.csv that tell of one, over the whole run
};

/// Bytes of all files of the results folder at the end of a run: frames as they are compressed,
/// histories, results.h5, checkpoints. Each file is its numbers and what HDF5 lays around them.
/// Of bodies that may touch something each is taken to rest on one other in every frame; how often
/// they hit is for the course to say. Measured on 70 shipped cases; see the constants.
double disk_bytes(const Scene& scene, const Plan& plan, const Course& course);

} // namespace hyoryu
