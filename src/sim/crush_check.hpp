// SPDX-License-Identifier: MIT
// The crush check: finds bodies that a moving wall presses against a solid that yields more slowly.
#pragma once

#include <optional>
#include <string>

namespace hyoryu {

struct Simulation;

/// A body that a moving wall pushes, directly or through other bodies, against a solid that yields
/// more slowly: no motion of the body satisfies all its contacts, and the overlap grows with time.
struct Crushed {
    std::string name;    // of the body
    std::string from;    // the wall that pushes
    std::string against; // the solid that does not yield
    double depth = 0;    // of the deepest contact of the column [m]
};

/// The first such body, by the contacts of the last step, whose column has a contact deeper than
/// a quarter of a spacing or of the inner radius of the thinnest body. No search unless a wall
/// moves and a contact of the step is so deep.
std::optional<Crushed> crushed(const Simulation& sim);

} // namespace hyoryu
