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
    const SolidSurface* solid = nullptr;
    Vec3 from_centre{0, 0, 0};
};

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
            const NearestPlace found = nearest_from_centre(*wall.solid, wall.from_centre + way);
            if (const double share = 0.5 + found.distance / part; share < 1) {
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

std::vector<MovedWall> moving_covers(const Scene& scene, std::span<const SolidSurface> surfaces,
                                     double time)
{
    std::vector<MovedWall> covers;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        if (const Motion& motion = scene.walls[w].motion; moves(motion)) {
            const Vec3 way = displacement(motion, time);
            covers.push_back({&surfaces[w], surfaces[w].centre + way});
        }
    }
    return covers;
}

double uncovered_share(std::span<const MovedWall> covers, const Vec3& place, double edge,
                       const Periods& periods)
{
    constexpr double half_diagonal = 0.867;
    std::vector<NearWall> near;
    bool within = false;
    const auto look = [&](const MovedWall& cover, const Vec3& from_centre) {
        if (from_centre.norm() > cover.solid->reach + edge) {
            return;
        }
        const double distance = nearest_from_centre(*cover.solid, from_centre).distance;
        within = within || distance < -half_diagonal * edge;
        if (std::abs(distance) <= half_diagonal * edge) {
            near.push_back({cover.solid, from_centre});
        }
    };
    const Vec3 own = wrapped(place, periods);
    for (const MovedWall& cover : covers) {
        const Vec3 centre = wrapped(cover.centre, periods);
        over_images(own, periods.first, periods.length, infinity,
                    [&](const Vec3& image) { look(cover, image - centre); });
    }
    if (within || near.empty()) {
        return within ? 0 : 1;
    }
    return share_by_parts(near, edge);
}

} // namespace hyoryu
