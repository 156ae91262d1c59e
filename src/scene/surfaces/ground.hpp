// SPDX-License-Identifier: MIT
// The ground of a case from above: how high the walls reach under a place or a footprint.
#pragma once

#include "hyoryu/geometry/outline.hpp"
#include "hyoryu/rigid/box_tree.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <array>
#include <string>
#include <vector>

namespace hyoryu {

/// The faces that look up, of all walls that do not move or of one of them, in a tree of boxes.
class Ground {
public:
    /// `on`: the name of a wall, or empty for all. A plane reaches `far` from the origin [m].
    Ground(const std::vector<Wall>& walls, const std::string& on, double far, int dimensions);

    /// The highest place within a convex polygon that runs counter-clockwise; -infinity without
    /// ground [m]. In two dimensions only x counts.
    double highest_under(const Ring& footprint) const { return range_under(footprint).highest; }

    /// The lowest place within such a polygon; infinity without ground [m].
    double lowest_under(const Ring& footprint) const { return range_under(footprint).lowest; }

    /// The height at a place; -infinity without ground [m].
    double height_at(const Plan2& place) const;

private:
    using Triangle = std::array<Vec3, 3>;
    struct Range {
        double lowest = infinity, highest = -infinity; // [m]
    };

    Range range_under(const Ring& footprint) const;
    void add(const Triangle& triangle);

    int dimensions_;
    std::vector<Triangle> triangles_;
    BoxTree tree_; // over the triangles
};

} // namespace hyoryu
