// SPDX-License-Identifier: MIT
// `read_mesh` and `render` of the program: found in the VTK module, which stands beside the
// program or in ../lib/hyoryu.
#include "build_info.hpp"
#include "vtk/module.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <dlfcn.h>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "libhyoryu_vtk.so";

void* open_vtk_module()
{
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    for (const fs::path& folder : {program, program.parent_path() / "lib" / "hyoryu"}) {
        if (fs::exists(folder / file_name)) {
            void* module = dlopen((folder / file_name).c_str(), RTLD_NOW | RTLD_LOCAL);
            if (module == nullptr) {
                throw IoError(fmt::format("cannot load {}: {}", file_name, dlerror()));
            }
            return module;
        }
    }
    throw IoError(build_info::vtk == "ON"
                      ? fmt::format("meshes and pictures need {}, which is not installed: on "
                                    "Debian it is in the package hyoryu-vtk",
                                    file_name)
                      : std::string("meshes and pictures need VTK, and this program was built "
                                    "without it (HYORYU_VTK=OFF)"));
}

template <class Function>
Function module_function(const char* name)
{
    void* found = dlsym(open_vtk_module(), name); // dlopen counts: opening again is free
    if (found == nullptr) {
        throw IoError(fmt::format("{} belongs to another version of the program", file_name));
    }
    return reinterpret_cast<Function>(found);
}

} // namespace

Mesh read_mesh(const fs::path& file, double scale)
{
    Mesh mesh;
    module_function<vtk_module::ReadMesh>(vtk_module::read_mesh_name)(file, scale, mesh);
    return mesh;
}

RenderResult render(const fs::path& results, const RenderSettings& settings)
{
    RenderResult result;
    module_function<vtk_module::Render>(vtk_module::render_name)(results, settings, result);
    return result;
}

} // namespace hyoryu
