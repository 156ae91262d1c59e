// SPDX-License-Identifier: MIT
// How a body floats at rest in water that is wide and deep: draft, stability, and the side that it
// turns up.
#pragma once

#include "hyoryu/scene/scene.hpp"

#include <optional>

namespace hyoryu {

/// A state of rest of a floating body.
struct Flotation {
    double draft = 0;      // of the lowest point below the water level [m]
    double metacentre = 0; // GM: least metacentric height over all axes of tilting [m]
    Vec3 up{0, 0, 1};      // the direction in body axes that points up
};

struct Floating {
    Flotation as_placed; // draft and GM in the orientation of the case, in equilibrium or not
    Flotation at_rest;   // where it turns to from there, without swinging over
    double tilt = 0;     // angle between the two [rad]
};

/// The flotation of a body in a fluid of that density, in the gravity of the scene; empty if the
/// body sinks or gravity is zero. The stable states are the minima of the height of the
/// centre of mass above the centre of buoyancy over all orientations; from the orientation of the
/// case the nearest one downhill is searched. In two dimensions it turns about y alone.
/// Source: Gilbert, SIAM Review 33 (1991) 201.
std::optional<Floating> flotation(const BodySettings& body, double fluid_density,
                                  const Vec3& gravity, int dimensions);

} // namespace hyoryu
