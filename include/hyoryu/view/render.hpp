// SPDX-License-Identifier: MIT
// Rendering of a results folder, off-screen. The frames of fluid, bodies and walls become pictures
// and an animation; the camera frames the scene by default. Only this layer and `vtk` use VTK.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

struct RenderSettings {
    int width = 1280;
    int height = 720;
    std::string colour = "Velocity";   // array of the fluid that is shown in colour
    std::optional<double> azimuth_deg; // camera: from where; none: chosen from the scene
    std::optional<double> elevation_deg;
    std::vector<double> times; // of the pictures [s]; empty: every frame
    int fps = 25;              // of the animation
};

/// The files that were made.
struct RenderResult {
    std::vector<std::filesystem::path> pictures;
    std::optional<std::filesystem::path> animation; // none without ffmpeg or with one frame
    std::string note;                               // the reason if there is no animation
    int removed = 0;                                // files of earlier calls, the animation too
};

/// Renders the frames of `results` to `results/pictures/`, replacing the pictures there. Fluid
/// particles are spheres in the colour of their speed (or of `colour`), bodies their surfaces or,
/// without `surfaces.hdf.series`, their particles. `structures.hdf`, or where walls move
/// `structures.hdf.series`, is drawn as solid geometry whose triangles, seen from the free space,
/// turn counter-clockwise: back faces are culled, so that one looks into a tank; without it, wall
/// particles that hide nothing are drawn. Throws IoError when there is nothing to render, when no
/// off-screen context can be had (the message names xvfb-run), or in a build without VTK.
RenderResult render(const std::filesystem::path& results, const RenderSettings& settings);

} // namespace hyoryu
