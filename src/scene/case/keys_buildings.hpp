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
};

/// The footprints of the file without mistake; else none, and the mistakes are noted.
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
        return found.faults.empty() ? std::move(found.list) : std::vector<Footprint>{};
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

inline void add_buildings(TableReader& table, const BuildingKeys& buildings, Scene& scene)
{
    const std::vector<Footprint> footprints = load_footprints(table, buildings);
    if (footprints.empty() || !table.reading().diagnostics.empty()) {
        table.reading().names_known = false;
        return; // walls or numbers are mistaken: no place follows from them
    }
    const std::size_t number = table.number_of_table();
    const std::string prefix = number == 1 ? "building" : fmt::format("building_{}", number);
    Buildings built = place_buildings(footprints, prefix, scene);
    for (const PlaceFault& fault : built.faults) {
        table.error("file", fault.what, fault.hint);
    }
    for (const PlaceFault& warning : built.warnings) {
        table.warn("file", warning.what, warning.hint);
    }
    for (Wall& wall : built.walls) {
        if (const std::string fault = name_fault(wall.name); !fault.empty()) {
            table.error("name", fmt::format("the name \"{}\" of a building is not valid: {}",
                                            printable(wall.name), fault));
        }
        claim_name(table, wall.name);
        wall.material = buildings.material;
        wall.place = buildings.place;
        scene.walls.push_back(std::move(wall));
    }
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
