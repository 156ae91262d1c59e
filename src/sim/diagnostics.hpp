// SPDX-License-Identifier: MIT
// What lies around the place where a run went wrong. Looked at only then, so without any search
// structure.
#pragma once

#include <cstddef>
#include <string>

namespace hyoryu {

struct Simulation;

/// Names what lies within two spacings of a particle and how near the nearest is.
std::string surroundings(const Simulation& sim, std::size_t row);

/// body "name" or wall "name", of `b` as in Contact.
std::string solid_name(const Simulation& sim, int b);

/// The two solids that overlap most, and by how much [m].
struct Overlap {
    std::string pair;
    double depth = 0;
};
Overlap deepest_overlap(const Simulation& sim);

/// The energy that all could gain by falling through the scene, and the fluid at a hundredth of its
/// speed of sound [J].
double energy_scale(const Simulation& sim);

} // namespace hyoryu
