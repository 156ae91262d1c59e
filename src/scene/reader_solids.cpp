// SPDX-License-Identifier: MIT
// Walls, bodies and their contact.
#include "hyoryu/scene/shapes.hpp"
#include "reader.hpp"

#include "hyoryu/scene/reader_hint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hyoryu {

namespace {

constexpr Index most_bodies = 100000;
constexpr Index most_copied_triangles = 20000000;

PlaneWall read_plane(TableReader& table)
{
    PlaneWall plane;
    plane.point = table.planar("point");
    plane.normal = table.find_direction("normal").value_or(plane.normal);
    return plane;
}

BasinWall read_basin(TableReader& table)
{
    BasinWall basin;
    table.require("min");
    table.require("max");
    const auto low = table.find_planar("min");
    const auto high = table.find_planar("max");
    constexpr std::array<std::string_view, 6> sides{"-x", "+x", "-y", "+y", "-z", "+z"};
    for (const std::string& side : table.texts("open")) {
        basin.open[static_cast<std::size_t>(std::find(sides.begin(), sides.end(), side) -
                                            sides.begin())] = true;
    }
    basin.thickness = table.find_number("thickness");
    if (low && high) {
        basin.min = *low;
        basin.max = *high;
        const Vec3 size = *high - *low;
        const bool flat = table.reading().dimensions == 2;
        if (!(size.x() > 0 && size.z() > 0 && (flat || size.y() > 0))) {
            table.error("max", "must lie above `min` in every direction");
        }
    }
    return basin;
}

/// The name typed, or one made of the kind and the number.
std::string read_name(TableReader& table, std::string_view kind, std::size_t number)
{
    const std::string name = table.text("name");
    if (!table.has("name")) {
        return fmt::format("{}.{}", kind, number);
    }
    check_name(table, "name", name);
    return name;
}

/// The material named, or none.
std::string read_material(TableReader& table)
{
    const std::string material = table.text("material");
    if (!material.empty()) {
        check_name(table, "material", material);
    }
    return material;
}

/// Notes a mistake if a wall or body of that name stands in the case already.
void claim_name(TableReader& table, const std::string& name)
{
    const auto [at, is_new] = table.reading().names.emplace(name, table.place().line);
    if (!is_new) {
        const std::string first =
            at->second > 0 ? fmt::format(", first in line {}", at->second) : "";
        table.error("name", fmt::format("the name \"{}\" stands twice{}", name, first),
                    "names of walls and bodies must differ");
    }
}

RoundWall read_round(TableReader& table)
{
    table.require("radius");
    return {table.planar("position"), table.number("radius")};
}

Wall read_wall(TableReader& table, std::size_t number, double gravity)
{
    Wall wall;
    wall.place = table.place();
    wall.name = read_name(table, "wall", number);
    claim_name(table, wall.name);
    const std::string kind = table.choice("shape");
    if (kind == "plane") {
        wall.geometry = read_plane(table);
    } else if (kind == "basin") {
        wall.geometry = read_basin(table);
    } else if (kind == "round_basin") {
        wall.geometry = read_round(table);
    } else if (!kind.empty()) {
        PlacedShape placed = read_placed_shape(table, kind);
        wall.geometry = SolidWall{std::move(placed.shape), placed.centre, placed.rotation};
    }
    wall.material = read_material(table);
    wall.motion = read_motion(table.table("motion"), gravity);
    table.finish();
    return wall;
}

void read_mass(TableReader& table, BodySettings& body)
{
    const auto density = table.find_number("density");
    const auto mass = table.find_number("mass");
    if (table.has("density") == table.has("mass")) {
        const bool both = table.has("mass");
        table.error(both ? "mass" : "density", both ? "give either `density` or `mass`, not both"
                                                    : "is missing: give `density` or `mass`");
        return;
    }
    const double body_volume = volume(body.shape, table.reading().dimensions);
    if (density) {
        body.density = *density;
        body.mass = *density * body_volume;
    } else if (mass) {
        body.mass = *mass;
        body.density = *mass / body_volume;
    }
}

void read_state(TableReader& table, BodySettings& body)
{
    body.velocity = table.planar("velocity");
    body.angular_velocity = table.vector("angular_velocity");
    const Vec3& w = body.angular_velocity;
    if (table.reading().dimensions == 2 && (w.x() != 0 || w.z() != 0)) {
        table.error("angular_velocity", "in two dimensions bodies turn about y",
                    "write [0, value, 0]");
    }
    body.fixed = table.flag("fixed");
    if (body.fixed && (body.velocity.norm() > 0 || w.norm() > 0)) {
        table.error(body.velocity.norm() > 0 ? "velocity" : "angular_velocity",
                    "has no meaning for a fixed body");
    }
    body.sealed = table.choice("stands") == "sealed";
    constexpr std::array<std::string_view, 6> directions{"x", "y", "z", "rx", "ry", "rz"};
    for (const std::string& lock : table.texts("locks")) {
        body.locks[static_cast<std::size_t>(std::find(directions.begin(), directions.end(), lock) -
                                            directions.begin())] = true;
    }
}

Index triangle_count(const Shape& shape)
{
    const auto* mesh = std::get_if<MeshShape>(&shape);
    return mesh != nullptr ? static_cast<Index>(mesh->triangles.size()) : 0;
}

/// The body, or the block of its copies, x fastest.
void append_copies(TableReader copies, const BodySettings& body, std::vector<BodySettings>& bodies)
{
    const std::size_t before = bodies.size();
    bodies.push_back(body);
    if (!copies.present()) {
        return;
    }
    std::vector<std::int64_t> count = copies.integers("count");
    const auto pitch = copies.find_vector("pitch");
    copies.finish();
    if (count.empty() || !pitch) {
        return;
    }
    if (copies.reading().dimensions == 2) {
        count[1] = 1;
    }
    const std::int64_t total = count[0] * count[1] * count[2];
    if (total > most_bodies || total * triangle_count(body.shape) > most_copied_triangles) {
        copies.error("count",
                     fmt::format("{} x {} x {} are too many, at most {} bodies and {} triangles",
                                 count[0], count[1], count[2], most_bodies, most_copied_triangles));
        return;
    }
    for (Index k = 0; k < 3; ++k) {
        if (count[static_cast<std::size_t>(k)] > 1 && !(std::abs((*pitch)[k]) > 0)) {
            copies.error("pitch", fmt::format("copies along {} would coincide", "xyz"[k]));
        }
    }
    bodies.resize(before);
    for (std::int64_t n = 0; n < total; ++n) {
        const std::int64_t i = n % count[0];
        const std::int64_t j = n / count[0] % count[1];
        const std::int64_t k = n / (count[0] * count[1]);
        const Vec3 step(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        bodies.push_back(body);
        bodies.back().name = fmt::format("{}.{}", body.name, n + 1);
        bodies.back().position += step.cwiseProduct(*pitch);
    }
}

void read_body(TableReader& table, std::size_t number, Scene& scene)
{
    BodySettings body;
    body.place = table.place();
    body.name = read_name(table, "body", number);
    const std::string kind = table.choice("shape");
    body.spacing = table.find_number("spacing").value_or(scene.spacing);
    if (!kind.empty()) {
        body.shape = read_body_shape(table, kind, body.spacing);
    }
    read_mass(table, body);
    body.position = table.planar("position");
    body.rotation = read_rotation(table);
    read_state(table, body);
    body.material = read_material(table);
    const std::size_t before = scene.bodies.size();
    append_copies(table.table("copies"), body, scene.bodies);
    for (std::size_t k = before; k < scene.bodies.size(); ++k) {
        claim_name(table, scene.bodies[k].name);
    }
    table.finish();
}

/// The materials that walls and bodies name.
std::set<std::string> materials_of(const Scene& scene)
{
    std::set<std::string> materials;
    for (const Wall& wall : scene.walls) {
        materials.insert(wall.material);
    }
    for (const BodySettings& body : scene.bodies) {
        materials.insert(body.material);
    }
    materials.erase("");
    return materials;
}

MaterialPair read_pair(TableReader& table, const Scene& scene,
                       const std::set<std::string>& materials)
{
    MaterialPair pair;
    const std::vector<std::string> names = table.texts("materials");
    const std::vector<std::string_view> known(materials.begin(), materials.end());
    for (std::size_t k = 0; k < names.size() && k < 2; ++k) {
        pair.materials[k] = names[k];
        if (materials.count(names[k]) == 0) {
            const std::string near = did_you_mean(names[k], known);
            table.error_at(
                "materials", k, fmt::format("no wall or body has the material \"{}\"", names[k]),
                near.empty() && !known.empty() ? "named are: " + quoted_list(known) : near);
        }
    }
    pair.restitution = table.find_number("restitution").value_or(scene.contact.restitution);
    pair.friction = table.find_number("friction").value_or(scene.contact.friction);
    pair.stiffness = table.find_number("stiffness");
    table.finish();
    return pair;
}

ImpactLaw law_named(const std::string& name)
{
    return name == "paper"          ? ImpactLaw::paper
           : name == "simultaneous" ? ImpactLaw::simultaneous
                                    : ImpactLaw::coupled;
}

PenaltyParameters read_penalty(TableReader table)
{
    PenaltyParameters penalty;
    penalty.stiffness = table.number("stiffness");
    penalty.damping = table.number("damping");
    penalty.step = table.number("step");
    table.finish();
    return penalty;
}

void read_method(TableReader& table, ContactSettings& contact)
{
    const std::string method = table.choice("method");
    contact.law = law_named(table.choice("law"));
    contact.locating_share = table.number("locating_share");
    TableReader springs = table.table("penalty");
    const bool has_springs = springs.present();
    const PenaltyParameters penalty = read_penalty(std::move(springs));
    if (method == "penalty") {
        contact.penalty = penalty;
        if (table.has("law")) {
            table.error("law", "has no meaning with method = \"penalty\"",
                        "laws are of the impulse method: leave `law` out");
        }
        if (table.has("locating_share")) {
            table.error("locating_share", "has no meaning with method = \"penalty\"",
                        "the penalty method locates no impacts: leave `locating_share` out");
        }
    } else if (method == "impulse" && has_springs) {
        table.error("penalty", "has no meaning with method = \"impulse\"",
                    "leave the table out, or write method = \"penalty\"");
    }
}

bool same_pair(const MaterialPair& a, const MaterialPair& b)
{
    return a.materials == b.materials ||
           (a.materials[0] == b.materials[1] && a.materials[1] == b.materials[0]);
}

} // namespace

void read_walls(TableReader& root, Scene& scene)
{
    std::size_t number = 0;
    for (TableReader& table : root.tables("wall")) {
        scene.walls.push_back(read_wall(table, ++number, scene.gravity.norm()));
    }
}

void read_bodies(TableReader& root, Scene& scene)
{
    std::size_t number = 0;
    for (TableReader& table : root.tables("body")) {
        read_body(table, ++number, scene);
        if (static_cast<Index>(scene.bodies.size()) > most_bodies) {
            root.error("body", fmt::format("the case has more than {} bodies", most_bodies));
            return;
        }
    }
}

void read_contact(TableReader table, Scene& scene)
{
    read_method(table, scene.contact);
    // Both methods take it, so that one case can be run with either.
    scene.contact.restitution = table.number("restitution");
    scene.contact.friction = table.number("friction");
    const std::set<std::string> materials = materials_of(scene);
    for (TableReader& entry : table.tables("pair")) {
        MaterialPair pair = read_pair(entry, scene, materials);
        for (const MaterialPair& other : scene.contact.pairs) {
            if (!pair.materials[0].empty() && same_pair(pair, other)) {
                entry.error("materials", "this pair stands in the case already");
            }
        }
        scene.contact.pairs.push_back(std::move(pair));
    }
    table.finish();
}

} // namespace hyoryu
