// SPDX-License-Identifier: MIT
// Diagnostics of an unstable run: particles and solids near the failure. Called only once,
// therefore without a search structure.
#pragma once

#include <cstddef>
#include <string>

namespace hyoryu {

struct Simulation;

/// Text with the owners of the particles within two spacings of a particle and the distance of the
/// nearest.
std::string nearby_particles(const Simulation& sim, std::size_t row);

/// body "name" or wall "name", of `b` as in Contact.
std::string solid_name(const Simulation& sim, int b);

/// The two solids that overlap most, of which one at least may move, and by how much [m].
struct Overlap {
    std::string pair;
    double depth = 0;
};
Overlap deepest_overlap(const Simulation& sim);

/// The potential energy of a fall of all masses through the scene, plus the kinetic energy of the
/// fluid at a hundredth of its speed of sound [J].
double energy_scale(const Simulation& sim);

} // namespace hyoryu
