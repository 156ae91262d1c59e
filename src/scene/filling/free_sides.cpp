// SPDX-License-Identifier: MIT
#include "free_sides.hpp"

#include "scene/surfaces/cells.hpp"
#include "scene/surfaces/near_points.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hyoryu {

namespace {

// In spacings.
constexpr double emptiness = 1.2;  // of a place whose nearest particle is as far away
constexpr double step = 1;         // between levels that do not hold each other
constexpr double least_rise = 0.1; // least cosine between a way that rises and the vertical
// A way ends at a wall if it leads to one of its particles, or comes nearer to one than `inside`,
// half the diagonal of a cube and a little. Beside a wall it goes on.
constexpr double ahead = 0.7; // cosine of the angle between the way and what it leads to
constexpr double inside = 0.93;

// Ways along which water may lie open: down, level ones, and up, straight and slanting; and along
// the axes, to which the faces of blocks are normal.
std::vector<Vec3> open_ways(const Scene& scene)
{
    const Vec3 down = scene.gravity.normalized();
    const Vec3 u =
        scene.dimensions == 2 ? down.cross(Vec3::UnitY()).normalized() : down.unitOrthogonal();
    const Vec3 v = down.cross(u);
    std::vector<Vec3> level{u, -u};
    if (scene.dimensions == 3) {
        const double h = std::sqrt(0.5);
        level = {u, -u, v, -v, h * (u + v), h * (u - v), h * (v - u), -h * (u + v)};
    }
    std::vector<Vec3> ways{down, -down};
    for (const Vec3& aside : level) {
        ways.push_back(aside);
        ways.emplace_back((aside - down).normalized());
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (const Vec3& way : {Vec3(Vec3::Unit(axis)), Vec3(-Vec3::Unit(axis))}) {
            const bool known = std::ranges::any_of(
                ways, [&](const Vec3& other) { return way.dot(other) > 0.999; });
            if (has_axis(scene.dimensions, axis) && !known) {
                ways.push_back(way);
            }
        }
    }
    return ways;
}

// The nearest point to a place, and whether it is fluid.
class Surroundings {
public:
    // `levels`: of the free surface above the fluid, which the first points are [m].
    Surroundings(std::span<const Vec3> points, std::vector<double> levels, const Vec3& down,
                 double spacing)
        : points_(points), levels_(std::move(levels)), down_(down), reach_(emptiness * spacing),
          step_(step * spacing)
    {
        build(grid_, points, 0, reach_);
    }

    // Whether a way from a particle leads to an empty place, or to fluid of another level, before
    // it leads to a solid, or is nearer to one than `blocked` [m]. A way up has to end at the free
    // surface: one that leads out of the water below its level is open.
    bool is_open(std::size_t particle, const Vec3& way, double support, double blocked) const
    {
        const Vec3& from = points_[particle];
        // On a lattice many distances are equal but for rounding: a solid goes before fluid.
        const double equal = 1e-6 * reach_;
        for (double s = reach_; s < support + reach_ / 2 - equal; s += reach_ / 2) {
            double fluid = reach_ - equal;
            double solid = reach_ - equal;
            std::size_t nearest = particle;
            const Vec3 place = from + s * way;
            for_cells_about(grid_, place, [&](std::size_t k) {
                const Vec3 to = points_[k] - place;
                const double distance = to.norm();
                if (k < levels_.size()) {
                    // Of two that are as near, the one of the lower level: whatever their order.
                    const bool nearer =
                        distance < fluid || (distance == fluid && levels_[k] < levels_[nearest]);
                    nearest = nearer ? k : nearest;
                    fluid = std::min(fluid, distance);
                } else if (distance < blocked || to.dot(way) > ahead * distance) {
                    solid = std::min(solid, distance);
                }
            });
            if (solid < reach_ - equal && solid <= fluid + equal) {
                return false;
            }
            if (!(fluid < reach_ - equal)) {
                const bool rises = way.dot(down_) < -least_rise;
                return !rises || levels_[particle] + down_.dot(place) > step_;
            }
            if (std::abs(levels_[nearest] - levels_[particle]) > step_) {
                return true;
            }
        }
        return false;
    }

private:
    std::span<const Vec3> points_;
    std::vector<double> levels_;
    Vec3 down_;
    double reach_, step_; // [m]
    CellGrid grid_;
};

} // namespace

std::vector<std::uint8_t> free_to_move(const Scene& scene, const Filling& filling,
                                       std::size_t first, std::span<const Vec3> solids,
                                       double support)
{
    std::vector<Vec3> points = filling.fluid;
    points.insert(points.end(), solids.begin(), solids.end());
    const Vec3 down = scene.gravity.normalized();
    std::vector<double> levels = filling.fluid_depth;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        levels[k] -= down.dot(filling.fluid[k]);
    }
    const Surroundings about(points, std::move(levels), down, scene.spacing);
    const std::vector<Vec3> ways = open_ways(scene);
    std::vector<std::uint8_t> moves(filling.fluid_cut.begin(),
                                    filling.fluid_cut.begin() + static_cast<std::ptrdiff_t>(first));
    parallel_for(0, static_cast<Index>(moves.size()), [&](Index k) {
        // Along a gentle beach a way at the waterline leads to no place that water would flow to,
        // nor does one through an open side, behind which there is water.
        const bool flows = scene.open.empty() && filling.fluid_depth[at(k)] > scene.spacing;
        const double blocked = (flows ? inside : emptiness) * scene.spacing;
        if (moves[at(k)] != 0 && std::ranges::any_of(ways, [&](const Vec3& way) {
                return about.is_open(at(k), way, support, blocked);
            })) {
            moves[at(k)] = 0;
        }
    });
    return moves;
}

} // namespace hyoryu
