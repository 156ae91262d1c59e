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
    double missing = 0;  // room: the overlaps along the column of bodies in all [m]
};

/// The first such body, by the contacts of the last step, in whose column more room is missing than
/// a quarter of a spacing or of the inner radius of the thinnest body. No search unless a wall
/// moves and all overlaps of the step are that much together.
std::optional<Crushed> crushed(const Simulation& sim);

} // namespace hyoryu
