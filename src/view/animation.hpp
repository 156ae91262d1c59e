// SPDX-License-Identifier: MIT
// Pictures to an animation by ffmpeg.
#pragma once

#include <filesystem>
#include <string>

namespace hyoryu {

/// Joins `pictures/frame_*.png` in the order of their names to `pictures/animation.mp4` (H.264).
/// Returns why it could not, or nothing: an animation is an extra, no error.
std::string animate(const std::filesystem::path& pictures, int fps);

} // namespace hyoryu
