// SPDX-License-Identifier: MIT
// The parts of the reader: each reads one table of the case into the scene.
#pragma once

#include "reader_table.hpp"

namespace hyoryu {

/// A shape with its place in space.
struct PlacedShape {
    Shape shape;
    Vec3 centre{0, 0, 0};
    Quat rotation = Quat::Identity();
};

/// The file that a text key of the table names, beside the case file; nothing, and a mistake noted,
/// if the key is missing, empty, or names what cannot be read.
std::optional<std::filesystem::path> read_file_path(TableReader& table, std::string_view key);

/// Notes a mistake if the text of a key is no name (see `name_fault`).
void check_name(TableReader& table, std::string_view key, const std::string& name);

/// The shape of a fluid block or solid wall, in space; `kind` is the value of its key `shape`.
PlacedShape read_placed_shape(TableReader& table, const std::string& kind);

/// The shape of a body, about its centre of mass; `spacing` of its particles [m].
Shape read_body_shape(TableReader& table, const std::string& kind, double spacing);

/// [wall.motion]; a piston needs the magnitude of gravity.
Motion read_motion(TableReader table, double gravity);

/// `rotation_deg` or `rotation`; no rotation if neither is there.
Quat read_rotation(TableReader& table);

void read_general(TableReader& root, Scene& scene);
void read_fluid(TableReader table, Scene& scene);
void read_walls(TableReader& root, Scene& scene);
void read_bodies(TableReader& root, Scene& scene);
void read_contact(TableReader table, Scene& scene);
void read_gauges(TableReader& root, Scene& scene);
void read_output(TableReader table, Scene& scene);

} // namespace hyoryu
