// SPDX-License-Identifier: MIT
#include "hyoryu/scene/covered_share.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

// What a surface leaves of a cell, and its normal.
struct SurfaceCut {
    double share = 1;
    Vec3 normal{0, 0, 1};
};

// The strongest cuts of a cell, ascending; more than these meet in no place of a sensible scene.
class CellCuts {
public:
    void add(const SurfaceCut& cut)
    {
        std::size_t k = std::min(count_, cuts_.size() - 1);
        if (count_ == cuts_.size() && cut.share >= cuts_.back().share) {
            return;
        }
        for (; k > 0 && cut.share < cuts_[k - 1].share; --k) {
            cuts_[k] = cuts_[k - 1];
        }
        cuts_[k] = cut;
        count_ = std::min(count_ + 1, cuts_.size());
    }

    // Two cuts at right angles leave the product of their shares; two that face alike the smaller
    // share; of two that face each other, as at the joint of two floors, each takes its own part.
    // Other angles are between these.
    double share() const
    {
        double left = 1;
        for (std::size_t k = 0; k < count_; ++k) {
            const double other = cuts_[k].share;
            const double cosine = k == 0 ? 0 : cuts_[0].normal.dot(cuts_[k].normal);
            const double apart = left * other;
            const double bound =
                cosine > 0 ? std::min(left, other) : std::max(0.0, left + other - 1);
            left = apart + std::abs(cosine) * (bound - apart);
        }
        return left;
    }

private:
    std::array<SurfaceCut, 8> cuts_;
    std::size_t count_ = 0;
};

NearestPlace nearest_to(const SolidSurface& solid, const Vec3& place)
{
    NearestPlace found = nearest_place(solid, solid.rotation.conjugate() * (place - solid.centre));
    found.normal = solid.rotation * found.normal;
    return found;
}

// Calls f(image) for a place and its images that are within `edge` of the domain.
void for_near_images(const Periods& periods, const Vec3& place, double edge, const auto& f)
{
    Vec3 own = place;
    std::array<int, 3> first{}, last{};
    for (int a = 0; a < 3; ++a) {
        const double length = periods.length[a];
        if (length > 0) {
            own[a] -= std::floor((place[a] - periods.first[a]) / length) * length;
            const double low = own[a] - periods.first[a];
            first[static_cast<std::size_t>(a)] = length - low < edge ? -1 : 0;
            last[static_cast<std::size_t>(a)] = low < edge ? 1 : 0;
        }
    }
    for (int i = first[0]; i <= last[0]; ++i) {
        for (int j = first[1]; j <= last[1]; ++j) {
            for (int k = first[2]; k <= last[2]; ++k) {
                f(Vec3(own + Vec3(i, j, k).cwiseProduct(periods.length)));
            }
        }
    }
}

// A fixed wall near a cell, and the image of the cell that it is near.
struct NearWall {
    const SolidSurface* solid = nullptr;
    Vec3 image{0, 0, 0};
};

// The share of a cell by 27 parts, each cut by the planes nearest to its middle.
double share_by_parts(std::span<const NearWall> near, double edge)
{
    constexpr int parts = 3;
    const double part = edge / parts;
    double sum = 0;
    for (int k = 0; k < parts * parts * parts; ++k) {
        const int layer = k / (parts * parts);
        const Vec3 way = part * Vec3(k % parts - 1, k / parts % parts - 1, layer - 1);
        CellCuts cuts;
        for (const NearWall& wall : near) {
            const NearestPlace found = nearest_to(*wall.solid, wall.image + way);
            if (const double share = 0.5 + found.distance / part; share < 1) {
                cuts.add({std::max(share, 0.0), found.normal});
            }
        }
        sum += cuts.share();
    }
    return sum / (parts * parts * parts);
}

} // namespace

Periods periods_of(const Scene& scene)
{
    Periods periods;
    for (Index a = 0; scene.domain && a < 3; ++a) {
        if (scene.domain->periodic[static_cast<std::size_t>(a)]) {
            periods.first[a] = scene.domain->min[a];
            periods.length[a] = scene.domain->max[a] - scene.domain->min[a];
        }
    }
    return periods;
}

std::vector<int> fixed_walls_of(const Scene& scene)
{
    std::vector<int> fixed;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        if (!moves(scene.walls[w].motion)) {
            fixed.push_back(static_cast<int>(w));
        }
    }
    return fixed;
}

double uncovered_share(std::span<const SolidSurface> surfaces, std::span<const int> fixed,
                       const Vec3& place, double edge, const Periods& periods)
{
    constexpr double half_diagonal = 0.867;
    constexpr std::size_t most = 16; // walls that meet in a cell
    std::array<NearWall, most> near;
    std::size_t count = 0;
    bool within = false;
    for_near_images(periods, place, edge, [&](const Vec3& image) {
        for (const int wall : fixed) {
            const SolidSurface& solid = surfaces[static_cast<std::size_t>(wall)];
            if ((image - solid.centre).norm() > solid.reach + edge) {
                continue;
            }
            const double distance = nearest_to(solid, image).distance;
            within = within || distance < -half_diagonal * edge;
            if (std::abs(distance) <= half_diagonal * edge && count < most) {
                near[count++] = {&solid, image};
            }
        }
    });
    if (within || count == 0) {
        return within ? 0 : 1;
    }
    return share_by_parts(std::span(near).first(count), edge);
}

} // namespace hyoryu
