// SPDX-License-Identifier: MIT
// Rasters, through the module that stands beside the program, above it, or in ../lib/hyoryu.
#include "grid_text.hpp"

#include "hyoryu/geometry/raster_module.hpp"

#include <array>

#include <dlfcn.h>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

constexpr const char* without =
    "GeoTIFF files need the module {}, which on Debian is in the package hyoryu-gis; without it, "
    "`gdal_translate -of AAIGrid FILE.tif FILE.asc` converts the file to a supported format";

void* open_module()
{
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path();
    for (const fs::path& folder :
         {program, program.parent_path(), program.parent_path() / "lib" / "hyoryu"}) {
        const fs::path module = folder / raster_module::file_name;
        if (!fs::exists(module)) {
            continue;
        }
        if (void* found = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL)) {
            return found;
        }
        throw IoError(fmt::format("cannot load {}: {}", raster_module::file_name, dlerror()));
    }
    throw IoError(fmt::format(without, raster_module::file_name));
}

} // namespace

bool is_raster(std::string_view bytes)
{
    using namespace std::string_view_literals;
    constexpr std::array marks{"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv};
    constexpr std::size_t looked_at = 512;
    const bool marked =
        std::ranges::any_of(marks, [&](std::string_view mark) { return bytes.starts_with(mark); });
    return marked || bytes.substr(0, looked_at).find('\0') != std::string_view::npos;
}

HeightGrid read_raster(const fs::path& file, double substitute)
{
    void* const found = dlsym(open_module(), raster_module::read_raster_name);
    if (found == nullptr) {
        throw IoError(
            fmt::format("{} belongs to another version of the program", raster_module::file_name));
    }
    HeightGrid grid;
    reinterpret_cast<raster_module::ReadRaster>(found)(file, substitute, grid);
    return grid;
}

} // namespace hyoryu
