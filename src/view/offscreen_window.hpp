// SPDX-License-Identifier: MIT
// A VTK window that needs no screen.
#pragma once

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

namespace hyoryu {

/// Tries EGL without a surface, then the X server that DISPLAY names. Throws IoError if there is
/// neither: VTK itself would abort the process.
vtkSmartPointer<vtkRenderWindow> offscreen_window(int width, int height);

} // namespace hyoryu
