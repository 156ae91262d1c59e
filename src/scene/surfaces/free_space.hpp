// SPDX-License-Identifier: MIT
// Where a block of fluid may be filled in: outside of walls and of the blocks before it.
#pragma once

#include "hyoryu/scene/scene.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// The space that is free at time 0; distances in it are exact.
class FreeSpace {
public:
    /// Space outside walls and bodies.
    explicit FreeSpace(const Scene& scene);
    /// Space outside walls and the blocks before this one; for still water, which goes round them,
    /// all blocks of another shape.
    FreeSpace(const Scene& scene, std::size_t block);

    /// Numbers of obstacles: of all, of those that may be within a distance of a point [m].
    std::span<const int> all() const { return all_; }
    std::vector<int> about(const Vec3& point, double distance) const;

    /// The nearest surface of some obstacles, with its normal into the free space; distance
    /// infinity where the point is farther than `farthest` [m] from all of them, on either side.
    NearestPlace nearest(const Vec3& point, std::span<const int> among,
                         double farthest = infinity) const;
    /// Signed distance from the occupied space [m], negative inside it.
    double clearance(const Vec3& point) const { return nearest(point, all_).distance; }
    bool is_in_wall(const Vec3& point) const;
    int dimensions() const { return dimensions_; }

private:
    void number_obstacles();
    Vec3 from(const SolidSurface& solid, const Vec3& point) const;

    std::vector<SolidSurface> obstacles_; // walls, then the others
    std::size_t walls_ = 0;
    int dimensions_ = 3;
    std::vector<int> all_;
};

/// Moves a point to a distance from those surfaces of some obstacles that are nearer; false if it
/// is in one of them afterwards. `farthest`: as for nearest(), more than the distance.
bool step_off(const FreeSpace& space, std::span<const int> among, double distance, Vec3& point,
              double farthest = infinity);

} // namespace hyoryu
