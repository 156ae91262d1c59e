// SPDX-License-Identifier: MIT
// The ground of a case from above: how high the walls reach under a place or a footprint.
#pragma once

#include "hyoryu/scene/shapes.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace hyoryu {

/// A corner of a footprint, or a place, seen from above.
using Plan2 = std::array<double, 2>;

/// The faces that look up, of all walls that do not move or of one of them, in buckets by place.
class Ground {
public:
    /// `on`: the name of a wall, or empty for all. A plane reaches `far` from the origin [m].
    Ground(const std::vector<Wall>& walls, const std::string& on, double far, int dimensions);

    /// The highest place within a convex polygon; -infinity without ground [m]. In two dimensions
    /// only x counts.
    double highest_under(const std::vector<Plan2>& footprint) const;

    /// The height at a place; -infinity without ground [m].
    double height_at(const Plan2& place) const;

private:
    using Triangle = std::array<Vec3, 3>;

    void add(const Triangle& triangle);
    void fill_buckets();
    std::vector<std::size_t> near(const Plan2& low, const Plan2& high) const;

    int dimensions_;
    std::vector<Triangle> triangles_;
    double bucket_ = 1; // edge [m]
    std::map<std::array<long, 2>, std::vector<std::size_t>> buckets_;
    std::vector<std::size_t> wide_; // triangles over many buckets
};

} // namespace hyoryu
