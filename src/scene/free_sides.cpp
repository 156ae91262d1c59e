// SPDX-License-Identifier: MIT
#include "free_sides.hpp"

#include "near_points.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// In spacings.
constexpr double emptiness = 1.2; // of a place whose nearest particle is as far away
// A way ends at a wall if it leads to one of its particles, or comes nearer to one than `inside`,
// half the diagonal of a cube and a little. Beside a wall it goes on.
constexpr double ahead = 0.7; // cosine of the angle between the way and what it leads to
constexpr double inside = 0.93;

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

// Ways along which water may lie open: level ones and down.
std::vector<Vec3> open_ways(const Scene& scene)
{
    const Vec3 down = scene.gravity.normalized();
    const Vec3 u =
        scene.dimensions == 2 ? down.cross(Vec3::UnitY()).normalized() : down.unitOrthogonal();
    const Vec3 v = down.cross(u);
    if (scene.dimensions == 2) {
        return {down, u, -u};
    }
    const double h = std::sqrt(0.5);
    return {down, u, -u, v, -v, h * (u + v), h * (u - v), h * (v - u), -h * (u + v)};
}

// The nearest point to a place, and whether it is fluid.
class Surroundings {
public:
    Surroundings(std::span<const Vec3> points, std::size_t fluid, double reach)
        : points_(points), fluid_(fluid), reach_(reach)
    {
        build(grid_, points, 0, reach);
    }

    // Whether a way from a point leads to an empty place before it leads to a solid, or is nearer
    // to one than `blocked` [m].
    bool is_open(const Vec3& from, const Vec3& way, double support, double blocked) const
    {
        // On a lattice many distances are equal but for rounding: a solid goes before fluid.
        const double equal = 1e-6 * reach_;
        for (double s = reach_; s < support + reach_ / 2 - equal; s += reach_ / 2) {
            double fluid = reach_ - equal;
            double solid = reach_ - equal;
            const Vec3 place = from + s * way;
            for_cells_about(grid_, place, [&](std::size_t k) {
                const Vec3 to = points_[k] - place;
                const double distance = to.norm();
                if (k < fluid_) {
                    fluid = std::min(fluid, distance);
                } else if (distance < blocked || to.dot(way) > ahead * distance) {
                    solid = std::min(solid, distance);
                }
            });
            if (solid < reach_ - equal && solid <= fluid + equal) {
                return false;
            }
            if (!(fluid < reach_ - equal)) {
                return true;
            }
        }
        return false;
    }

private:
    std::span<const Vec3> points_;
    std::size_t fluid_;
    double reach_;
    CellGrid grid_;
};

} // namespace

std::vector<std::uint8_t> free_to_move(const Scene& scene, const Filling& filling,
                                       std::span<const Vec3> solids, double support)
{
    std::vector<Vec3> points = filling.fluid;
    points.insert(points.end(), solids.begin(), solids.end());
    const Surroundings about(points, filling.fluid.size(), emptiness * scene.spacing);
    const std::vector<Vec3> ways = open_ways(scene);
    std::vector<std::uint8_t> moves = filling.fluid_cut;
    parallel_for(0, static_cast<Index>(moves.size()), [&](Index k) {
        // Along a gentle beach a way at the waterline leads to no place that water would flow to,
        // nor does one through an open side, behind which there is water.
        const bool flows = scene.open.empty() && filling.fluid_depth[at(k)] > scene.spacing;
        const double blocked = (flows ? inside : emptiness) * scene.spacing;
        if (moves[at(k)] != 0 && std::ranges::any_of(ways, [&](const Vec3& way) {
                return about.is_open(points[at(k)], way, support, blocked);
            })) {
            moves[at(k)] = 0;
        }
    });
    return moves;
}

} // namespace hyoryu
