// SPDX-License-Identifier: MIT
// Interface of the VTK module, which the program loads when it is first needed: linking VTK's 80
// shared libraries would cost every start of the program more than the rest of its start-up.
#pragma once

#include "hyoryu/geometry/mesh.hpp"
#include "hyoryu/view/render.hpp"

namespace hyoryu::vtk_module {

// Exceptions pass through: program and module are of one build.
using ReadMesh = void (*)(const std::filesystem::path& file, double scale, Mesh& mesh);
using Render = void (*)(const std::filesystem::path& results, const RenderSettings& settings,
                        RenderResult& result);
inline constexpr const char* read_mesh_name = "hyoryu_module_read_mesh";
inline constexpr const char* render_name = "hyoryu_module_render";

} // namespace hyoryu::vtk_module
