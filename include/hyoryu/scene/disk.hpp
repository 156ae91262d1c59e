// SPDX-License-Identifier: MIT
// Predicted size of the results of a run on disk.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// The expected course of a run, as far as the size of its results depends on it.
struct Course {
    double steps = 0; // of the whole run
    double fluid = 1; // share of the fluid particles that a frame holds, on average over them [1]
    double fluid_end = 1; // and at the end [1]
    double impacts = 0;   // rows of contacts.csv of kind impact, over the whole run
};

/// Bytes of all files of the results folder at the end of a run: frames as they are compressed,
/// histories, results.h5, checkpoints. Each file is its numbers plus the overhead of HDF5. Each
/// body that can touch something is assumed to rest on one other in every frame; the number of
/// impacts follows from the course. Measured on 70 shipped cases and 38 drawn coasts; see the
/// constants.
double disk_bytes(const Scene& scene, const Plan& plan, const Course& course);

} // namespace hyoryu
