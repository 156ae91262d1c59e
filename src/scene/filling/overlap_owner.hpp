// SPDX-License-Identifier: MIT
// Which of several walls that overlap has the particles at a place.
#pragma once

#include "hyoryu/rigid/box_tree.hpp"
#include "hyoryu/scene/scene.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// Of each wall: the first one that moves as it does, maybe itself.
std::vector<std::size_t> first_alike(const std::vector<Wall>& walls);

/// Whose a place in the layers of a wall is.
enum class Owner {
    alone, // of this wall: it lies within no other one with a better claim, or as good a one
    best,  // of this wall, whose claim is the best of all within which it lies
    other
};

/// Decides for places within several walls that move alike. The layers of particles begin at the
/// surface of their own wall. Where another wall reaches farther out, this surface is hidden, and
/// water would see layers that begin too deep. A place therefore belongs to the wall whose surface
/// ends the shortest way out of all of them: from the place to the nearest point of the surface of
/// a wall and, if this lies within another one, on to the nearest point of the surface of that.
/// Where two ways are of the same length, as below the side of an obstacle that reaches into the
/// ground, no wall has a better claim. Walls count where they have layers, and meshes not at all.
class OverlapOwner {
public:
    /// `surfaces`: of each wall; they must outlive this. `layers`: thickness of the layers [m].
    OverlapOwner(const Scene& scene, std::span<const SolidSurface> surfaces, double layers);

    /// Whose a place in the layers of a wall is.
    Owner owner(std::size_t wall, const Vec3& place) const;

private:
    /// A wall that has layers at a place.
    struct Claim {
        std::size_t wall = 0;
        double depth = 0; // of the place in it [m]
        double way = 0;   // length of the shortest way out that its surface ends [m]
    };
    std::vector<Claim> claims_of_others(std::size_t wall, const Vec3& place) const;
    void find_ways(const Vec3& place, std::vector<Claim>& claims) const;

    std::span<const SolidSurface> surfaces_;
    double layers_ = 0, tie_ = 0;    // [m]
    std::vector<std::size_t> first_; // of each wall: the first one that moves as it does
    std::vector<std::size_t> wide_;  // walls without bounds: planes and basins
    std::vector<std::size_t> solid_; // those with bounds
    BoxTree boxes_;                  // of these
};

} // namespace hyoryu
