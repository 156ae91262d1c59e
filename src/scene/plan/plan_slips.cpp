// SPDX-License-Identifier: MIT
#include "hyoryu/scene/plan_slips.hpp"

#include "plan_warnings.hpp"

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

// Distances, in sizes of the scene, beyond which a body is probably misplaced, and size ratios that
// suggest other units.
constexpr double far_away = 3;
constexpr double very_far_away = 30; // together with others, too
constexpr double out_of_scale = 100;

double across(const Bounds& box, int dimensions)
{
    Vec3 size = box.max - box.min;
    size.y() = dimensions == 2 ? 0 : size.y();
    return box.empty() ? 0 : size.norm();
}

// Everything that has a size, but for one wall and one body.
Bounds rest_of(const Scene& scene, const Wall* wall, const BodySettings* body)
{
    Bounds rest;
    const auto add = [&](const Bounds& box) {
        if (!box.empty()) {
            rest.add(box);
        }
    };
    for (const FluidBlock& block : scene.fluid ? scene.fluid->blocks : std::vector<FluidBlock>{}) {
        add(bounds(placed(block, scene.dimensions)));
    }
    for (const Wall& other : scene.walls) {
        if (&other != wall) {
            add(bounds(other, scene.dimensions));
        }
    }
    // In a scene of bodies alone the first body represents all, so that thousands of copies need no
    // search.
    if (rest.empty() && !scene.bodies.empty() && &scene.bodies.front() != body) {
        add(bounds(placed(scene.bodies.front(), scene.dimensions)));
    }
    return rest;
}

void look_at_gravity(const Scene& scene, Plan& plan)
{
    if (scene.gravity.z() > 0 && scene.gravity.z() >= 0.5 * scene.gravity.norm()) {
        warn(scene, {}, "gravity", "points upward: z is up",
             fmt::format("write gravity = [{}, {}, {}]", scene.gravity.x(), scene.gravity.y(),
                         -scene.gravity.z()),
             plan);
    }
}

double distance(const Bounds& box, const Vec3& point)
{
    return (point - point.cwiseMax(box.min).cwiseMin(box.max)).norm();
}

double distance_to_others(const Scene& scene, std::size_t body)
{
    double nearest = infinity;
    for (std::size_t other = 0; other < scene.bodies.size(); ++other) {
        const double away = (scene.bodies[other].position - scene.bodies[body].position).norm();
        nearest = other == body ? nearest : std::min(nearest, away);
    }
    return nearest;
}

// Copies of one entry stand together: the first one speaks for them.
bool is_first_of_entry(const Scene& scene, std::size_t b)
{
    return b == 0 || scene.bodies[b].place.line == 0 ||
           scene.bodies[b].place.line != scene.bodies[b - 1].place.line;
}

void look_for_bodies_far_away(const Scene& scene, Plan& plan)
{
    const Bounds rest = rest_of(scene, nullptr, nullptr);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        const double away = rest.empty() ? 0 : distance(rest, body.position);
        const double size =
            std::max(across(rest, scene.dimensions),
                     across(bounds(placed(body, scene.dimensions)), scene.dimensions));
        if (away > far_away * size && is_first_of_entry(scene, b) &&
            (away > very_far_away * size || distance_to_others(scene, b) > far_away * size)) {
            return warn(
                scene, body.place, table_of(body, b) + ".position",
                fmt::format(
                    "body \"{}\" is {:.3g} m from the rest of the scene, whose size is {:.3g} m",
                    body.name, away, size),
                "check that its position is in metres and in the axes of the scene", plan);
        }
    }
}

void look_at_scale(const Shape& shape, const Bounds& box, const Bounds& rest, const Place& place,
                   const std::string& key, const Scene& scene, Plan& plan)
{
    const double size = across(box, scene.dimensions);
    const double others = across(rest, scene.dimensions);
    const auto* mesh = std::get_if<MeshShape>(&shape);
    if (mesh == nullptr || mesh->terrain) {
        return;
    }
    const std::string hint =
        "check `scale`, the factor from the numbers of the file to metres: 0.001 for millimetres";
    if (size < scene.spacing) {
        warn(scene, place, key + ".scale",
             fmt::format("the mesh is {:.3g} m across, less than the spacing of {:.3g} m", size,
                         scene.spacing),
             hint, plan);
    } else if (others > 0 && size > out_of_scale * others) {
        warn(scene, place, key + ".scale",
             fmt::format("the mesh is {:.3g} m across, the rest of the scene {:.3g} m", size,
                         others),
             hint, plan);
    }
}

void look_at_meshes(const Scene& scene, Plan& plan)
{
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        if (const auto* solid = std::get_if<SolidWall>(&wall.geometry)) {
            look_at_scale(solid->shape, bounds(wall, scene.dimensions),
                          rest_of(scene, &wall, nullptr), wall.place, table_of(wall, w), scene,
                          plan);
        }
    }
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        if (b == 0 || body.place.line != scene.bodies[b - 1].place.line) {
            look_at_scale(body.shape, bounds(placed(body, scene.dimensions)),
                          rest_of(scene, nullptr, &body), body.place, table_of(body, b), scene,
                          plan);
        }
    }
}

// Share of the cells of a body of particles that a second cell covers.
double doubled_share(const ParticleShape& shape)
{
    std::vector<Vec3> points = shape.points;
    std::ranges::sort(points, {}, [](const Vec3& p) { return p.x(); });
    const double edge = shape.spacing;
    double doubled = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = i + 1; j < points.size() && points[j].x() - points[i].x() < edge;
             ++j) {
            const Vec3 common = (edge - (points[j] - points[i]).cwiseAbs().array()).matrix();
            doubled += common.minCoeff() > 0 ? common.prod() : 0;
        }
    }
    return doubled / (static_cast<double>(points.size()) * edge * edge * edge);
}

void look_for_doubled_cells(const Scene& scene, Plan& plan)
{
    constexpr double noteworthy = 0.01;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        const auto* shape = std::get_if<ParticleShape>(&body.shape);
        if (shape == nullptr || (b > 0 && body.place.line == scene.bodies[b - 1].place.line)) {
            continue;
        }
        if (const double share = doubled_share(*shape); share > noteworthy) {
            warn(scene, body.place, table_of(body, b) + ".spacing",
                 fmt::format("the cells of the particles of body \"{}\", cubes with an edge of "
                             "{:.3g} m, overlap by {:.0f} % of their volume: volume, mass and "
                             "draft count this part twice",
                             body.name, shape->spacing, 100 * share),
                 "set `spacing` to the distance of the particles in the file", plan);
        }
    }
}

void look_for_coarse_bodies(const Scene& scene, Plan& plan)
{
    for (std::size_t b = 0; scene.fluid && b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        const bool copy = b > 0 && body.place.line == scene.bodies[b - 1].place.line;
        if (!copy && body.spacing > scene.spacing * (1 + 1e-9)) {
            warn(scene, body.place, table_of(body, b) + ".spacing",
                 fmt::format("the particles of body \"{}\" are {:.3g} m apart, those of the fluid "
                             "{:.3g} m: the body displaces too little water and floats too "
                             "deep",
                             body.name, body.spacing, scene.spacing),
                 "omit `spacing`, or give at most that of the fluid", plan);
        }
    }
}

// Water below the underside of the ground, at `bottom` [m], has nothing to stand on.
void look_for_water_below(const Wall& ground, double bottom, const Scene& scene, Plan& plan)
{
    for (std::size_t b = 0; scene.fluid && b < scene.fluid->blocks.size(); ++b) {
        const FluidBlock& block = scene.fluid->blocks[b];
        const double lowest = bounds(placed(block, scene.dimensions)).min.z();
        if (lowest < bottom) {
            warn(scene, block.place, fmt::format("fluid.block[{}]", b),
                 fmt::format("the block reaches down to {:.4g} m, below the underside of the "
                             "ground \"{}\" at {:.4g} m: water is also placed there",
                             lowest, ground.name, bottom),
                 "raise the lower side of the block, or lower `wall.bottom`", plan);
        }
    }
}

// And bodies, which do not even overlap the ground there.
void look_for_bodies_below(const Wall& ground, double bottom, const Scene& scene, Plan& plan)
{
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        if (bounds(placed(body, scene.dimensions)).max.z() < bottom) {
            warn(scene, body.place, table_of(body, b),
                 fmt::format("body \"{}\" lies below the underside of the ground \"{}\" at "
                             "{:.4g} m, which does not support it",
                             body.name, ground.name, bottom),
                 "raise it: z is up, and the `datum` of the ground shifts its zero level", plan);
        }
    }
}

void look_below_terrain(const Scene& scene, Plan& plan)
{
    for (const Wall& wall : scene.walls) {
        const auto* solid = std::get_if<SolidWall>(&wall.geometry);
        const auto* mesh = solid != nullptr ? std::get_if<MeshShape>(&solid->shape) : nullptr;
        if (mesh != nullptr && mesh->terrain) {
            look_for_water_below(wall, mesh->terrain->bottom, scene, plan);
            look_for_bodies_below(wall, mesh->terrain->bottom, scene, plan);
        }
    }
}

bool lies_inside(const Bounds& box, const Scene& scene, double slack)
{
    const DomainSettings& domain = *scene.domain;
    for (Index axis = 0; axis < 3; ++axis) {
        const bool flat = scene.dimensions == 2 && axis == 1;
        const bool periodic = domain.periodic[at(axis)];
        if (!flat && !periodic &&
            (box.min[axis] < domain.min[axis] - slack ||
             box.max[axis] > domain.max[axis] + slack)) {
            return false;
        }
    }
    return true;
}

// A closed side of a basin beyond the domain holds no water, since its particles are outside.
bool loses_a_side(const BasinWall& basin, const Scene& scene, double slack)
{
    const DomainSettings& domain = *scene.domain;
    for (std::size_t side = 0; side < basin.open.size(); ++side) {
        const auto axis = static_cast<Index>(side / 2);
        const bool flat = scene.dimensions == 2 && axis == 1;
        const bool beyond = side % 2 == 0 ? basin.min[axis] < domain.min[axis] - slack
                                          : basin.max[axis] > domain.max[axis] + slack;
        if (!basin.open[side] && !flat && !domain.periodic[side / 2] && beyond) {
            return true;
        }
    }
    return false;
}

} // namespace

std::string cut_by_domain(const Scene& scene)
{
    const double slack = scene.spacing * (1 + 1e-9);
    if (!scene.domain || !scene.fluid) {
        return {};
    }
    for (std::size_t b = 0; b < scene.fluid->blocks.size(); ++b) {
        if (!lies_inside(bounds(placed(scene.fluid->blocks[b], scene.dimensions)), scene, slack)) {
            return fmt::format("`fluid.block[{}]`", b);
        }
    }
    for (const Wall& wall : scene.walls) {
        const auto* basin = std::get_if<BasinWall>(&wall.geometry);
        if (basin != nullptr && loses_a_side(*basin, scene, slack)) {
            return fmt::format("a closed side of wall \"{}\"", wall.name);
        }
    }
    for (const BodySettings& body : scene.bodies) {
        if (!lies_inside(bounds(placed(body, scene.dimensions)), scene, slack)) {
            return fmt::format("body \"{}\"", body.name);
        }
    }
    return {};
}

void warn_about_slips(const Scene& scene, Plan& plan)
{
    look_at_gravity(scene, plan);
    look_for_bodies_far_away(scene, plan);
    look_at_meshes(scene, plan);
    look_for_doubled_cells(scene, plan);
    look_for_coarse_bodies(scene, plan);
    look_below_terrain(scene, plan);
    const std::string cut = cut_by_domain(scene);
    if (!cut.empty()) {
        warn(scene, {}, "domain",
             fmt::format("the domain ends within the scene: {} reaches beyond it, and fluid "
                         "there is removed from the run",
                         cut),
             "omit [domain], or enlarge it to contain the scene", plan);
    }
}

} // namespace hyoryu
