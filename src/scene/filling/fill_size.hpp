// SPDX-License-Identifier: MIT
// How many particles a scene asks for, before any is made.
#pragma once

#include "hyoryu/scene/scene.hpp"

namespace hyoryu {

/// About how many particles filling the scene makes; may be infinite.
double particles_asked(const Scene& scene);

/// Throws CaseError, naming the estimate, if the particles could not be numbered or the memory of
/// this machine could not hold the part of them that is on it.
void check_size(const Scene& scene, double part);

} // namespace hyoryu
