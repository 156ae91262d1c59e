// SPDX-License-Identifier: MIT
// Shapes of fluid blocks, walls and bodies, their rotation, and the meshes they name.
#include "number_table.hpp"
#include "reader.hpp"
#include "units.hpp"

#include "hyoryu/geometry/mesh.hpp"
#include "hyoryu/scene/voxels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

/// Box sizes have the metre of width that a two-dimensional case stands for.
Vec3 box_size(TableReader& table, Vec3 size)
{
    if (table.reading().dimensions == 2) {
        size.y() = 1;
    }
    return size;
}

BoxShape read_sized_box(TableReader& table)
{
    table.require("size");
    const auto given = table.find_vector("size");
    const BoxShape box{box_size(table, given.value_or(Vec3(1, 1, 1)))};
    if (given && !(box.size.minCoeff() > 0)) {
        table.error("size", "edge lengths must be > 0 m");
    }
    return box;
}

PlacedShape read_box(TableReader& table)
{
    if (!table.has("min") && !table.has("max")) {
        PlacedShape box{read_sized_box(table)};
        table.require("position");
        box.centre = table.planar("position");
        return box;
    }
    table.require("min");
    table.require("max");
    const auto low = table.find_planar("min");
    const auto high = table.find_planar("max");
    if (!low || !high) {
        return {};
    }
    const BoxShape box{box_size(table, *high - *low)};
    if (!(box.size.minCoeff() > 0)) {
        table.error("max", "must lie above `min` in every direction");
    }
    return {box, 0.5 * (*low + *high)};
}

MeshShape read_mesh_shape(TableReader& table)
{
    MeshShape shape;
    const auto path = read_file_path(table, "file");
    shape.scale = table.find_number("scale").value_or(1);
    if (table.reading().dimensions == 2) {
        table.error("shape", "this version has meshes in three dimensions only");
        return shape;
    }
    if (!path) {
        return shape;
    }
    shape.file = path->string();
    try {
        Mesh mesh = read_mesh(*path, shape.scale);
        const std::string fault = closure_fault(mesh);
        if (!fault.empty()) {
            table.error("file", fmt::format("the mesh does not enclose a volume: {}", fault),
                        "close and repair it, for instance with MeshLab or Blender");
        }
        const auto far = std::ranges::find_if(mesh.corners, [](const Vec3& corner) {
            return corner.cwiseAbs().maxCoeff() > largest_value("m");
        });
        if (far != mesh.corners.end()) {
            table.error("file",
                        fmt::format("has a corner at ({:.3g}, {:.3g}, {:.3g}) m, expected "
                                    "at most {} m",
                                    far->x(), far->y(), far->z(), largest_value("m")),
                        "is `scale` right? it takes the numbers of the file to metres");
        }
        shape.corners = std::move(mesh.corners);
        shape.triangles = std::move(mesh.triangles);
    } catch (const IoError& error) {
        table.error("file", error.what());
    }
    return shape;
}

Shape read_round_shape(TableReader& table, const std::string& kind)
{
    table.require("radius");
    const double radius = table.find_number("radius").value_or(1);
    if (kind == "sphere") {
        return SphereShape{radius};
    }
    table.require("length");
    return CylinderShape{radius, table.find_number("length").value_or(1)};
}

Quat from_axis_and_angle(TableReader table)
{
    const bool flat = table.reading().dimensions == 2;
    if (!flat) {
        table.require("axis");
    }
    const auto axis = table.find_vector("axis");
    const double degrees = table.number("angle");
    table.finish();
    const Vec3 direction = axis.value_or(Vec3(0, 1, 0));
    if (!(direction.norm() > 0) || !std::isfinite(direction.norm())) {
        table.error("axis", "has no direction");
        return Quat::Identity();
    }
    if (flat && (direction.x() != 0 || direction.z() != 0)) {
        table.error("axis", "in two dimensions rotations are about y", "write axis = [0, 1, 0]");
    }
    const double radians = degrees * std::numbers::pi / 180;
    return Quat(Eigen::AngleAxisd(radians, direction.normalized()));
}

Quat from_quaternion(TableReader& table)
{
    const std::vector<double> q = table.numbers("rotation");
    if (q.empty()) {
        return Quat::Identity();
    }
    const Quat rotation(q[0], q[1], q[2], q[3]);
    // A quaternion that this program wrote is a unit up to rounding and is taken bit by bit.
    constexpr double rounding = 1e-14;
    constexpr double typed = 1e-3;
    const double excess = std::abs(rotation.squaredNorm() - 1);
    if (!(excess < typed)) {
        table.error("rotation",
                    fmt::format("is no unit quaternion, its norm is {:.6g}", rotation.norm()));
        return Quat::Identity();
    }
    if (table.reading().dimensions == 2 && (q[1] != 0 || q[3] != 0)) {
        table.error("rotation", "in two dimensions rotations are about y");
    }
    return excess < rounding ? rotation : rotation.normalized();
}

// The boxes of the cubes, or the cubes themselves if they are on no common lattice.
void make_boxes(ParticleShape& shape)
{
    const Vec3 cell = Vec3::Constant(shape.spacing);
    if (const auto merged = merged_cells(shape.points, cell)) {
        for (const Bounds& box : *merged) {
            shape.boxes.push_back({box.min, box.max});
        }
        return;
    }
    for (const Vec3& point : shape.points) {
        shape.boxes.push_back({point - cell / 2, point + cell / 2});
    }
}

ParticleShape read_particle_shape(TableReader& table, double spacing)
{
    ParticleShape shape;
    shape.spacing = spacing;
    const auto path = read_file_path(table, "file");
    if (table.reading().dimensions == 2) {
        table.error("shape", "this version has bodies of particles in three dimensions only");
        return shape;
    }
    if (!path) {
        return shape;
    }
    shape.file = path->string();
    constexpr std::array<NumberColumn, 3> columns{{{"x", "m"}, {"y", "m"}, {"z", "m"}}};
    const NumberTable numbers = read_number_table(*path, columns);
    for (const std::string& fault : numbers.faults) {
        table.error("file", fault, "one particle a line: x, y, z in m");
    }
    if (numbers.rows.empty()) {
        if (numbers.faults.empty()) {
            table.error("file", fmt::format("{}: has no particle", path->string()));
        }
        return shape;
    }
    Vec3 mean = Vec3::Zero();
    for (const auto& row : numbers.rows) {
        shape.points.emplace_back(row[0], row[1], row[2]);
        mean += shape.points.back() / static_cast<double>(numbers.rows.size());
    }
    for (Vec3& point : shape.points) {
        point -= mean;
    }
    make_boxes(shape);
    return shape;
}

/// Moves a mesh to its centre of mass, about which bodies are given.
void centre_mesh(MeshShape& shape)
{
    const Vec3 centre = solid_properties({shape.corners, shape.triangles}).centroid;
    for (Vec3& corner : shape.corners) {
        corner -= centre;
    }
}

} // namespace

Quat read_rotation(TableReader& table)
{
    TableReader by_axis = table.table("rotation_deg");
    if (by_axis.present()) {
        if (table.has("rotation")) {
            table.error("rotation", "give either `rotation` or `rotation_deg`");
        }
        table.numbers("rotation");
        return from_axis_and_angle(std::move(by_axis));
    }
    return from_quaternion(table);
}

PlacedShape read_placed_shape(TableReader& table, const std::string& kind)
{
    PlacedShape placed;
    if (kind == "box") {
        placed = read_box(table);
    } else if (kind == "mesh") {
        placed.shape = read_mesh_shape(table);
        placed.centre = table.planar("position");
    } else {
        placed.shape = read_round_shape(table, kind);
        table.require("position");
        placed.centre = table.planar("position");
    }
    placed.rotation = read_rotation(table);
    return placed;
}

Shape read_body_shape(TableReader& table, const std::string& kind, double spacing)
{
    if (kind == "particles") {
        return read_particle_shape(table, spacing);
    }
    if (kind == "box") {
        return read_sized_box(table);
    }
    if (kind == "mesh") {
        MeshShape shape = read_mesh_shape(table);
        centre_mesh(shape);
        return shape;
    }
    return read_round_shape(table, kind);
}

} // namespace hyoryu
