// SPDX-License-Identifier: MIT
// The families of effects that exist. A new one is its file and its slot in this list.
#pragma once

#include "hyoryu/fluid/cavitation.hpp"
#include "hyoryu/fluid/collision.hpp"
#include "hyoryu/fluid/density_diffusion.hpp"
#include "hyoryu/fluid/gradient.hpp"
#include "hyoryu/fluid/no_slip.hpp"
#include "hyoryu/fluid/paired_walls.hpp"
#include "hyoryu/fluid/shifting.hpp"
#include "hyoryu/fluid/turbulence.hpp"

namespace hyoryu {

/// All slots, in the order of the manual.
using AllSlots = SlotList<GradientSlot, WallContinuitySlot, ViscositySlot, SlipSlot, DiffusionSlot,
                          ShiftingSlot, CollisionSlot, CavitationSlot>;

} // namespace hyoryu
