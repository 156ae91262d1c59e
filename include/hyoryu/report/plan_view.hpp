// SPDX-License-Identifier: MIT
// Trajectories of bodies, seen from above; in two dimensions from the side.
#pragma once

#include "hyoryu/core/snapshot.hpp"

#include <array>
#include <string>
#include <vector>

namespace hyoryu {

/// The plane of the picture: x-y is looked at along z, x-z along y.
enum class View { xy, xz };
View view_of(int dimensions);

/// A stretch of an outline: x0, y0, x1, y1 in the plane of the picture [m].
using Segment = std::array<double, 4>;

/// The edges of the surface that a drawing shows: rims, edges between faces that differ by more
/// than 15 degrees, and contours (faces that look at the viewer against faces that look away). Each
/// once; edges seen end-on are left out.
std::vector<Segment> outline(const Surface& surface, View view);

/// The path of a centre of mass in the plane of the picture [m].
struct Trajectory {
    std::string body;
    std::vector<double> x, y;
};

/// A stretch of water, in the plane of the picture [m]; deeper shades for 1 than for 0.
struct WaterPatch {
    double x = 0, y = 0, width = 0, height = 0;
    double shade = 0;
};

/// The scene at one moment.
struct SceneView {
    std::vector<Segment> walls, bodies;
    std::vector<WaterPatch> water;
};

/// Plan view of the water as rows of patches: cells of `spacing`, enlarged so that the picture has
/// at most 260 cells across, shaded from above by the height of the highest point of each cell
/// between `heights`, in the x-z plane alike. `points`: x, y, z of each [m].
std::vector<WaterPatch> water_patches(const std::vector<float>& points, double spacing, View view,
                                      const std::array<double, 2>& heights);

/// One moment at one scale for both axes; `label` is for readers who cannot see it.
std::string svg_scene(const SceneView& scene, View view, const std::string& label);

/// Outline and trajectories at one scale for both axes; a ring marks each start, a dot each end,
/// and the name stands at the end if there are at most `most_names` bodies.
inline constexpr std::size_t most_names = 40;
std::string svg_plan_view(const std::vector<Segment>& outline,
                          const std::vector<Trajectory>& trajectories, View view);

} // namespace hyoryu
