// SPDX-License-Identifier: MIT
// Whether moving walls leave bodies the room they need.
#pragma once

#include <optional>
#include <string>

namespace hyoryu {

struct Simulation;

/// A body that a moving wall pushes, itself or through other bodies, against what gives way more
/// slowly: then no motion of the body obeys all its contacts, and they overlap by more every step.
struct Crushed {
    std::string name;    // of the body
    std::string from;    // the wall that pushes
    std::string against; // what stands
    double depth = 0;    // of the deepest contact of the column [m]
};

/// The first such body, by the contacts of the last step, whose column has a contact deeper than
/// a quarter of a spacing or of the inner radius of the thinnest body. No search unless a wall
/// moves and a contact of the step is so deep.
std::optional<Crushed> crushed(const Simulation& sim);

} // namespace hyoryu
