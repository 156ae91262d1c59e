// SPDX-License-Identifier: MIT
// Moving walls within fixed ones.
//
// A part of a moving wall may lie within a fixed wall: the foot of a paddle in the floor, a piston
// that starts in line with the side of a basin, or a platform that rises out of the floor. What two
// walls share must act on the water once, with the velocity of the surface that bounds the water
// there. Where the wall moves across the surface of the fixed wall, its own surface comes out:
// there the moving wall acts. Water that follows a platform would otherwise recede from hidden
// particles at rest, and lose its density and pressure. Where it moves along that surface, this
// surface is bared behind it: there the fixed wall acts. A particle of the other wall has the
// volume of the part of its cell outside of the one that acts, which changes as the wall moves.
#pragma once

#include "hyoryu/scene/scene.hpp"
#include "hyoryu/scene/solid_surface.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hyoryu {

/// The periodic directions of a scene; length 0 along the others [m].
struct Periods {
    Vec3 first{0, 0, 0}, length{0, 0, 0};
};

Periods periods_of(const Scene& scene);

/// Calls f(image) for a place in the first period and for those of its images that are within
/// `reach` of an edge of it [m]. `first`: its lower corner [m]; `length`: as of Periods.
void over_images(const Vec3& own, const Vec3& first, const Vec3& length, double reach,
                 const auto& f)
{
    std::array<int, 3> low{}, high{};
    for (int a = 0; a < 3; ++a) {
        const double from_low = own[a] - first[a];
        low[at(a)] = length[a] > 0 && length[a] - from_low < reach ? -1 : 0;
        high[at(a)] = length[a] > 0 && from_low < reach ? 1 : 0;
    }
    for (int i = low[0]; i <= high[0]; ++i) {
        for (int j = low[1]; j <= high[1]; ++j) {
            for (int k = low[2]; k <= high[2]; ++k) {
                f(Vec3(own + Vec3(i, j, k).cwiseProduct(length)));
            }
        }
    }
}

/// A wall that may take part of a cell.
struct CoverWall {
    const SolidSurface* solid = nullptr;
    Vec3 centre{0, 0, 0};   // where it is [m]
    Vec3 left_out{0, 0, 0}; // where its normal is along this unit vector it does not count
};

/// The share of a cell about a place, or about its images in the domain, that lies outside of the
/// walls, by 27 parts of it, of which each wall cuts one by a plane. `edge`: of the cell [m].
double uncovered_share(std::span<const CoverWall> walls, const Vec3& place, double edge,
                       const Periods& periods);

/// What the walls of a scene leave of each other's cells at a time.
class Covers {
public:
    /// `surfaces`: of all walls at time 0; scene and surfaces must outlive this. `time` [s].
    Covers(const Scene& scene, std::span<const SolidSurface> surfaces, double time);

    /// The share of the cell about a place in a wall that is its own. `edge`: of the cell [m].
    double share(std::size_t wall, const Vec3& place, double edge) const;
    /// Whether a moving wall is nearer to the place than a length [m].
    bool is_moving_near(const Vec3& place, double length) const;

private:
    std::vector<CoverWall> near_moving(std::size_t wall, const Vec3& place) const;

    std::span<const SolidSurface> surfaces_;
    Periods periods_;
    std::vector<std::vector<CoverWall>> fixed_of_; // by wall: the fixed ones, if it moves
    std::vector<std::uint8_t> is_moving_;          // by wall
    std::vector<CoverWall> moving_;
    std::vector<Vec3> ways_; // unit vectors along them, as `moving_`
};

} // namespace hyoryu
