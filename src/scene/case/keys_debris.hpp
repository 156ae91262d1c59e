// SPDX-License-Identifier: MIT
// The keys of debris: pieces of the library in arrays, stacks, or scattered over a yard.
#pragma once

#include "geojson.hpp"
#include "keys_bodies.hpp"
#include "keys_walls.hpp"
#include "place_debris.hpp"

#include "hyoryu/scene/reader_hint.hpp"

namespace hyoryu {

inline std::vector<std::string_view> debris_names()
{
    std::vector<std::string_view> names;
    for (const DebrisKind& kind : debris_library()) {
        names.push_back(kind.name);
    }
    return names;
}

inline void check_state(TableReader& table, const DebrisKeys& debris)
{
    const DebrisKind& kind = debris_library()[debris.load.kind];
    const auto known = std::ranges::find(kind.masses, debris.load.state, &DebrisNumber::name);
    if (table.sound("state") && known == kind.masses.end()) {
        std::vector<std::string_view> states;
        for (const DebrisNumber& mass : kind.masses) {
            states.push_back(mass.name);
        }
        table.error("state", fmt::format("a {} has no state \"{}\"", kind.name, debris.load.state),
                    "there is " + quoted_list(states) + "; `load` sets any cargo");
    }
    if (debris.load.load > 0 && kind.shape == DebrisShape::lying_cylinder) {
        table.error("load", fmt::format("a {} has no interior", kind.name));
    }
    const bool laden = debris.load.load > 0 ||
                       (known != kind.masses.end() && known->value > kind.masses.front().value);
    if (table.has("load_height") && !table.has("load") && !laden) {
        table.error("load_height", "has no meaning without cargo", "give its mass as `load`");
    }
    const bool open = kind.size.value.empty();
    if (open != table.has("size")) {
        table.error("size",
                    open ? "is missing: a tank has the size of the case"
                         : fmt::format("has no meaning, a {} has a size of its own", kind.name),
                    "[diameter, height] in m");
    }
}

inline void check_sizes(TableReader& table, const DebrisKeys& debris)
{
    for (std::size_t k = 0; debris.size && k < debris.size->size(); ++k) {
        if (!((*debris.size)[k] > 0)) {
            table.error_at("size", k, "must be above 0");
        }
    }
}

/// Reads the yard of a file into the axes of the scene; false if it is mistaken, which is noted.
inline bool load_polygon(TableReader& table, DebrisScatter& scatter, const std::string& file,
                         const Scene& scene)
{
    const auto path = path_of_file(table, "polygon", file);
    if (!path) {
        return false;
    }
    try {
        scatter.polygon = read_polygon(*path);
    } catch (const IoError& error) {
        table.error("polygon", error.what(), "a GeoJSON file of one polygon");
        return false;
    }
    const auto terrain = std::ranges::find_if(scene.walls, is_terrain);
    if (terrain == scene.walls.end()) {
        return true;
    }
    const Shape& shape = std::get<SolidWall>(terrain->geometry).shape;
    const TerrainPatch& patch = *std::get<MeshShape>(shape).terrain;
    if (may_be_degrees(scatter.polygon) && !may_be_degrees({{patch.origin[0], patch.origin[1]}})) {
        table.error("polygon",
                    fmt::format("{}: its coordinates look like degrees, those of the terrain are "
                                "in metres",
                                path->string()),
                    "project them to the map of the terrain, for instance to UTM");
        return false;
    }
    into_axes_of(patch, scatter.polygon);
    return true;
}

inline void find_polygon(TableReader& table, DebrisScatter& scatter, const std::string& file,
                         const std::vector<Vec3>& corners, const Scene& scene)
{
    if (table.has("polygon") == table.has("corners")) {
        table.error(table.has("polygon") ? "corners" : "",
                    table.has("polygon") ? "give either `polygon` or `corners`, not both"
                                         : "has no yard: give `polygon` or `corners`");
        return;
    }
    for (const Vec3& corner : corners) {
        scatter.polygon.push_back({corner.x(), corner.y()});
    }
    const char* key = table.has("polygon") ? "polygon" : "corners";
    if (!table.sound(key) || (table.has("polygon") && !load_polygon(table, scatter, file, scene))) {
        return;
    }
    const std::string fault = fault_of_yard(scatter.polygon);
    if (!fault.empty()) {
        table.error(key, fault, "the corners of one polygon, one after the other along its edge");
    }
}

inline void place(TableReader& table, DebrisKeys& debris, Scene& scene)
{
    const bool arrayed = debris.array.has_value();
    const bool scattered = debris.scatter.has_value();
    table.reading().names_known = table.reading().places_known();
    if (arrayed == scattered && !table.mistaken({"array", "scatter"})) {
        table.error(arrayed ? "scatter" : "", arrayed
                                                  ? "give either `array` or `scatter`, not both"
                                                  : "has no position: give `array` or `scatter`");
        return;
    }
    if (!table.reading().names_known) {
        return; // walls or numbers are mistaken: no place follows from them
    }
    const std::vector<PlaceFault> faults = place_debris(debris, scene);
    for (const PlaceFault& fault : faults) {
        table.error(arrayed ? "array" : "scatter", fault.what, fault.hint);
    }
    for (auto k = scene.bodies.size() - debris.placed; k < scene.bodies.size(); ++k) {
        claim_name(table, scene.bodies[k].name);
    }
}

inline void check_array_count(TableReader& table, const DebrisArray& array)
{
    constexpr std::int64_t most = 10000;
    if (array.count[0] * array.count[1] * array.count[2] > most) {
        table.error("count", fmt::format("defines more than {} pieces", most),
                    "use fewer pieces, or several cases");
    }
    if (table.reading().dimensions == 2 && array.count[1] > 1) {
        table.warn("count",
                   fmt::format("has {} rows along y, of which a case of two dimensions takes the "
                               "first",
                               array.count[1]),
                   "write 1 there");
    }
}

inline void check_height(TableReader& table, const DebrisArray& array)
{
    if (!array.on.empty() && table.count("from") > 2) {
        table.error("from", "has a height, which `on` sets", "write [x, y], or omit `on`");
    }
}

void keys_of(auto& keys, Is<DebrisArray> auto& array)
{
    constexpr double most = 1000;
    keys.integer("count", array.count, 1, most, "1 .. 1000", "Number of pieces along x, y and z.",
                 required);
    keys.vector("pitch", array.pitch, "m",
                "Distance from one piece to the next along x, y and z; 0 along z stacks them.",
                required);
    keys.vector("from", array.from, "m",
                "Position of the centre of the first piece: x, y and, without `on`, z.", required,
                2);
    keys.rule(check_array_count, array);
    keys.number("turn_deg", array.turn_deg, "deg", "Rotation of every piece about z, in 3-D.");
    keys.text("on", array.on,
              "Support of the pieces. \"ground\": every piece is placed on the walls, with its "
              "lowest corner 1 mm above them; the name of a wall: every piece is placed on that "
              "wall. Upper pieces of a stack keep their pitch.");
    keys.rule(check_height, array);
}

void keys_of(auto& keys, Is<DebrisScatter> auto& scatter, auto& scene)
{
    constexpr double most = 10000;
    std::string file;
    std::vector<Vec3> corners;
    keys.text("polygon", file,
              "GeoJSON file of the yard, relative to the case file, in the coordinates of the "
              "terrain if the case has a terrain.");
    keys.path("corners", corners, "m",
              "Corners of the yard, instead of a file, [x, y, z] each; z is ignored.", no_default);
    keys.integer("count", scatter.count, 1, most, "1 .. 10000", "Number of pieces.", required);
    keys.not_negative("gap", scatter.gap, "m", "Minimum distance between two pieces.");
    keys.numbers(
        "turn_deg", scatter.turn_deg, "deg",
        "Minimum and maximum rotation about z; the rotation of each piece is between them.",
        "[0.0, 360.0]");
    keys.text("on", scatter.on,
              "Name of the wall on which the pieces lie, or \"ground\" for all walls.", "ground");
    keys.rule(find_polygon, scatter, file, corners, scene);
}

void keys_of(auto& keys, Is<DebrisKeys> auto& debris, auto& scene)
{
    keys.choice("kind", debris.load.kind, debris_names(),
                "Kind of debris from the library; `hyoryu describe debris` lists sizes, masses and "
                "sources.",
                required);
    keys.rule(number_name, "debris", debris.name);
    keys.text("name", debris.name, "Name of the group; its pieces are named NAME.1, NAME.2 ...",
              "debris.1, debris.2 ...");
    keys.rule(check_name, "name", debris.name);
    keys.text("state", debris.load.state,
              "State of the pieces, which selects their mass from the library.", "empty");
    keys.not_negative("load", debris.load.load, "kg",
                      "Mass of the cargo, in addition to the mass of the state.");
    keys.fraction("load_height", debris.load.load_height,
                  "Height of the centre of the cargo above the floor, as a fraction of the height "
                  "of the inside.");
    keys.numbers("size", debris.size, "m", "Diameter and height of a tank.", no_default);
    keys.rule(check_sizes, debris);
    keys.rule(check_state, debris);
    keys.text("material", debris.material, "Name of the material, for contact.pair.");
    keys.rule(check_material, debris.material);
    keys.table("array", "Pieces in rows, columns and stacks.", debris.array);
    keys.table("scatter",
               "Pieces at random positions in a yard, generated with the seed of the case; the "
               "distance between two pieces is at least `gap` (random sequential addition).",
               debris.scatter, scene);
    keys.rule(place, debris, scene);
}

} // namespace hyoryu
