// SPDX-License-Identifier: MIT
// The entries of the VTK module.
#include "module.hpp"

extern "C" {

[[gnu::visibility("default")]] void hyoryu_module_read_mesh(const std::filesystem::path& file,
                                                            double scale, hyoryu::Mesh& mesh)
{
    mesh = hyoryu::read_mesh(file, scale);
}

[[gnu::visibility("default")]] void hyoryu_module_render(const std::filesystem::path& results,
                                                         const hyoryu::RenderSettings& settings,
                                                         hyoryu::RenderResult& result)
{
    result = hyoryu::render(results, settings);
}

} // extern "C"
