// SPDX-License-Identifier: MIT
#include "ground_report.hpp"

#include "hyoryu/geometry/surface_check.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

std::string lines_of(const std::string& name, const MeshShape& mesh)
{
    const TerrainPatch& patch = *mesh.terrain;
    const HeightGrid grid = read_height_grid(mesh.file, patch.nodata);
    const SurfaceCheck check = check_surface(grid, patch, sample_heights(grid, patch));
    std::string text = fmt::format(
        "  ground \"{}\"\n"
        "    window                 x {:.6g} to {:.6g} m, y {:.6g} to {:.6g} m\n"
        "    surface                {} x {} cells of {:.4g} m, z {:.4g} to {:.4g} m\n"
        "    grid minus surface     rms {:.3g} m, largest {:.3g} m at ({:.6g}, {:.6g}) m, of {} "
        "heights\n",
        name, patch.extent[0], patch.extent[2], patch.extent[1], patch.extent[3], check.cells[0],
        check.cells[1], patch.resolution, check.lowest, check.highest, check.rms, check.largest,
        check.at[0], check.at[1], check.compared);
    text += fmt::format("    steeper than 45 deg    {} cells", check.steep);
    if (check.steep > 0) {
        text +=
            fmt::format("; a step of {:.3g} m lies within one cell at ({:.6g}, {:.6g}) m: if it "
                        "is a quay, give it as `wall.level`",
                        check.step, check.step_at[0], check.step_at[1]);
    }
    return text + '\n';
}

} // namespace

std::string ground_text(const Scene& scene)
{
    std::string text;
    for (const Wall& wall : scene.walls) {
        const auto* solid = std::get_if<SolidWall>(&wall.geometry);
        const auto* mesh = solid != nullptr ? std::get_if<MeshShape>(&solid->shape) : nullptr;
        if (mesh != nullptr && mesh->terrain) {
            text += lines_of(wall.name, *mesh);
        }
    }
    return text;
}

} // namespace hyoryu
