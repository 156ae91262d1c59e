// SPDX-License-Identifier: MIT
// The keys of walls and of how they move.
#pragma once

#include "keys_prism.hpp"
#include "keys_terrain.hpp"
#include "keys_waves.hpp"

namespace hyoryu {

/// How a wall moves.
enum class MotionWay { none, velocity, table, points, piston, lift };

// Rounding of a path that passes through the origin at time 0 [m].
inline constexpr double at_origin = 1e-12;

inline void flatten(Motion& motion, int dimensions)
{
    for (Vec3& place : motion.places) {
        place.y() = dimensions == 2 ? 0 : place.y();
    }
}

inline void find_way(TableReader& table, MotionWay& way)
{
    const bool points = table.has("times") || table.has("places");
    const int ways = (table.has("velocity") ? 1 : 0) + (table.has("table") ? 1 : 0) +
                     (table.has("piston") ? 1 : 0) + (table.has("lift") ? 1 : 0) + (points ? 1 : 0);
    if (ways > 1) {
        table.error(table.has("velocity") ? "velocity"
                    : table.has("table")  ? "table"
                    : table.has("lift")   ? "lift"
                                          : "times",
                    "give one of `velocity`, `table`, `piston`, `lift`, or `times` and `places`");
        table.abandon();
        way = MotionWay::none;
    } else {
        way = table.has("table")    ? MotionWay::table
              : table.has("piston") ? MotionWay::piston
              : table.has("lift")   ? MotionWay::lift
              : points              ? MotionWay::points
                                    : MotionWay::velocity;
    }
}

/// The fault of a path whose speed between two points exceeds the largest one; empty if none does.
inline std::string fault_of_speed(const Motion& motion)
{
    for (std::size_t k = 1; k < std::min(motion.times.size(), motion.places.size()); ++k) {
        const double speed = (motion.places[k] - motion.places[k - 1]).norm() /
                             (motion.times[k] - motion.times[k - 1]);
        if (!(speed <= largest_value("m/s"))) {
            return fmt::format("moves at {:.3g} m/s between {} and {} s, expected at most {} m/s",
                               speed, motion.times[k - 1], motion.times[k], largest_value("m/s"));
        }
    }
    return {};
}

inline void load_path(TableReader& table, const std::string& file, Motion& motion)
{
    const auto path = path_of_file(table, "table", file);
    if (!path) {
        return;
    }
    constexpr std::array<NumberColumn, 4> columns{
        {{"time", "s"}, {"x", "m"}, {"y", "m"}, {"z", "m"}}};
    const NumberTable numbers = read_number_table(*path, columns);
    for (const std::string& fault : numbers.faults) {
        table.error("table", fault, "columns are time, x, y, z in s and m");
    }
    for (std::size_t k = 0; k < numbers.rows.size(); ++k) {
        const std::vector<double>& row = numbers.rows[k];
        if (k > 0 && row[0] <= motion.times.back()) {
            table.error("table",
                        fmt::format("{}:{}: time {} is not later than {}", path->string(),
                                    numbers.lines[k], row[0], motion.times.back()),
                        "times must ascend");
            break;
        }
        motion.times.push_back(row[0]);
        motion.places.emplace_back(row[1], row[2], row[3]);
    }
    if (numbers.faults.empty() && numbers.rows.size() < 2) {
        table.error("table", fmt::format("{}: has {} rows of numbers, a path needs two",
                                         path->string(), numbers.rows.size()));
    }
    flatten(motion, table.reading().dimensions);
    if (const std::string fault = fault_of_speed(motion); !fault.empty()) {
        table.error("table", fmt::format("{}: {}", path->string(), fault),
                    "times are in s, places in m");
    }
    if (motion.times.size() < 2) {
        return;
    }
    const Vec3 start = displacement(motion, 0);
    for (Vec3& place : motion.places) {
        place -= start;
    }
}

inline void check_path(TableReader& table, Motion& motion)
{
    flatten(motion, table.reading().dimensions);
    if (!table.sound("times") || !table.sound("places")) {
        return;
    }
    if (motion.times.size() != motion.places.size()) {
        table.error("places", fmt::format("has {} points for {} times", motion.places.size(),
                                          motion.times.size()));
        return;
    }
    const auto unsorted = std::adjacent_find(motion.times.begin(), motion.times.end(),
                                             [](double a, double b) { return b <= a; });
    if (unsorted != motion.times.end()) {
        table.error_at("times", at(unsorted + 1 - motion.times.begin()), "times must ascend");
    } else if (const std::string fault = fault_of_speed(motion); !fault.empty()) {
        table.error("places", fault, "times are in s, places in m");
    } else if (displacement(motion, 0).norm() > at_origin) {
        table.error("places", "the path is not at [0, 0, 0] at time 0",
                    "places are displacements from the position of the wall at time 0");
    }
}

/// Input of an absorbing paddle besides its path.
struct AbsorbKeys {
    bool absorbs = false;
    std::optional<double> depth; // [m]
    std::vector<double> levels;  // [m]
};

inline void check_absorption(TableReader& table, const AbsorbKeys& keys, MotionWay way, Wall& wall)
{
    Motion& motion = wall.motion;
    if (!keys.absorbs) {
        motion.absorption.reset();
        if (table.mistaken({"absorb"})) {
            table.abandon();
        }
        return;
    }
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    const bool box = solid != nullptr && std::holds_alternative<BoxShape>(solid->shape) &&
                     solid->rotation.isApprox(Quat::Identity());
    if (!box) {
        table.error("absorb", "has a meaning for a paddle only: a wall of shape \"box\" that is "
                              "not rotated");
    }
    if (way == MotionWay::piston) {
        if (keys.depth) {
            table.error("depth", "has no meaning here, the piston has a depth", "remove it");
        }
        return;
    }
    if (way == MotionWay::table || way == MotionWay::lift || motion.velocity.norm() > 0) {
        table.error("absorb", "needs the waves that the paddle generates",
                    "use it with a `piston`, with `times`, `places` and `levels`, or alone");
    } else if (way != MotionWay::points && !keys.levels.empty()) {
        table.error("levels", "has no meaning without `times` and `places`",
                    "omit it, or give the path that generates these levels");
    } else if (way == MotionWay::points && keys.levels.size() != motion.times.size()) {
        table.error(table.has("levels") ? "levels" : "absorb",
                    fmt::format("expected a level of the water for each of {} times, found {}",
                                motion.times.size(), keys.levels.size()));
    } else if (!keys.depth) {
        table.require("depth");
    } else {
        motion.absorption.emplace(Motion::Absorption{.depth = *keys.depth, .levels = keys.levels});
    }
}

void keys_of(auto& keys, Is<PlaneWall> auto& plane)
{
    keys.planar("point", plane.point, "m", "A point on a plane.");
    keys.direction("normal", plane.normal,
                   "Normal vector of a plane, directed into the free space; of any length.");
}

void keys_of(auto& keys, Is<BasinWall> auto& basin)
{
    keys.planar("min", basin.min, "m", "Lower corner of a basin or box.", needed);
    keys.planar("max", basin.max, "m", "Upper corner of a basin or box.", needed);
    keys.rule(check_corners, basin.min, basin.max);
    keys.flags("open", basin.open, {"-x", "+x", "-y", "+y", "-z", "+z"},
               "Sides of a basin without a wall.");
    keys.positive("thickness", basin.thickness, "m",
                  "Thickness of the sides of a basin for contact with bodies, including contact at "
                  "the outside and the rims. By default it is 2 fluid.smoothing_ratio spacings, "
                  "rounded up to a whole number of spacings, or three spacings without a fluid. "
                  "The penalty method uses two spacings.",
                  "that of the rows of wall particles");
}

/// Keys of a paddle that absorbs, beside those of its path.
void absorb_keys(auto& keys, MotionWay way, auto& wall)
{
    AbsorbKeys absorb;
    if (const auto& absorption = wall.motion.absorption; keys.writes && absorption) {
        absorb = {true, absorption->depth, absorption->levels};
    }
    if (keys.shows(absorb.absorbs)) {
        keys.flag("absorb", absorb.absorbs,
                  "Whether the paddle absorbs incoming waves so that they are not reflected: in "
                  "addition to its path it retreats with the speed sqrt(g/d) (level - target "
                  "level) (first-order active absorption). A paddle without a path only absorbs.");
    }
    if (keys.applies(absorb.absorbs)) {
        keys.positive("depth", absorb.depth, "m",
                      "Depth of the water at rest in front of an absorbing paddle; a piston has "
                      "its own depth key.",
                      no_default);
        if (keys.applies(!absorb.levels.empty() || keys.gives("levels"))) {
            keys.path("levels", absorb.levels, "m",
                      "Water level at the paddle, above still water, that the path generates at "
                      "each of the times.");
        }
    }
    keys.rule(check_absorption, absorb, way, wall);
}

void keys_of(auto& keys, Is<Motion> auto& motion, auto& wall, double gravity, const Scene& scene)
{
    MotionWay way = motion.times.empty() ? MotionWay::velocity : MotionWay::points;
    keys.rule(find_way, way);
    if (keys.applies(way == MotionWay::velocity)) {
        keys.planar("velocity", motion.velocity, "m/s", "Constant velocity.");
    }
    if (keys.applies(way == MotionWay::table)) {
        std::string file;
        keys.text("table", file,
                  "CSV file of a path, relative to the case file: columns time, x, y, z in s and "
                  "m, with or without a header line. The path is interpolated by monotone cubics. "
                  "The wall starts at its position in the case regardless of the position in the "
                  "file at time 0, and is at rest outside of the time range of the file.",
                  needed);
        keys.rule(load_path, file, motion);
    }
    if (keys.applies(way == MotionWay::points)) {
        keys.path("times", motion.times, "s",
                  "Times of a path that is given in the case file, ascending; used with places.");
        keys.path(
            "places", motion.places, "m",
            "Displacements from the position at time 0, one [x, y, z] for each of the times.");
        keys.rule(check_path, motion);
    }
    if (keys.applies(way == MotionWay::piston)) {
        PistonWave wave;
        keys.table("piston",
                   "Motion along +x of a paddle that generates waves, from time 0 on: a solitary "
                   "wave (Goring 1978) or regular waves (Madsen 1971).",
                   wave, wall, gravity, scene.time.end);
    }
    if (keys.applies(way == MotionWay::lift)) {
        Lift lift;
        keys.table("lift", "Motion along +z of a gate that opens.", lift, motion, scene.spacing,
                   scene.time.end);
    }
    absorb_keys(keys, way, wall);
}

inline bool is_terrain(const Wall& wall)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    const auto* mesh = solid != nullptr ? std::get_if<MeshShape>(&solid->shape) : nullptr;
    return mesh != nullptr && mesh->terrain;
}

inline bool is_prism(const Wall& wall)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    const auto* mesh = solid != nullptr ? std::get_if<MeshShape>(&solid->shape) : nullptr;
    return mesh != nullptr && mesh->prism;
}

/// The mesh of a wall; a reader also adds its terrain or prism to it.
template <class Part>
auto& mesh_of(auto& keys, Is<SolidWall> auto& solid, Part MeshShape::*part)
{
    constexpr std::size_t mesh = 3;
    keys.select(solid.shape, mesh);
    auto& shape = std::get<mesh>(solid.shape);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(solid)>>) {
        (shape.*part).emplace();
    }
    return shape;
}

/// The shape of a wall and its keys.
void geometry_keys(auto& keys, Is<Wall> auto& wall, TerrainKeys& given)
{
    constexpr std::size_t round = 2;
    constexpr std::size_t solid = 3;
    constexpr std::size_t mesh = 6;
    constexpr std::size_t terrain = 7;
    constexpr std::size_t prism = 8;
    constexpr ShapeWords words{"Lower corner of a basin or box.",
                               "Upper corner of a basin or box.",
                               "Edge lengths of a box, instead of min and max.",
                               "Radius of a sphere, cylinder or round basin.",
                               "Length of a cylinder, along x before rotation.",
                               "STL or OBJ file of a mesh; of a terrain an ESRI ASCII grid, points "
                               "x y z on a grid or a GeoTIFF; relative to the case file.",
                               MeshParts::may_overlap};
    const auto* held = std::get_if<SolidWall>(&wall.geometry);
    std::size_t kind = is_terrain(wall)  ? terrain
                       : is_prism(wall)  ? prism
                       : held != nullptr ? solid + held->shape.index()
                                         : wall.geometry.index();
    const bool known = keys.alternatives(
        "shape", kind,
        {"plane", "basin", "round_basin", "box", "sphere", "cylinder", "mesh", "terrain", "prism"},
        "Shape of the wall. \"plane\": point and normal; \"basin\": the inside of a box; "
        "\"round_basin\": the inside of a sphere, or of a circle in two dimensions; \"box\": min "
        "and max, or size and position; \"sphere\", \"cylinder\" and \"mesh\": as for bodies; "
        "\"terrain\": the ground from a height grid; \"prism\": a polygon between two heights, "
        "such as a building.",
        required, [&](std::size_t k) {
            keys.select(wall.geometry, std::min(k, solid));
            if (auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
                keys_of(keys, *plane);
            } else if (auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
                keys_of(keys, *basin);
            } else if (auto* block = std::get_if<SolidWall>(&wall.geometry); k == terrain) {
                terrain_keys(keys, mesh_of(keys, *block, &MeshShape::terrain), given, words.file);
            } else if (block != nullptr && k == prism) {
                prism_keys(keys, mesh_of(keys, *block, &MeshShape::prism));
            } else if (block != nullptr) {
                keys.select(block->shape, k - solid);
                placed_keys(keys, block->shape, block->centre, words);
            }
        });
    if (keys.applies(known && kind == round)) {
        keys.select(wall.geometry, round);
        auto& basin = std::get<RoundWall>(wall.geometry);
        keys.positive("radius", basin.radius, "m", words.radius, needed);
        keys.planar("position", basin.centre, "m", "", no_default);
    }
    if (keys.applies(known && kind >= solid && kind <= mesh)) {
        keys.select(wall.geometry, solid);
        rotation_keys(keys, std::get<SolidWall>(wall.geometry).rotation,
                      "Rotation about the centre of the shape.");
    }
}

inline void finish_ground(TableReader& table, const TerrainKeys& given,
                          const std::vector<LevelKeys>& levels, double spacing, Wall& wall)
{
    if (is_terrain(wall)) {
        auto& solid = std::get<SolidWall>(wall.geometry);
        finish_terrain(table, given, levels, spacing, std::get<MeshShape>(solid.shape));
    }
}

/// The areas of a terrain, after all keys that are no tables.
void ground_keys(auto& keys, Is<Wall> auto& wall, const TerrainKeys& given, double spacing)
{
    std::vector<LevelKeys> levels;
    if (keys.writes && is_terrain(wall)) {
        const Shape& shape = std::get<SolidWall>(wall.geometry).shape;
        for (const LevelArea& area : std::get<MeshShape>(shape).terrain->levels) {
            LevelKeys& level = levels.emplace_back();
            level.z = area.z;
            for (const Plan2& p : area.corners) {
                level.corners.emplace_back(p[0], p[1], 0);
            }
        }
    }
    if (keys.applies(is_terrain(wall))) {
        keys.tables("level",
                    "A level area of a terrain, such as a quay or a yard whose edges the grid "
                    "smooths: within its polygon the ground has the height z.",
                    levels);
    }
    keys.rule(finish_ground, given, levels, spacing, wall);
}

inline void check_manning(TableReader& table, const Wall& wall, const Scene& scene)
{
    constexpr double roughest = 1; // dense forest has 0.2
    if (!(wall.manning > 0)) {
        return;
    }
    if (wall.manning > roughest) {
        table.error("manning", fmt::format("{} is out of range, expected at most {} s/m^(1/3)",
                                           wall.manning, roughest));
    }
    if (!scene.fluid) {
        table.error("manning", "has no meaning without a fluid", "remove it, or add [fluid]");
    } else if (scene.fluid->walls.sticks) {
        table.error(
            "manning", "needs fluid that slips along walls",
            "leave `fluid.walls = \"no_slip\"` out: the formula is that of the mean velocity, "
            "which no-slip does not have at the bed");
    }
}

void keys_of(auto& keys, Is<Wall> auto& wall, double gravity, const Scene& scene)
{
    keys.rule(number_name, "wall", wall.name);
    keys.text("name", wall.name, "Name in results; unique among walls and bodies.",
              "wall.1, wall.2 ...");
    keys.rule(check_name, "name", wall.name);
    keys.rule(claim_name, wall.name);
    TerrainKeys given; // of the ground, which is made when its areas are read as well
    geometry_keys(keys, wall, given);
    keys.text("material", wall.material, "Name of the material, for contact.pair.");
    keys.rule(check_material, wall.material);
    if (keys.shows(wall.manning > 0)) {
        keys.not_negative("manning", wall.manning, "",
                          "Manning's roughness coefficient n of the bed [s/m^(1/3)]: 0.025 for a "
                          "natural channel, 0.015 for concrete. The walls must be free-slip.");
    }
    keys.rule(check_manning, wall, scene);
    keys.table("motion", "Motion of the wall; without this table the wall is fixed.", wall.motion,
               wall, gravity, scene);
    ground_keys(keys, wall, given, scene.spacing);
}

} // namespace hyoryu
