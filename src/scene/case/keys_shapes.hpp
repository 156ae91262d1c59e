// SPDX-License-Identifier: MIT
// The keys of shapes and of their place in space.
#pragma once

#include "keys_names.hpp"
#include "number_table.hpp"
#include "scene/surfaces/mesh_parts.hpp"
#include "units.hpp"

#include "hyoryu/geometry/mesh.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace hyoryu {

/// A rotation as the user may give it.
struct AxisAngle {
    std::optional<Vec3> axis;
    double degrees = 0;
};

/// Box sizes have the metre of width that a two-dimensional case stands for.
inline Vec3 box_size(const TableReader& table, Vec3 size)
{
    if (table.reading().dimensions == 2) {
        size.y() = 1;
    }
    return size;
}

inline void check_size(TableReader& table, BoxShape& box)
{
    box.size = box_size(table, box.size);
    if (table.sound("size") && table.reading().dimensions_known && !(box.size.minCoeff() > 0)) {
        table.error("size", "edge lengths must be > 0 m");
    }
}

inline void check_corners(TableReader& table, const Vec3& low, const Vec3& high)
{
    const bool given = table.sound("min") && table.sound("max") && table.reading().dimensions_known;
    if (given && !(box_size(table, high - low).minCoeff() > 0)) {
        const Vec3 size = box_size(table, high - low);
        const int axis = size.x() > 0 ? (size.y() > 0 ? 2 : 1) : 0;
        table.error("max",
                    fmt::format("{} = {:.6g} m is not above {:.6g} m, that of `min`", "xyz"[axis],
                                high[axis], low[axis]),
                    "`min` is the corner of the smallest x, y and z");
    }
}

inline void place_box(TableReader& table, const std::optional<Vec3>& low,
                      const std::optional<Vec3>& high, BoxShape& box, Vec3& centre)
{
    if (low && high) {
        box.size = box_size(table, *high - *low);
        centre = 0.5 * (*low + *high);
        check_corners(table, *low, *high);
    }
}

// Whether the corners of a mesh are rounded too much, which is noted.
// Meshes are read in single precision, whose spacing grows with the coordinate: those of a map are
// some 0.2 m apart. A hundredth of a particle spacing is less than the particles resolve, and a
// mesh about the origin of its file exceeds it only if it is longer than 300,000 spacings; a bound
// by the extent of the mesh would admit a town whose houses are deformed.
inline bool refuse_rounded(TableReader& table, const Mesh& mesh)
{
    constexpr double half_a_bit = 1.0 / (1 << 24);
    constexpr double most = 0.01; // of the spacing
    double farthest = 0;
    for (const Vec3& corner : mesh.corners) {
        farthest = std::max(farthest, corner.cwiseAbs().maxCoeff());
    }
    const double spacing = table.reading().spacing;
    const bool rounded = spacing > 0 && half_a_bit * farthest > most * spacing;
    if (rounded) {
        table.error("file",
                    fmt::format("the coordinates of the mesh reach {:.7g} m, where its corners are "
                                "rounded by up to {:.2g} m, more than a hundredth of the spacing "
                                "of {:.3g} m",
                                farthest, half_a_bit * farthest, spacing),
                    "mesh files are read in single precision: move the mesh near the origin of its "
                    "file, and place it by `position`");
    }
    return rounded;
}

inline void load_mesh(TableReader& table, MeshShape& shape)
{
    const auto path = path_of_file(table, "file", shape.file);
    if (refuse_flat(table, "shape", "meshes are") || !path) {
        return;
    }
    shape.file = path->string();
    try {
        Mesh mesh = read_mesh(*path, shape.scale);
        const std::string fault = closure_fault(mesh);
        if (!refuse_rounded(table, mesh) && !fault.empty()) {
            table.error("file", fmt::format("the mesh does not enclose a volume: {}", fault),
                        "close and repair it, for instance with MeshLab or Blender");
        }
        shape.corners = std::move(mesh.corners);
        shape.triangles = std::move(mesh.triangles);
    } catch (const IoError& error) {
        table.error("file", error.what(),
                    "expected a closed surface of triangles as STL or OBJ; convert or repair it, "
                    "for instance with MeshLab or Blender");
    }
}

/// Parts of a mesh whose volume counts must be apart; those of a wall may overlap.
enum class MeshParts { apart, may_overlap };

inline void check_parts(TableReader& table, const MeshShape& mesh, MeshParts parts)
{
    if (table.mistaken()) {
        return;
    }
    const auto at_place = [](const Vec3& p) {
        return fmt::format("({:.4g}, {:.4g}, {:.4g})", p.x(), p.y(), p.z());
    };
    const PartFaults faults =
        part_faults(mesh, parts == MeshParts::apart ? PartsAsked::all : PartsAsked::inside_out);
    if (faults.inside_out) {
        table.error("file",
                    fmt::format("a part of the mesh is inside out: at {} m its triangles face into "
                                "it",
                                at_place(*faults.inside_out)),
                    "turn the triangles of this part over");
    }
    if (faults.overlap && parts == MeshParts::apart) {
        table.error("file",
                    fmt::format("parts of the mesh overlap at {} m, or one is within the other: "
                                "volume and mass would count this space twice",
                                at_place(*faults.overlap)),
                    "unite the parts (Boolean union); for a cavity turn the triangles of its "
                    "surface over");
    }
}

/// Two particles at one point, which count twice in the mass; an empty text if there are none.
inline std::string particle_given_twice(const NumberTable& numbers)
{
    std::vector<std::size_t> order(numbers.rows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return numbers.rows[k]; });
    const auto twice =
        std::ranges::adjacent_find(order, {}, [&](std::size_t k) { return numbers.rows[k]; });
    return twice == order.end() ? std::string()
                                : fmt::format("{}: the same point as in line {}",
                                              numbers.lines[*(twice + 1)], numbers.lines[*twice]);
}

inline void load_particles(TableReader& table, ParticleShape& shape)
{
    const auto path = path_of_file(table, "file", shape.file);
    if (refuse_flat(table, "shape", "bodies of particles are") || !path) {
        return;
    }
    shape.file = path->string();
    constexpr std::array<NumberColumn, 3> columns{{{"x", "m"}, {"y", "m"}, {"z", "m"}}};
    const NumberTable numbers = read_number_table(*path, columns);
    for (const std::string& fault : numbers.faults) {
        table.error("file", fault, "one particle a line: x, y, z in m");
    }
    if (numbers.rows.empty() && numbers.faults.empty()) {
        table.error("file", fmt::format("{}: has no particle", path->string()),
                    "one particle a line: x, y, z in m");
    }
    if (const std::string twice = particle_given_twice(numbers); !twice.empty()) {
        table.error("file", fmt::format("{}:{}", path->string(), twice),
                    "remove one of them: each particle has the mass of its own cell");
    }
    Vec3 mean = Vec3::Zero();
    for (const auto& row : numbers.rows) {
        shape.points.emplace_back(row[0], row[1], row[2]);
        mean += shape.points.back() / static_cast<double>(numbers.rows.size());
    }
    for (Vec3& point : shape.points) {
        point -= mean;
    }
}

inline void require_axis(TableReader& table)
{
    if (table.reading().dimensions == 3) {
        table.require("axis");
    }
}

inline void turn_by_axis(TableReader& table, const AxisAngle& turn, Quat& rotation)
{
    const Vec3 direction = turn.axis.value_or(Vec3(0, 1, 0));
    if (!(direction.norm() > 0) || !std::isfinite(direction.norm())) {
        table.error("axis", "has no direction");
        return;
    }
    if (table.reading().dimensions == 2 && (direction.x() != 0 || direction.z() != 0)) {
        table.error("axis", "in two dimensions rotations are about y", "write axis = [0, 1, 0]");
    }
    // Angles such as 0.785 or 1.571 are parts of a half turn in radians.
    for (const int part : {1, 2, 3, 4, 6}) {
        if (std::abs(std::abs(turn.degrees) - std::numbers::pi / part) < 1e-3) {
            table.warn(
                "angle",
                fmt::format("{} degrees look like {} degrees in radians", turn.degrees, 180 / part),
                fmt::format("write {} if that is meant", std::copysign(180 / part, turn.degrees)));
        }
    }
    const double radians = turn.degrees * std::numbers::pi / 180;
    rotation = Quat(Eigen::AngleAxisd(radians, direction.normalized()));
}

inline void check_one_rotation(TableReader& table, bool by_axis)
{
    if (by_axis && table.has("rotation")) {
        table.error("rotation", "give either `rotation` or `rotation_deg`",
                    "remove one of the two");
    }
}

/// Descriptions of the keys of a shape, for walls, bodies and fluid blocks.
struct ShapeWords {
    std::string_view min{}, max{}, size, radius, length, file;
    MeshParts parts = MeshParts::apart;
};

void keys_of(auto& keys, Is<AxisAngle> auto& turn, auto& rotation)
{
    keys.rule(require_axis);
    keys.vector("axis", turn.axis, "", "Axis of rotation, a vector of any length.",
                "[0.0, 1.0, 0.0] in 2-D, else required");
    keys.number("angle", turn.degrees, "deg", "Angle of rotation, by the right-hand rule.",
                required);
    keys.rule(turn_by_axis, turn, rotation);
}

/// `rotation_deg` or `rotation`; no rotation if neither is there.
void rotation_keys(auto& keys, Is<Quat> auto& rotation, std::string_view meaning)
{
    std::optional<AxisAngle> turn;
    keys.table("rotation_deg", meaning, turn, rotation);
    keys.quaternion("rotation", rotation,
                    "Rotation as a unit quaternion [w, x, y, z], instead of rotation_deg.");
    keys.rule(check_one_rotation, turn.has_value());
}

/// A shape about its own centre, of any kind but a box in space.
void shape_keys(auto& keys, Is<Shape> auto& shape, const ShapeWords& words)
{
    if (auto* box = std::get_if<BoxShape>(&shape)) {
        keys.vector("size", box->size, "m", words.size, needed);
        keys.rule(check_size, *box);
    } else if (auto* sphere = std::get_if<SphereShape>(&shape)) {
        keys.positive("radius", sphere->radius, "m", words.radius, needed);
    } else if (auto* cylinder = std::get_if<CylinderShape>(&shape)) {
        keys.positive("radius", cylinder->radius, "m", words.radius, needed);
        keys.positive("length", cylinder->length, "m", words.length, needed);
    } else if (auto* mesh = std::get_if<MeshShape>(&shape)) {
        keys.text("file", mesh->file, words.file, needed);
        keys.positive("scale", mesh->scale, "",
                      "Factor that converts the numbers of a mesh file to metres.");
        keys.rule(load_mesh, *mesh);
        keys.rule(check_parts, *mesh, words.parts);
    } else if (auto* particles = std::get_if<ParticleShape>(&shape)) {
        keys.text("file", particles->file, words.file, needed);
        keys.rule(load_particles, *particles);
    }
}

/// A shape in space: a box by its corners or by its size and position, others by their position.
void placed_keys(auto& keys, Is<Shape> auto& shape, auto& centre, const ShapeWords& words)
{
    auto* box = std::get_if<BoxShape>(&shape);
    const bool by_corners = keys.gives("min") || keys.gives("max");
    if (box != nullptr && keys.applies(by_corners)) {
        std::optional<Vec3> low;
        std::optional<Vec3> high;
        keys.planar("min", low, "m", words.min, needed);
        keys.planar("max", high, "m", words.max, needed);
        keys.rule(place_box, low, high, *box, centre);
    }
    if (box == nullptr || keys.applies(!by_corners)) {
        shape_keys(keys, shape, words);
        keys.planar("position", centre, "m",
                    "Centre of the shape; for a mesh the position of the origin of its file.",
                    std::holds_alternative<MeshShape>(shape) ? no_default : needed);
    }
}

} // namespace hyoryu
