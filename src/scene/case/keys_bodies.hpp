// SPDX-License-Identifier: MIT
// The keys of bodies.
#pragma once

#include "keys_shapes.hpp"

#include "hyoryu/scene/mass_faults.hpp"
#include "hyoryu/scene/shapes.hpp"
#include "hyoryu/scene/voxels.hpp"

#include <utility>

namespace hyoryu {

/// [body.copies]
struct BodyCopies {
    std::array<std::int64_t, 3> count{};
    Vec3 pitch{0, 0, 0}; // [m]
};

inline constexpr Index most_bodies = 100000;
inline constexpr Index most_copied_triangles = 20000000;

inline bool too_many(const std::vector<BodySettings>& bodies)
{
    return static_cast<Index>(bodies.size()) > most_bodies;
}

inline Index triangle_count(const Shape& shape)
{
    const auto* mesh = std::get_if<MeshShape>(&shape);
    return mesh != nullptr ? static_cast<Index>(mesh->triangles.size()) : 0;
}

// The boxes of the cubes, or the cubes themselves if they are on no common lattice.
inline void make_boxes(ParticleShape& shape)
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

/// Moves a mesh to its centre of mass, about which bodies are given.
inline void centre_mesh(MeshShape& shape)
{
    const Vec3 centre = solid_properties({shape.corners, shape.triangles}).centroid;
    for (Vec3& corner : shape.corners) {
        corner -= centre;
    }
}

inline void find_mass(TableReader& table, const std::optional<double>& density,
                      const std::optional<double>& mass, BodySettings& body)
{
    const bool both = table.has("mass");
    if (table.has("density") == both) {
        table.error(both ? "mass" : "density", both ? "give either `density` or `mass`, not both"
                                                    : "is missing: give `density` or `mass`");
    }
    body.density = density.value_or(0);
    body.mass = mass.value_or(0);
}

inline void finish_matter(TableReader& table, BodySettings& body)
{
    if (auto* mesh = std::get_if<MeshShape>(&body.shape)) {
        centre_mesh(*mesh);
    }
    if (auto* particles = std::get_if<ParticleShape>(&body.shape)) {
        particles->spacing = body.spacing;
        make_boxes(*particles);
    }
    const double body_volume = volume(body.shape, table.reading().dimensions);
    if (body.density > 0) {
        body.mass = body.density * body_volume;
    } else {
        body.density = body.mass / body_volume;
    }
}

inline void refuse_masses_of_fixed(TableReader& table, const BodySettings& body)
{
    for (const char* key : {"center_of_mass", "inertia"}) {
        if (body.fixed && table.has(key)) {
            table.error(key, "has no meaning for a fixed body",
                        "omit it; `position` is then the middle of the shape");
        }
    }
}

inline void check_velocities(TableReader& table, const BodySettings& body)
{
    const Vec3& w = body.angular_velocity;
    if (table.reading().dimensions == 2 && (w.x() != 0 || w.z() != 0)) {
        table.error("angular_velocity", "in two dimensions bodies rotate about y",
                    "write [0, value, 0]");
    }
    if (body.fixed && (body.velocity.norm() > 0 || w.norm() > 0)) {
        table.error(body.velocity.norm() > 0 ? "velocity" : "angular_velocity",
                    "has no meaning for a fixed body", "remove it, or `fixed = true`");
    }
}

inline void check_locks(TableReader& table, const BodySettings& body)
{
    if (body.fixed && std::ranges::find(body.locks, true) != body.locks.end()) {
        table.error("locks", "has no meaning for a fixed body", "remove it, or `fixed = true`");
    }
    for (Index k = 0; k < 3; ++k) {
        const auto axis = at(k);
        if (body.locks[axis] && body.velocity[k] != 0) {
            table.error("velocity", fmt::format("is not 0 along {}, which is locked", "xyz"[k]),
                        "write 0, or remove the lock");
        }
        if (body.locks[3 + axis] && body.angular_velocity[k] != 0) {
            table.error("angular_velocity",
                        fmt::format("is not 0 about {}, which is locked", "xyz"[k]),
                        "write 0, or remove the lock");
        }
    }
}

inline void check_mass(TableReader& table, const BodySettings& body)
{
    const int dimensions = table.reading().dimensions;
    if (table.mistaken()) {
        return;
    }
    if (const std::string fault = extent_fault(body, dimensions); !fault.empty()) {
        table.error("shape", fault, "sizes are in metres");
    }
    if (table.sound("center_of_mass")) {
        const std::string fault = centre_fault(body, dimensions);
        if (!fault.empty()) {
            table.error("center_of_mass", fault,
                        "it is measured from the middle of the shape, in the axes of the body");
        }
    }
    if (table.sound("inertia")) {
        const std::string fault = inertia_fault(body, dimensions);
        if (!fault.empty()) {
            table.error("inertia", fault, "[Ixx, Iyy, Izz] about the centre of mass, in kg m2");
        }
    }
}

inline void append_copies(TableReader& table, const BodyCopies& copies, BodySettings& body,
                          std::vector<BodySettings>& bodies)
{
    bool& names_known = table.reading().names_known; // those of the copies
    const bool knew_names = std::exchange(names_known, false);
    if (!table.sound("count") || !table.sound("pitch") || too_many(bodies)) {
        return;
    }
    const auto& count = copies.count;
    if (table.reading().dimensions == 2 && count[1] > 1) {
        table.error(
            "count",
            fmt::format("{} along y, which a case of two dimensions does not have", count[1]),
            "write 1 there; copies along z lie above each other");
        return;
    }
    const std::int64_t total = count[0] * count[1] * count[2];
    if (total > most_bodies || total * triangle_count(body.shape) > most_copied_triangles) {
        table.error("count",
                    fmt::format("{} x {} x {} are too many, at most {} bodies and {} triangles",
                                count[0], count[1], count[2], most_bodies, most_copied_triangles));
        return;
    }
    for (Index k = 0; k < 3; ++k) {
        if (count[at(k)] > 1 && !(std::abs(copies.pitch[k]) > 0)) {
            table.error("pitch", fmt::format("copies along {} would coincide", "xyz"[k]),
                        "make it at least as long as the body");
        }
    }
    names_known = knew_names;
    const BodySettings first = body;
    for (std::int64_t n = 0; n < total; ++n) {
        const std::int64_t i = n % count[0];
        const std::int64_t j = n / count[0] % count[1];
        const std::int64_t k = n / (count[0] * count[1]);
        const Vec3 step(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        body.name = fmt::format("{}.{}", first.name, n + 1);
        body.position = first.position + step.cwiseProduct(copies.pitch);
        if (n + 1 < total) {
            bodies.push_back(body);
        }
    }
}

inline void claim_names(TableReader& table, const BodySettings& body,
                        const std::vector<BodySettings>& bodies, std::size_t before)
{
    for (std::size_t k = before; k < bodies.size(); ++k) {
        claim_name(table, bodies[k].name);
    }
    claim_name(table, body.name);
}

inline void check_bodies(TableReader& root, const std::vector<BodySettings>& bodies)
{
    if (too_many(bodies)) {
        root.error("body", fmt::format("the case has more than {} bodies", most_bodies));
    }
}

void keys_of(auto& keys, Is<BodyCopies> auto& copies, auto& body, auto& bodies)
{
    constexpr double most = 100000;
    keys.integer("count", copies.count, 1, most, "1 .. 100000",
                 "Number of bodies along x, y and z, including the first body.", required);
    keys.vector("pitch", copies.pitch, "m", "Distance from one body to the next along x, y and z.",
                required);
    keys.rule(append_copies, copies, body, bodies);
}

/// The shape of a body and its mass, by its density where that gives back the bits of the mass.
void matter_keys(auto& keys, Is<BodySettings> auto& body, int dimensions)
{
    std::size_t kind = body.shape.index();
    keys.alternatives(
        "shape", kind, {"box", "sphere", "cylinder", "mesh", "particles"},
        "Shape of the body. \"box\": size; \"sphere\": radius, a disc in 2-D; \"cylinder\": radius "
        "and length along its x axis, a rectangle in 2-D; \"mesh\": a closed surface from a file; "
        "\"particles\": an aggregate of cubes with edges of body.spacing about the points of a "
        "file, in 3-D.",
        required, [&](std::size_t k) {
            keys.select(body.shape, k);
            shape_keys(keys, body.shape,
                       {.size = "Edge lengths of a box.",
                        .radius = "Radius of a sphere or cylinder.",
                        .length = "Length of a cylinder.",
                        .file = "STL or OBJ file of a mesh, or text file of particle centres (x, "
                                "y, z in m, one per line), relative to the case file."});
        });
    std::optional<double> density;
    std::optional<double> mass;
    if (keys.writes) {
        const bool by_density = body.density * volume(body.shape, dimensions) == body.mass;
        (by_density ? density : mass) = by_density ? body.density : body.mass;
    }
    keys.positive("density", density, "kg/m3", "Density; give either density or mass.");
    keys.positive("mass", mass, "kg",
                  "Mass, per metre of width in 2-D; give either density or mass.");
    keys.rule(find_mass, density, mass, body);
}

void keys_of(auto& keys, Is<BodySettings> auto& body, auto& scene)
{
    const std::size_t before = scene.bodies.size();
    keys.rule(number_name, "body", body.name);
    keys.text("name", body.name, "Name in results; unique among walls and bodies.",
              "body.1, body.2 ...");
    keys.rule(check_name, "name", body.name);
    matter_keys(keys, body, scene.dimensions);
    keys.planar("position", body.position, "m", "Initial position of the centre of mass.",
                required);
    rotation_keys(keys, body.rotation, "Initial rotation about the centre of mass.");
    keys.planar("velocity", body.velocity, "m/s", "Initial velocity.");
    keys.vector("angular_velocity", body.angular_velocity, "rad/s",
                "Initial angular velocity, in world axes.");
    keys.rule(inherit, body.spacing, scene.spacing);
    keys.positive("spacing", body.spacing, "m",
                  "Spacing of the particles of the body, on which the fluid acts.",
                  "particles.spacing");
    keys.rule(finish_matter, body);
    keys.planar("center_of_mass", body.centre_of_mass, "m",
                "Position of the centre of mass relative to the centre of the shape (for a mesh, "
                "the centre of its volume), in body axes.",
                "[0.0, 0.0, 0.0]");
    keys.vector("inertia", body.inertia, "kg m2",
                "Moments of inertia [Ixx, Iyy, Izz] about the centre of mass, in body axes; in 2-D "
                "only Iyy is used.",
                "of the uniform shape about its middle");
    keys.rule(check_mass, body);
    keys.text("material", body.material, "Name of the material, for contact.pair.");
    keys.rule(check_material, body.material);
    keys.flag("fixed", body.fixed, "Whether the body is fixed.");
    keys.rule(check_velocities, body);
    keys.rule(refuse_masses_of_fixed, body);
    keys.choice("stands", body.sealed, {"open", "sealed"},
                "Whether water seeps into the joint between a standing body and its support. "
                "\"open\": water enters from the rim and lifts the body; \"sealed\": the joint "
                "stays dry, as under a body that is glued or embedded in the ground.");
    keys.flags("locks", body.locks, {"x", "y", "z", "rx", "ry", "rz"},
               "World axes along which the body cannot move (x, y, z) or about which it cannot "
               "rotate (rx, ry, rz).");
    keys.rule(check_locks, body);
    std::optional<BodyCopies> copies;
    keys.table("copies",
               "A regular array of equal bodies named NAME.1, NAME.2 ..., numbered along x first.",
               copies, body, scene.bodies);
    keys.rule(claim_names, body, scene.bodies, before);
}

} // namespace hyoryu
