// SPDX-License-Identifier: MIT
// The keys of terrain: the ground of a case from a height grid.
#pragma once

#include "geojson.hpp"
#include "keys_names.hpp"
#include "scene/surfaces/plan_polygon.hpp"

#include "hyoryu/geometry/height_grid.hpp"

#include <algorithm>

namespace hyoryu {

/// Keys of a terrain as the user may give them; the others follow from the grid.
struct TerrainKeys {
    std::optional<std::array<double, 2>> origin;
    std::optional<std::array<double, 4>> extent;
    std::optional<double> resolution, bottom, nodata;
};

/// [[wall.level]], whose polygon is from a file or from the case.
struct LevelKeys {
    std::string polygon; // a file, or empty:
    std::vector<Vec3> corners;
    Ring ring; // of the file, in its coordinates, or of the case
    double z = 0;
};

inline void find_ring(TableReader& table, LevelKeys& level)
{
    if (table.has("polygon") == table.has("corners")) {
        table.error(table.has("polygon") ? "corners" : "",
                    table.has("polygon") ? "give either `polygon` or `corners`, not both"
                                         : "has no area: give `polygon` or `corners`");
        return;
    }
    const char* key = table.has("polygon") ? "polygon" : "corners";
    for (const Vec3& corner : level.corners) {
        level.ring.push_back({corner.x(), corner.y()});
    }
    if (table.has("polygon")) {
        const auto path = path_of_file(table, "polygon", level.polygon);
        if (!path) {
            return;
        }
        try {
            level.ring = read_polygon(*path);
        } catch (const IoError& error) {
            table.error("polygon", error.what(), "a GeoJSON file of one polygon");
            return;
        }
    }
    if (const std::string fault = outline_fault({level.ring}); table.sound(key) && !fault.empty()) {
        table.error(key, "does not outline an area: " + fault,
                    "the corners of one polygon, one after the other along its edge");
    }
}

void keys_of(auto& keys, Is<LevelKeys> auto& level)
{
    if (keys.shows(!level.polygon.empty())) {
        keys.text("polygon", level.polygon,
                  "GeoJSON file of the area, relative to the case file, in the coordinates of the "
                  "terrain.");
    }
    constexpr int fewest = 3;
    keys.path("corners", level.corners, "m",
              "Corners of the area in the axes of the case, instead of a file, [x, y, z] each; z "
              "is ignored.",
              no_default, fewest);
    keys.number("z", level.z, "m", "z of the ground within the area, in the axes of the case.",
                required);
    keys.rule(find_ring, level);
}

/// Areas of the terrain in the axes of the case.
inline void place_levels(TableReader& table, const std::vector<LevelKeys>& levels,
                         TerrainPatch& patch)
{
    for (const LevelKeys& level : levels) {
        Ring ring = level.ring;
        if (!level.polygon.empty() && !ring.empty() && may_be_degrees(ring) &&
            !may_be_degrees({{patch.origin[0], patch.origin[1]}})) {
            table.error("level",
                        "the coordinates look like degrees, those of the terrain are in "
                        "metres",
                        "project them to the map of the terrain, for instance to UTM");
        }
        if (!level.polygon.empty()) {
            into_axes_of(patch, ring);
        }
        patch.levels.push_back({std::move(ring), level.z});
    }
}

/// Notes areas between the points of the surface, which would change none of them.
inline void check_levels(TableReader& table, const TerrainPatch& patch)
{
    for (std::size_t k = 0; k < patch.levels.size(); ++k) {
        const Ring& corners = patch.levels[k].corners;
        if (!corners.empty() && points_within(patch, corners) == 0) {
            table.error("level",
                        fmt::format("number {} contains no point of the surface, whose points are "
                                    "{:.4g} m apart",
                                    k + 1, patch.resolution),
                        "give a smaller `resolution`, or an area within `extent`");
        }
    }
}

inline void find_extent(TableReader& table, const HeightGrid& grid, const TerrainKeys& given,
                        TerrainPatch& patch)
{
    const auto covered = covered_extent(grid, patch);
    if (given.extent) {
        patch.extent = *given.extent;
        if (!(patch.extent[2] > patch.extent[0]) || !(patch.extent[3] > patch.extent[1])) {
            table.error("extent",
                        "expected [x_min, y_min, x_max, y_max] with each minimum below "
                        "its maximum",
                        "the axes are those of the scene, whose zero is `origin`");
        }
    } else if (covered) {
        patch.extent = *covered;
    } else {
        table.error("extent", "is missing: it is required unless `azimuth_deg` is a multiple of 90",
                    "give [x_min, y_min, x_max, y_max] in the axes of the scene");
    }
}

inline void check_heights(TableReader& table, const HeightGrid& grid, const TerrainPatch& patch,
                          const std::vector<double>& heights)
{
    const auto is_missing = [](double z) { return std::isnan(z); };
    const auto first = std::ranges::find_if(heights, is_missing);
    if (first == heights.end()) {
        return;
    }
    const auto number = static_cast<Index>(first - heights.begin());
    const Index columns = lattice_cells(patch)[0] + 1;
    const double x = patch.extent[0] + static_cast<double>(number % columns) *
                                           (patch.extent[2] - patch.extent[0]) /
                                           static_cast<double>(columns - 1);
    const Index row = number / columns;
    const double y = patch.extent[1] + static_cast<double>(row) *
                                           (patch.extent[3] - patch.extent[1]) /
                                           static_cast<double>(lattice_cells(patch)[1]);
    const auto last = [&](std::size_t axis, Index count) {
        return grid.first[axis] + static_cast<double>(count - 1) * grid.cell[axis];
    };
    table.error(table.has("extent") ? "extent" : "file",
                fmt::format("the grid has no height at {} of {} points of the surface, first at "
                            "({:.6g}, {:.6g}) m; it covers eastings {:.9g} to {:.9g} and northings "
                            "{:.9g} to {:.9g}",
                            std::ranges::count_if(heights, is_missing), heights.size(), x, y,
                            grid.first[0], last(0, grid.columns), grid.first[1],
                            last(1, grid.rows)),
                "reduce `extent`, or give `nodata`, the height to use where the grid has none");
}

inline void find_bottom(TableReader& table, const TerrainKeys& given, double lowest,
                        TerrainPatch& patch)
{
    constexpr double share = 0.05; // of the width: thick enough for any body that sinks into it
    const double width =
        std::max(patch.extent[2] - patch.extent[0], patch.extent[3] - patch.extent[1]);
    patch.bottom = given.bottom.value_or(lowest - share * width);
    if (!(patch.bottom < lowest)) {
        table.error(
            "bottom", fmt::format("must be below the lowest ground, which is at {:.6g} m", lowest),
            "lower it, or leave it out; it is in the axes of the scene, as `datum` moves it");
    }
}

/// Reads the grid and makes the closed surface of the ground; fills in what follows from the grid.
inline void load_terrain(TableReader& table, const TerrainKeys& given,
                         const std::vector<LevelKeys>& levels, double spacing,
                         const std::string& name, TerrainPatch& patch, Mesh& mesh)
{
    const auto path = path_of_file(table, "file", name);
    if (refuse_flat(table, "shape", "terrain is") || !path || table.mistaken()) {
        return;
    }
    try {
        const HeightGrid grid = read_height_grid(*path, given.nodata);
        patch.nodata = given.nodata;
        patch.origin = given.origin.value_or(grid.first);
        patch.resolution =
            given.resolution.value_or(std::max({grid.cell[0], grid.cell[1], spacing}));
        const std::size_t before = table.reading().diagnostics.size();
        find_extent(table, grid, given, patch);
        if (table.reading().diagnostics.size() > before) {
            return;
        }
        constexpr double most_points = 2e7;
        const double points = (patch.extent[2] - patch.extent[0]) / patch.resolution *
                              (patch.extent[3] - patch.extent[1]) / patch.resolution;
        if (!(points < most_points)) {
            table.error("resolution",
                        fmt::format("gives about {:.2g} points of the surface, at "
                                    "most {:.0g} are supported",
                                    points, most_points),
                        "increase it, or cut out less with `extent`");
            return;
        }
        place_levels(table, levels, patch);
        check_levels(table, patch);
        const std::vector<double> heights = sample_heights(grid, patch);
        check_heights(table, grid, patch, heights);
        if (table.reading().diagnostics.size() == before) {
            find_bottom(table, given, *std::ranges::min_element(heights), patch);
        }
        if (table.reading().diagnostics.size() == before) {
            mesh = terrain_mesh(patch, heights);
        }
    } catch (const IoError& error) {
        table.error(
            "file", error.what(),
            "expected heights in m as an ESRI ASCII grid, as points x y z on a grid, or as a "
            "GeoTIFF");
    }
}

inline void finish_terrain(TableReader& table, const TerrainKeys& given,
                           const std::vector<LevelKeys>& levels, double spacing, MeshShape& shape)
{
    Mesh mesh;
    load_terrain(table, given, levels, spacing, shape.file, *shape.terrain, mesh);
    shape.corners = std::move(mesh.corners);
    shape.triangles = std::move(mesh.triangles);
    if (!shape.file.empty()) {
        const auto folder = table.reading().file.parent_path();
        shape.file = std::filesystem::absolute(folder / shape.file).lexically_normal().string();
    }
}

/// The ground from a height grid; `shape.terrain` is there.
void terrain_keys(auto& keys, Is<MeshShape> auto& shape, TerrainKeys& given,
                  std::string_view of_file)
{
    auto& patch = *shape.terrain;
    if (keys.writes) {
        given = {patch.origin, patch.extent, patch.resolution, patch.bottom, patch.nodata};
    }
    keys.text("file", shape.file, of_file, needed);
    keys.numbers("origin", given.origin, "m",
                 "Easting and northing in the grid that become x = y = 0.",
                 "the south-western centre of the grid");
    keys.number("azimuth_deg", patch.azimuth_deg, "deg",
                "Direction of the x axis of the case, clockwise from north: 90 is east.");
    keys.number("datum", patch.datum, "m", "Offset that is added to the heights of the grid.");
    keys.numbers("extent", given.extent, "m",
                 "Part of the ground in the axes of the case: [x_min, y_min, x_max, y_max].",
                 "the whole grid if azimuth_deg is a multiple of 90, else required");
    keys.positive(
        "resolution", given.resolution, "m",
        "Longest edge of the cells of the surface. If the surface is coarser than the grid, its "
        "heights are means of the grid heights; if it is finer, they are interpolated.",
        "the larger of the cells of the grid and particles.spacing");
    keys.number("bottom", given.bottom, "m",
                "z of the lower side of the ground, which is a solid, or of a prism.",
                "a twentieth of the width below the lowest ground");
    keys.number(
        "nodata", given.nodata, "m",
        "Height to use where the grid has none; without this key such places are an error.");
}

} // namespace hyoryu
