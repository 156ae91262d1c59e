// SPDX-License-Identifier: MIT
// The camera of the pictures: direction, and distance at which the scene fits into the picture.
#pragma once

#include "moments.hpp"

#include <vtkCamera.h>

namespace hyoryu {

/// Direction from the scene to the camera: azimuth from +x about z, elevation from the ground
/// [degrees].
Vec3 view_direction(double azimuth_deg, double elevation_deg);

/// Looks at the box from `direction` so that it just fits into the picture, in perspective.
void aim(vtkCamera& camera, const Box& box, const Vec3& direction, double aspect);
/// Looks along +y at the x-z plane, without perspective.
void aim_at_plane(vtkCamera& camera, const Box& box, double aspect);

} // namespace hyoryu
