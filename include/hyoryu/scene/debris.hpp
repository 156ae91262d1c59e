// SPDX-License-Identifier: MIT
// The debris library: kinds of floating debris with their sizes, masses and stiffness, each number
// with its source, and the bodies that a case makes of them.
#pragma once

#include "hyoryu/scene/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

/// A number of the library, or some that belong together.
struct DebrisNumber {
    std::string name;          // "empty", "code" ...
    std::vector<double> value; // SI
    std::string grade;         // "read", "unverified" or "assumption"
    std::string source;
};

/// hollow_box: size x, y, z, a shell of the empty mass with cargo inside; box: the same, filled;
/// lying_cylinder: diameter and length along x; standing_cylinder: diameter and height, a shell.
enum class DebrisShape { box, hollow_box, lying_cylinder, standing_cylinder };

struct DebrisKind {
    std::string name;
    std::string title;
    DebrisShape shape = DebrisShape::box;
    DebrisNumber size;
    std::vector<DebrisNumber> masses;    // by state [kg]; the first one is the empty piece
    bool per_area = false;               // the masses are of a unit of the surface [kg/m2]
    std::vector<DebrisNumber> stiffness; // for reports [N/m]
};

/// The file `debris.toml` of the library as it is part of this program.
std::string_view debris_library_text();

/// The kinds in the order of the library.
std::span<const DebrisKind> debris_library();

/// The text that `hyoryu describe debris` prints before the keys.
std::string describe_debris_library();

/// A piece of a kind: shape, mass, centre of mass and inertia of one body; no place yet.
struct DebrisPiece {
    BodySettings body;               // position: of the centre of mass over the middle
    Quat upright = Quat::Identity(); // body axes to those in which the piece stands
    Vec3 extent{0, 0, 0};            // edges of the box about the standing piece [m]
};

/// The load of a piece, as given in the case.
struct DebrisLoad {
    std::size_t kind = 0;
    std::string state;        // of the library; empty: the first one
    double load = 0;          // cargo besides the mass of the state [kg]
    double load_height = 0.4; // of its centre above the floor, part of the inside
    std::vector<double> size; // diameter and height where the library has none [m]
};

/// In two dimensions mass and inertia are per metre of width, so that the density is the same.
DebrisPiece debris_piece(const DebrisLoad& load, int dimensions);

} // namespace hyoryu
