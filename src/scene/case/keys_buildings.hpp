// SPDX-License-Identifier: MIT
// The keys of buildings: footprints from a map, which become walls.
#pragma once

#include "keys_walls.hpp"
#include "place_buildings.hpp"

namespace hyoryu {

/// [[buildings]]
struct BuildingKeys {
    std::string file;
    NumberOrName height; // a property or [m]
    std::string name;    // a property, or empty
    std::string material;
    Place place;
    std::string table; // "buildings[0]"
};

/// The footprints of the file that have no mistake; the mistakes of the others are noted, and that
/// their names are lost.
inline std::vector<Footprint> load_footprints(TableReader& table, const BuildingKeys& buildings)
{
    const auto path = path_of_file(table, "file", buildings.file);
    if (refuse_flat(table, "file", "buildings are") || !path || !table.sound("height")) {
        return {};
    }
    try {
        Footprints found = read_footprints(
            *path, {buildings.height.name, buildings.height.number, buildings.name});
        for (const std::string& fault : found.faults) {
            table.error("file", fault, "correct the file there, or remove that feature");
        }
        table.reading().names_known = table.reading().names_known && found.faults.empty();
        return std::move(found.list);
    } catch (const IoError& error) {
        table.error("file", error.what(), "a GeoJSON file of polygons");
        return {};
    }
}

inline void check_height_of_all(TableReader& table, const BuildingKeys& buildings)
{
    if (buildings.height.number && !(*buildings.height.number > 0)) {
        table.error("height", "must be above 0 m",
                    "give a height in metres, or the name of a property of the footprints");
    }
}

/// The walls of footprints, and the mistakes of their outlines and names.
inline void add_walls(TableReader& table, const BuildingKeys& buildings,
                      const std::vector<Footprint>& footprints, Scene& scene)
{
    const std::size_t number = table.number_of_table();
    const std::string prefix = number == 1 ? "building" : fmt::format("building_{}", number);
    Buildings built = place_buildings(footprints, prefix, scene);
    for (const PlaceFault& fault : built.faults) {
        table.error("file", fault.what, fault.hint);
        table.reading().names_known = false;
    }
    for (const PlaceFault& warning : built.warnings) {
        table.warn("file", warning.what, warning.hint);
    }
    for (Wall& wall : built.walls) {
        if (const std::string fault = name_fault(wall.name); !fault.empty()) {
            table.error("name",
                        fmt::format("the name \"{}\" of a building is not valid: {}",
                                    printable(wall.name), fault),
                        "correct it in the file, or leave `name` out: then the buildings are "
                        "numbered");
        }
        claim_name(table, wall.name);
        wall.material = buildings.material;
        wall.place = buildings.place;
        wall.table = buildings.table;
        scene.walls.push_back(std::move(wall));
    }
}

/// Mistakes of the file hide neither each other nor those of other places.
inline void add_buildings(TableReader& table, const BuildingKeys& buildings, Scene& scene)
{
    Reading& reading = table.reading();
    const bool known = reading.walls_known();
    const std::size_t before = reading.diagnostics.size();
    const std::vector<Footprint> footprints = load_footprints(table, buildings);
    if (footprints.empty() || !known) {
        reading.names_known = false; // walls or numbers are mistaken: no place follows from them
    } else {
        add_walls(table, buildings, footprints, scene);
    }
    reading.of_buildings += reading.diagnostics.size() - before;
}

void keys_of(auto& keys, Is<BuildingKeys> auto& buildings, auto& scene)
{
    keys.text("file", buildings.file,
              "GeoJSON file of the footprints (Polygon or MultiPolygon), relative to the case "
              "file, in the coordinates of the terrain if the case has a terrain.",
              required);
    keys.number_or_name("height", buildings.height, "m",
                        "Height above the lowest ground under the footprint: a number for all "
                        "buildings, or the name of the property that contains the height.",
                        required);
    keys.rule(check_height_of_all, buildings);
    keys.text("name", buildings.name,
              "Property that contains the name of each building; without this key the names are "
              "building.1, building.2 ...");
    keys.text("material", buildings.material, "Name of the material, for contact.pair.");
    keys.rule(check_material, buildings.material);
    keys.rule(add_buildings, buildings, scene);
}

} // namespace hyoryu
