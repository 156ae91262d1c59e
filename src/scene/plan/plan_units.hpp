// SPDX-License-Identifier: MIT
// Numbers that look as if they were given in another unit.
#pragma once

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Refuses densities of the fluid and of bodies that are below any gas: energies would not be
/// numbers.
void check_densities(const Scene& scene, std::vector<Diagnostic>& errors);

/// Warns of densities that look like ratios or like g/m3, friction coefficients that look like
/// angles, sound speeds of real water and spacings larger than the water.
void warn_about_units(const Scene& scene, Plan& plan);

} // namespace hyoryu
