// SPDX-License-Identifier: MIT
#include "plan_thin.hpp"

#include "plan_warnings.hpp"
#include "scene/filling/walls.hpp"
#include "scene/surfaces/way_out.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hyoryu {

namespace {

// Plates are wider than this in proportion to their thickness; columns, which water flows round,
// are not.
constexpr double wide = 2;

// Of a box in space or in the plane; infinite if it is a column.
double thickness_of(const BoxShape& box, int dimensions)
{
    std::array<double, 3> edges{box.size.x(), box.size.y(), box.size.z()};
    if (dimensions == 2) {
        edges[1] = infinity;
    }
    std::ranges::sort(edges);
    return edges[1] > wide * edges[0] ? edges[0] : infinity;
}

// The width of a mesh along an axis, at a place within it, if it is less than `farthest`.
double width_at(const TriangleTree& tree, const Vec3& place, int axis, double farthest)
{
    return way_out(tree, place, {axis, 1}, farthest).distance +
           way_out(tree, place, {axis, -1}, farthest).distance;
}

// The thickness of a plate below the middle of a triangle; infinite if the mesh there is thicker
// than `farthest`, or not a plate [m].
double thickness_below(const TriangleTree& tree, const TriangleTree::Triangle& triangle,
                       double farthest)
{
    constexpr double opposite = -0.7; // cosine between the normals of the two sides of a plate
    constexpr double behind = 1e-6;   // of the thickness
    const auto corner = [&](std::size_t k) { return tree.corners[at(triangle.corner[k])]; };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    if (!normal.allFinite()) {
        return infinity;
    }
    Index axis = 0;
    const double share = normal.cwiseAbs().maxCoeff(&axis);
    const Vec3 place = (corner(0) + corner(1) + corner(2)) / 3 - behind * farthest * normal;
    const AxisWay way{static_cast<int>(axis), normal[axis] > 0 ? -1 : 1};
    const WayOut exit = way_out(tree, place, way, farthest / share);
    const double thickness = exit.distance * share;
    if (!(thickness < farthest) || exit.normal.dot(normal) > opposite) {
        return infinity;
    }
    const Vec3 middle = place - 0.5 * thickness * normal;
    for (int other = 0; other < 3; ++other) {
        if (other != axis &&
            width_at(tree, middle, other, 2 * wide * farthest) < wide * thickness) {
            return infinity;
        }
    }
    return thickness;
}

// The least thickness below the triangles of a mesh, of which at most some ten thousand are looked
// at; infinite if none is thinner than `farthest` [m].
double thickness_of(const MeshShape& mesh, double farthest)
{
    constexpr std::size_t many = 10000;
    const TriangleTree tree = triangle_tree(mesh.corners, mesh.triangles);
    const std::size_t step = 1 + tree.triangles.size() / many;
    double thinnest = infinity;
    for (std::size_t k = 0; k < tree.triangles.size(); k += step) {
        thinnest = std::min(thinnest, thickness_below(tree, tree.triangles[k], farthest));
    }
    return thinnest;
}

double thickness_of(const Wall& wall, int dimensions, double farthest)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    if (solid == nullptr) {
        return infinity;
    }
    if (const auto* box = std::get_if<BoxShape>(&solid->shape)) {
        return thickness_of(*box, dimensions);
    }
    const auto* mesh = std::get_if<MeshShape>(&solid->shape);
    return mesh != nullptr && !mesh->terrain ? thickness_of(*mesh, farthest) : infinity;
}

} // namespace

void warn_about_thin_walls(const Scene& scene, Plan& plan)
{
    if (!scene.fluid) {
        return;
    }
    constexpr double rounding = 1e-9;
    const double dp = scene.spacing;
    // Particles of fluid and of bodies keep nearly half a spacing from the surfaces.
    const double reached = (2 * scene.fluid->smoothing_ratio - 0.9) * dp;
    const bool any_moves =
        std::ranges::any_of(scene.bodies, [](const BodySettings& body) { return !body.fixed; });
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        const double plate = thickness_of(wall, scene.dimensions, reached);
        const double thin = std::min(plate, box_thickness(wall, scene.dimensions));
        const std::string size = fmt::format("{:.3g} m thick, ", thin);
        if (thin < dp * (1 - rounding)) {
            warn(scene, wall.place, table_of(wall, w),
                 fmt::format("wall \"{}\" is {}less than the spacing of {:.3g} m: the fluid on its "
                             "two sides is not well separated",
                             wall.name, size, dp),
                 "use a thicker wall, or a smaller `particles.spacing`", plan);
        } else if (any_moves && plate < reached * (1 - rounding)) {
            warn(scene, wall.place, table_of(wall, w),
                 fmt::format("wall \"{}\" is {}{:.3g} spacings: water that hits it pushes bodies "
                             "that touch its other side",
                             wall.name, size, thin / dp),
                 fmt::format("make the wall at least {:.3g} m thick, or choose a "
                             "`particles.spacing` of at most {:.3g} m",
                             reached, thin * dp / reached),
                 plan);
        }
    }
}

} // namespace hyoryu
