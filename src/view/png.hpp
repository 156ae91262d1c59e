// SPDX-License-Identifier: MIT
// What a window shows, as the bytes of a PNG file.
#pragma once

#include <vtkRenderWindow.h>

#include <string>

namespace hyoryu {

/// The window must have been rendered. Throws IoError if VTK gives no picture.
std::string png_of(vtkRenderWindow& window);

} // namespace hyoryu
