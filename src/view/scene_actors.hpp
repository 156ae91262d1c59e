// SPDX-License-Identifier: MIT
// Fluid, bodies, structures and labels as VTK actors.
#pragma once

#include "moments.hpp"

#include <vtkActor.h>
#include <vtkColorTransferFunction.h>
#include <vtkScalarBarActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <string>

namespace hyoryu {

using Actor = vtkSmartPointer<vtkActor>;

/// From still (deep blue) over cyan to fast (the white of foam).
vtkSmartPointer<vtkColorTransferFunction> water_colours(double from, double to);

/// Particles as shaded spheres of the given radius [m] in the colours of `values`.
Actor fluid_actor(const Cloud& cloud, const std::vector<float>& values, double radius,
                  vtkColorTransferFunction& colours);
/// Particles of bodies, each body in its own tone of wood.
Actor body_particles_actor(const Cloud& cloud, double radius);
/// Wall particles, grey; those that stand outside of `inner` on the side of the camera are left
/// out.
Actor wall_particles_actor(const Cloud& cloud, double radius, const Box& inner,
                           const Vec3& to_camera);

/// Surfaces of bodies, each in its own tone of wood.
Actor bodies_actor(const Surface& surface);
/// Back faces are culled.
enum class Sides { facing_camera, all };
Actor structures_actor(const Surface& surface, Sides sides);
/// The sharp edges and the rims, all of them: they tell where the sides that are left out stand.
Actor edges_actor(const Surface& surface);

vtkSmartPointer<vtkScalarBarActor> colour_scale(vtkColorTransferFunction& colours,
                                                int picture_height);
vtkSmartPointer<vtkTextActor> scale_title(const std::string& title, int picture_height);
vtkSmartPointer<vtkTextActor> time_label(int picture_height);

} // namespace hyoryu
