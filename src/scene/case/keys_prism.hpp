// SPDX-License-Identifier: MIT
// The keys of a prism: a polygon seen from above between two heights.
#pragma once

#include "keys_shapes.hpp"

#include "hyoryu/geometry/outline.hpp"

namespace hyoryu {

inline void make_prism(TableReader& table, const std::vector<Vec3>& corners, MeshShape& shape)
{
    PrismOutline& outline = *shape.prism;
    if (refuse_flat(table, "shape", "prisms are") || !table.sound("corners") ||
        !table.sound("bottom") || !table.sound("top")) {
        return;
    }
    for (const Vec3& corner : corners) {
        outline.corners.push_back({corner.x(), corner.y()});
    }
    if (!(outline.top > outline.bottom)) {
        table.error("top", "must be above `bottom`", "z points up: exchange the two");
        return;
    }
    if (outline.corners.size() > most_corners) {
        table.error("corners", fmt::format("has {} corners, at most {} are supported",
                                           outline.corners.size(), most_corners));
        return;
    }
    Mesh mesh = prism_mesh(outline);
    const std::string fault = mesh.triangles.empty() ? "it crosses itself" : closure_fault(mesh);
    if (!fault.empty()) {
        table.error("corners", fmt::format("the polygon does not enclose an area: {}", fault),
                    "the corners of one polygon, one after the other along its edge; a courtyard "
                    "is joined to the outer edge by an edge that is passed in both directions");
        return;
    }
    shape.corners = std::move(mesh.corners);
    shape.triangles = std::move(mesh.triangles);
}

/// A polygon between two heights; `shape.prism` is there.
void prism_keys(auto& keys, Is<MeshShape> auto& shape)
{
    auto& outline = *shape.prism;
    std::vector<Vec3> corners;
    for (const Plan2& p : outline.corners) {
        corners.emplace_back(p[0], p[1], 0);
    }
    constexpr int fewest = 3;
    keys.path("corners", corners, "m",
              "Corners of a prism in plan view, [x, y, z] each; z is ignored. An edge that is "
              "passed in both directions has no side face: it connects a courtyard to the outside.",
              needed, fewest);
    keys.number("bottom", outline.bottom, "m", "z of the lower side of a prism.", needed);
    keys.number("top", outline.top, "m", "z of the upper side of a prism.", needed);
    keys.rule(make_prism, corners, shape);
}

} // namespace hyoryu
