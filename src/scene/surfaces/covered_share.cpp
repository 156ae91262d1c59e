// SPDX-License-Identifier: MIT
#include "hyoryu/scene/covered_share.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// What a surface leaves of a cell, and its normal.
struct SurfaceCut {
    double share = 1;
    Vec3 normal{0, 0, 1};
};

// What the cuts leave together. Two cuts at right angles leave the product of their shares; two
// that face alike the smaller share; of two that face each other, as at the joint of two floors,
// each takes its own part. Other angles are between these. The strongest cut comes first.
double share_of(std::vector<SurfaceCut>& cuts)
{
    std::ranges::sort(cuts, {}, &SurfaceCut::share);
    double left = 1;
    for (const SurfaceCut& cut : cuts) {
        const double cosine = &cut == cuts.data() ? 0 : cuts.front().normal.dot(cut.normal);
        const double apart = left * cut.share;
        const double bound =
            cosine > 0 ? std::min(left, cut.share) : std::max(0.0, left + cut.share - 1);
        left = apart + std::abs(cosine) * (bound - apart);
    }
    return left;
}

// The image of a place in the first period.
Vec3 wrapped(Vec3 place, const Periods& periods)
{
    for (int a = 0; a < 3; ++a) {
        if (const double length = periods.length[a]; length > 0) {
            place[a] -= std::floor((place[a] - periods.first[a]) / length) * length;
        }
    }
    return place;
}

// A wall near a cell, and the cell as seen from the centre of the wall.
struct NearWall {
    const CoverWall* wall = nullptr;
    Vec3 from_centre{0, 0, 0};
};

constexpr double leads_across = 0.7; // cosine of a normal and a way that leads across its surface

bool counts(const CoverWall& wall, const Vec3& normal)
{
    return std::abs(normal.dot(wall.left_out)) < leads_across;
}

// Along a straight way; of another one to its farthest place.
Vec3 direction_of(const Motion& motion)
{
    Vec3 farthest = motion.velocity;
    for (std::size_t k = 0; k < motion.places.size() && motion.velocity == Vec3(0, 0, 0); ++k) {
        farthest = motion.places[k].norm() > farthest.norm() ? motion.places[k] : farthest;
    }
    const double length = farthest.norm();
    return length > 0 ? Vec3(farthest / length) : farthest;
}

// The share of a cell by 27 parts, each cut by the planes nearest to its middle.
double share_by_parts(std::span<const NearWall> near, double edge)
{
    constexpr int parts = 3;
    const double part = edge / parts;
    double sum = 0;
    std::vector<SurfaceCut> cuts;
    for (int k = 0; k < parts * parts * parts; ++k) {
        const int layer = k / (parts * parts);
        const Vec3 way = part * Vec3(k % parts - 1, k / parts % parts - 1, layer - 1);
        cuts.clear();
        for (const NearWall& wall : near) {
            const NearestPlace found =
                nearest_from_centre(*wall.wall->solid, wall.from_centre + way);
            if (const double share = 0.5 + found.distance / part;
                share < 1 && counts(*wall.wall, found.normal)) {
                cuts.push_back({std::max(share, 0.0), found.normal});
            }
        }
        sum += share_of(cuts);
    }
    return sum / (parts * parts * parts);
}

} // namespace

Periods periods_of(const Scene& scene)
{
    Periods periods;
    for (Index a = 0; scene.domain && a < 3; ++a) {
        if (scene.domain->periodic[at(a)]) {
            periods.first[a] = scene.domain->min[a];
            periods.length[a] = scene.domain->max[a] - scene.domain->min[a];
        }
    }
    return periods;
}

double uncovered_share(std::span<const CoverWall> walls, const Vec3& place, double edge,
                       const Periods& periods)
{
    constexpr double half_diagonal = 0.867;
    std::vector<NearWall> near;
    bool within = false;
    const auto look = [&](const CoverWall& wall, const Vec3& from_centre) {
        if (from_centre.norm() > wall.solid->reach + edge) {
            return;
        }
        const NearestPlace nearest = nearest_from_centre(*wall.solid, from_centre);
        within =
            within || (nearest.distance < -half_diagonal * edge && counts(wall, nearest.normal));
        if (std::abs(nearest.distance) <= half_diagonal * edge) {
            near.push_back({&wall, from_centre});
        }
    };
    const Vec3 own = wrapped(place, periods);
    for (const CoverWall& wall : walls) {
        const Vec3 centre = wrapped(wall.centre, periods);
        over_images(own, periods.first, periods.length, infinity,
                    [&](const Vec3& image) { look(wall, image - centre); });
    }
    if (within || near.empty()) {
        return within ? 0 : 1;
    }
    return share_by_parts(near, edge);
}

Covers::Covers(const Scene& scene, std::span<const SolidSurface> surfaces, double time)
    : surfaces_(surfaces), periods_(periods_of(scene))
{
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const Motion& motion = scene.walls[w].motion;
        fixed_of_.emplace_back();
        is_moving_.push_back(moves(motion) ? 1 : 0);
        if (!moves(motion)) {
            continue;
        }
        moving_.push_back({&surfaces[w], surfaces[w].centre + displacement(motion, time)});
        ways_.push_back(direction_of(motion));
        for (std::size_t f = 0; f < scene.walls.size(); ++f) {
            if (!moves(scene.walls[f].motion)) {
                fixed_of_[w].push_back({&surfaces[f], surfaces[f].centre, ways_.back()});
            }
        }
    }
}

// The moving walls that act where they are within a fixed one: those whose way leads across its
// surface.
std::vector<CoverWall> Covers::near_moving(std::size_t wall, const Vec3& place) const
{
    const SolidSurface& own = surfaces_[wall];
    const Vec3 normal = nearest_from_centre(own, place - own.centre).normal;
    std::vector<CoverWall> acting;
    for (std::size_t m = 0; m < moving_.size(); ++m) {
        if (std::abs(normal.dot(ways_[m])) >= leads_across) {
            acting.push_back(moving_[m]);
        }
    }
    return acting;
}

double Covers::share(std::size_t wall, const Vec3& place, double edge) const
{
    if (is_moving_[wall] == 0) {
        return moving_.empty() ? 1
                               : uncovered_share(near_moving(wall, place), place, edge, periods_);
    }
    return uncovered_share(fixed_of_[wall], place, edge, periods_);
}

bool Covers::is_moving_near(const Vec3& place, double length) const
{
    return uncovered_share(moving_, place, 2 * length, periods_) < 1;
}

} // namespace hyoryu
