// SPDX-License-Identifier: MIT
#include "overlap_owner.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Lengths that differ by less are the same, as in meshes of single precision [spacings].
constexpr double tie = 1e-3;

bool move_alike(const Motion& a, const Motion& b)
{
    return !a.absorption && !b.absorption && a.velocity == b.velocity && a.times == b.times &&
           a.places == b.places;
}

// The layers of meshes are a lattice that their surface cuts, in any wall that they overlap.
bool is_cut_lattice(const SolidSurface& wall)
{
    return std::holds_alternative<TriangleTree>(wall.shape);
}

struct DeepPlace {
    double depth = -infinity; // behind the surface [m]
    Vec3 foot{0, 0, 0};       // the nearest point of the surface [m]
};

// No water comes through the outer faces of the sides of a basin, so that these are no surface.
DeepPlace depth_within(const HollowBox& basin, const Vec3& p)
{
    for (int a = 0; a < 3; ++a) {
        const bool ends_low = basin.cavity.min[a] < basin.outer.min[a]; // open there: at its rim
        const bool ends_high = basin.cavity.max[a] > basin.outer.max[a];
        if ((ends_low && p[a] < basin.outer.min[a]) || (ends_high && p[a] > basin.outer.max[a])) {
            return {};
        }
    }
    const Vec3 foot = p.cwiseMax(basin.cavity.min).cwiseMin(basin.cavity.max);
    return {(p - foot).norm(), foot};
}

// `farthest`: from the surface of a wall that is not a basin [m].
DeepPlace deep_place(const SolidSurface& wall, const Vec3& p, double farthest)
{
    if (const auto* basin = std::get_if<HollowBox>(&wall.shape)) {
        return depth_within(*basin, p);
    }
    const Vec3 way = p - wall.centre;
    if (way.squaredNorm() > wall.reach * wall.reach) {
        return {};
    }
    const NearestPlace nearest = nearest_from_centre(wall, way, farthest);
    return {-nearest.distance, p - nearest.distance * nearest.normal};
}

// Depth of a place in a wall, if it has layers there.
double depth_in_layers(const SolidSurface& wall, const Vec3& p, double layers)
{
    if (const auto* basin = std::get_if<HollowBox>(&wall.shape)) {
        const Bounds& outer = basin->outer;
        const bool beyond =
            (p.array() < outer.min.array()).any() || (p.array() > outer.max.array()).any();
        return beyond ? -infinity : depth_within(*basin, p).depth;
    }
    const double depth = deep_place(wall, p, layers).depth;
    return depth <= layers ? depth : -infinity;
}

} // namespace

std::vector<std::size_t> first_alike(const std::vector<Wall>& walls)
{
    std::vector<std::size_t> firsts;
    for (const Wall& wall : walls) {
        std::size_t first = 0;
        while (first < firsts.size() && !move_alike(walls[first].motion, wall.motion)) {
            ++first;
        }
        firsts.push_back(first);
    }
    return firsts;
}

OverlapOwner::OverlapOwner(const Scene& scene, std::span<const SolidSurface> surfaces,
                           double layers)
    : surfaces_(surfaces), layers_(layers), tie_(tie * scene.spacing),
      first_(first_alike(scene.walls))
{
    std::vector<AlignedBox> boxes;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const auto* solid = std::get_if<SolidWall>(&scene.walls[w].geometry);
        (solid != nullptr ? solid_ : wide_).push_back(w);
        if (solid != nullptr) {
            const Bounds box = bounds(placed(*solid, scene.dimensions));
            boxes.push_back({box.min, box.max});
        }
    }
    boxes_ = tree_over(boxes);
}

Owner OverlapOwner::owner(std::size_t wall, const Vec3& place) const
{
    if (is_cut_lattice(surfaces_[wall])) {
        return Owner::alone;
    }
    std::vector<Claim> claims = claims_of_others(wall, place);
    if (claims.empty()) {
        return Owner::alone;
    }
    claims.push_back({wall, deep_place(surfaces_[wall], place, infinity).depth});
    std::ranges::sort(claims, {}, &Claim::wall); // the same from the view of each of them
    find_ways(place, claims);
    std::ranges::sort(claims, {}, &Claim::way);
    if (claims[1].way <= claims[0].way + tie_) {
        return Owner::alone;
    }
    return claims[0].wall == wall ? Owner::best : Owner::other;
}

std::vector<OverlapOwner::Claim> OverlapOwner::claims_of_others(std::size_t wall,
                                                                const Vec3& place) const
{
    std::vector<Claim> claims;
    const auto look = [&](std::size_t other) {
        if (other != wall && first_[other] == first_[wall] && !is_cut_lattice(surfaces_[other])) {
            const double depth = depth_in_layers(surfaces_[other], place, layers_);
            if (depth > tie_) {
                claims.push_back({other, depth});
            }
        }
        return false;
    };
    std::ranges::for_each(wide_, look);
    any_of_near(boxes_, {place, place}, [&](int k) { return look(solid_[at(k)]); });
    return claims;
}

void OverlapOwner::find_ways(const Vec3& place, std::vector<Claim>& claims) const
{
    for (Claim& claim : claims) {
        claim.way = infinity;
    }
    for (const Claim& from : claims) {
        const Vec3 foot = deep_place(surfaces_[from.wall], place, infinity).foot;
        double rest = tie_;
        std::size_t last = from.wall;
        for (const Claim& other : claims) {
            const double depth = other.wall == from.wall
                                     ? 0
                                     : deep_place(surfaces_[other.wall], foot, infinity).depth;
            if (depth > rest) {
                rest = depth;
                last = other.wall;
            }
        }
        Claim& ends = *std::ranges::find(claims, last, &Claim::wall);
        ends.way = std::min(ends.way, from.depth + (last == from.wall ? 0 : rest));
    }
}

} // namespace hyoryu
