// SPDX-License-Identifier: MIT
// The parts of a plan on floating bodies, waves and the scale of the scene.
#pragma once

#include "plan_facts.hpp"

#include "hyoryu/scene/plan.hpp"

namespace hyoryu {

/// Draft, GM and resting side of each body that floats; warns of drafts below the spacing and of
/// bodies that turn.
void list_floating(const Scene& scene, Plan& plan);

/// Warns of bodies that are lighter than the water and begin under it.
void check_submerged(const Scene& scene, const PlanFacts& facts, Plan& plan);

/// Resolution, shortest load, viscosity of the scheme and effective Reynolds number; warns of a
/// Reynolds number below 100.
void list_scale(const Scene& scene, const PlanFacts& facts, double viscosity, Plan& plan);

/// Warns of sponges shorter than a wave and of gates that open slowly.
void check_waves(const Scene& scene, const PlanFacts& facts, Plan& plan);

} // namespace hyoryu
