// SPDX-License-Identifier: MIT
#include "hyoryu/scene/memory.hpp"

#include "hyoryu/scene/machine_memory.hpp"

#include "disk_histories.hpp"
#include "hyoryu/scene/moving_walls.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Resident memory of the program with its libraries in the smallest run, measured with one box, 6.4
// MB more with the shared HDF5; of VTK, which reads meshes, and of GDAL, which reads GeoTIFF [B].
constexpr double process = 17.2e6;
constexpr double mesh_reader = 31e6;
constexpr double map_reader = 38e6;

// Memory of a particle besides its columns: pair records, ids and owners, positions at the last
// build, cells [B].
constexpr double of_particle = 64 + 24 + 16 + 12;

// Output memory of a fluid particle: two queued frames, and the largest array of the state, which
// is copied for a checkpoint [B].
constexpr double on_its_way = 2 * 62 + 24;

// Output memory of a solid particle [B]: in a frame that is written once, its number, cell and
// initial place; in frames of moving solids, two queued frames and the tiles for list making.
constexpr double drawn_once = 100;
constexpr double drawn_always = 2 * 62 + 30;

// A body with its shape, contacts, place in the broad phase, surface in frames and text in the
// case, as heaps of 2,000 boxes have it [B].
constexpr double of_body = 6e3;

// A table on its way into results.h5 beside its text: numbers grow in steps of two, texts are
// objects of 32 bytes, each line has a view of 16 [B].
constexpr double number = 1.5 * 8;
constexpr double text = 1.5 * 32;
constexpr double line = 16;

// Memory for results.h5 at the end of a run: its image, and the largest table as text and numbers.
double closing(const std::vector<HistorySize>& tables)
{
    double most = 0;
    double image = 0;
    for (const HistorySize& table : tables) {
        const double row = table.row_text + line + number * (table.active + table.idle) +
                           text * table.text_columns;
        most = std::max(most, table.rows * row);
        image += 8 * table.rows * (table.active + table.idle) + table.rows * table.names;
    }
    return most + image;
}

// Terrains and prisms are meshes as well, but the program makes them itself.
bool is_mesh_file(const Shape& shape)
{
    const auto* mesh = std::get_if<MeshShape>(&shape);
    return mesh != nullptr && !mesh->terrain && !mesh->prism;
}

// By its name: the content of the file is not known any more.
bool is_geotiff(const Shape& shape)
{
    const auto* mesh = std::get_if<MeshShape>(&shape);
    const auto is_of = [&](std::string_view ending) { return mesh->file.ends_with(ending); };
    return mesh != nullptr && mesh->terrain &&
           (is_of(".tif") || is_of(".tiff") || is_of(".TIF") || is_of(".TIFF"));
}

bool any_wall(const Scene& scene, bool (*is)(const Shape&))
{
    return std::ranges::any_of(scene.walls, [&](const Wall& wall) {
        const auto* solid = std::get_if<SolidWall>(&wall.geometry);
        return solid != nullptr && is(solid->shape);
    });
}

// Of the libraries that read the files of a scene [B].
double readers(const Scene& scene)
{
    const bool meshes = any_wall(scene, is_mesh_file) ||
                        std::ranges::any_of(scene.bodies, is_mesh_file, &BodySettings::shape);
    return (meshes ? mesh_reader : 0) + (any_wall(scene, is_geotiff) ? map_reader : 0);
}

} // namespace

double memory_bytes(const Scene& scene, const Plan& plan, const Course& course)
{
    const auto entering =
        static_cast<double>(std::max<Index>(plan.most_fluid - plan.counts.fluid, 0));
    const auto n = static_cast<double>(plan.counts.particles()) + entering;
    const auto fluid = static_cast<double>(plan.counts.fluid) + entering;
    const auto wall = static_cast<double>(plan.counts.wall);
    const auto drawn = static_cast<double>(plan.counts.drawn);
    double lasting = process + readers(scene);
    for (const Plan::FieldUse& field : plan.fields) {
        lasting += static_cast<double>(field.bytes()) +
                   entering * static_cast<double>(field.bytes_per_particle);
    }
    // As if water came to all walls: those that stay dry have no columns and records.
    lasting += n * of_particle + of_body * static_cast<double>(plan.counts.bodies);
    if (plan.fluid) {
        // The lists of solid rows are short.
        lasting += fluid * list_bytes(*plan.fluid);
    }
    const bool moving = has_moving_walls(scene);
    const double at_start = drawn_once * (wall + drawn);
    const double between = on_its_way * fluid + drawn_always * (drawn + (moving ? wall : 0));
    const double at_end = closing(histories(scene, plan, course));
    return lasting + std::max({at_start, between, at_end});
}

double fluid_in_memory(const Scene& scene, const Plan& plan)
{
    constexpr double share = 0.8;
    constexpr Index many = 1000000;
    Plan larger = plan;
    larger.most_fluid = plan.counts.fluid;
    const Course course{.steps = plan.expected_steps};
    const double start = memory_bytes(scene, larger, course);
    larger.most_fluid += many;
    const double each = (memory_bytes(scene, larger, course) - start) / many;
    return static_cast<double>(plan.counts.fluid) +
           std::max(share * machine_memory() - start, 0.0) / each;
}

} // namespace hyoryu
