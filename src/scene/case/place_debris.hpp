// SPDX-License-Identifier: MIT
// Places for pieces of debris: arrays, stacks and yards, on the ground.
#pragma once

#include "place_fault.hpp"
#include "scene/surfaces/plan_polygon.hpp"

#include "hyoryu/scene/debris.hpp"

namespace hyoryu {

/// [debris.array]
struct DebrisArray {
    std::array<std::int64_t, 3> count{1, 1, 1};
    Vec3 pitch{0, 0, 0}; // [m]
    Vec3 from{0, 0, 0};  // middle of the first piece [m]
    double turn_deg = 0; // about z
    std::string on;      // "ground", the name of a wall, or empty: `from` has the height
};

/// [debris.scatter]
struct DebrisScatter {
    std::vector<Plan2> polygon; // [m]
    std::int64_t count = 1;
    double gap = 0;                         // between two pieces [m]
    std::array<double, 2> turn_deg{0, 360}; // about z
    std::string on = "ground";
};

/// [[debris]]
struct DebrisKeys {
    DebrisLoad load;
    std::optional<std::array<double, 2>> size; // diameter and height [m]
    std::string name;
    std::string material;
    std::optional<DebrisArray> array;     // this
    std::optional<DebrisScatter> scatter; // or this
    std::size_t placed = 0;               // bodies that it has become
    Place place;
    std::string table; // "debris[0]"
};

/// Appends the pieces to the bodies of the scene and returns what is wrong with their places: no
/// ground below, ground too uneven to stand on, a stack whose pieces overlap, no room in the yard
/// beside the bodies that are there already. The same seed and name give the same places.
std::vector<PlaceFault> place_debris(DebrisKeys& debris, Scene& scene);

} // namespace hyoryu
