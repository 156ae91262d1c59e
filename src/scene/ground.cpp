// SPDX-License-Identifier: MIT
#include "ground.hpp"

#include "hyoryu/scene/triangles.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A triangle over more buckets than this is looked at for every place.
constexpr double most_buckets = 64;
// A face that is steeper than this is a side, not ground (sine of its slope).
constexpr double least_up = 1e-9;

// Sutherland and Hodgman (1974), in plan; heights are interpolated along the edges.
std::vector<Vec3> clipped(std::vector<Vec3> polygon, const Plan2& a, const Plan2& b)
{
    std::vector<Vec3> kept;
    const auto side = [&](const Vec3& p) {
        return (b[0] - a[0]) * (p.y() - a[1]) - (b[1] - a[1]) * (p.x() - a[0]);
    };
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3& p = polygon[k];
        const Vec3& q = polygon[(k + 1) % polygon.size()];
        const double sp = side(p);
        const double sq = side(q);
        if (sp >= 0) {
            kept.push_back(p);
        }
        if ((sp > 0 && sq < 0) || (sp < 0 && sq > 0)) {
            kept.emplace_back(p + sp / (sp - sq) * (q - p));
        }
    }
    return kept;
}

// The walls of a basin that are ground: its floor, in the section a strip below it.
TriangleSurface floor_of(const BasinWall& basin, int dimensions)
{
    BasinWall floor = basin;
    floor.open = {true, true, true, true, basin.open[4], true};
    return triangles_of(Wall{.geometry = floor}, {}, dimensions);
}

TriangleSurface surface_for(const Wall& wall, double far, int dimensions)
{
    if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        return floor_of(*basin, dimensions);
    }
    const auto* plane = std::get_if<PlaneWall>(&wall.geometry);
    if (plane != nullptr && plane->normal.z() <= least_up) {
        return {};
    }
    const Bounds domain{Vec3::Constant(-far), Vec3::Constant(far)};
    return triangles_of(wall, domain, dimensions);
}

} // namespace

Ground::Ground(const std::vector<Wall>& walls, const std::string& on, double far, int dimensions)
    : dimensions_(dimensions)
{
    for (const Wall& wall : walls) {
        if (moves(wall.motion) || (!on.empty() && wall.name != on)) {
            continue;
        }
        const TriangleSurface surface = surface_for(wall, far, dimensions);
        for (const auto& t : surface.triangles) {
            const auto corner = [&](std::size_t k) {
                return surface.corners[static_cast<std::size_t>(t[k])];
            };
            add({corner(0), corner(1), corner(2)});
        }
    }
    fill_buckets();
}

void Ground::add(const Triangle& t)
{
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (dimensions_ == 2 || normal.z() > least_up * normal.norm()) {
        triangles_.push_back(t);
    }
}

void Ground::fill_buckets()
{
    double sum = 0;
    const auto box_of = [](const Triangle& t) {
        Bounds box;
        for (const Vec3& corner : t) {
            box.add(corner);
        }
        return box;
    };
    std::vector<double> widths;
    for (const Triangle& t : triangles_) {
        const Vec3 size = box_of(t).max - box_of(t).min;
        widths.push_back(std::max(size.x(), size.y()));
    }
    if (widths.empty()) {
        return;
    }
    std::ranges::nth_element(widths,
                             widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2));
    sum = widths[widths.size() / 2];
    bucket_ = sum > 0 ? 2 * sum : 1;
    for (std::size_t n = 0; n < triangles_.size(); ++n) {
        const Bounds box = box_of(triangles_[n]);
        const Vec3 cells = (box.max - box.min) / bucket_ + Vec3::Ones();
        if (cells.x() * cells.y() > most_buckets) {
            wide_.push_back(n);
            continue;
        }
        const auto first = [&](double v) { return static_cast<long>(std::floor(v / bucket_)); };
        for (long i = first(box.min.x()); i <= first(box.max.x()); ++i) {
            for (long j = first(box.min.y()); j <= first(box.max.y()); ++j) {
                buckets_[{i, j}].push_back(n);
            }
        }
    }
}

std::vector<std::size_t> Ground::near(const Plan2& low, const Plan2& high) const
{
    std::vector<std::size_t> found = wide_;
    const auto cell = [&](double v) { return static_cast<long>(std::floor(v / bucket_)); };
    for (long i = cell(low[0]); i <= cell(high[0]); ++i) {
        for (auto at = buckets_.lower_bound({i, cell(low[1])});
             at != buckets_.end() && at->first[0] == i && at->first[1] <= cell(high[1]); ++at) {
            found.insert(found.end(), at->second.begin(), at->second.end());
        }
    }
    std::ranges::sort(found);
    const auto rest = std::ranges::unique(found);
    found.erase(rest.begin(), rest.end());
    return found;
}

Ground::Range Ground::range_under(const Ring& footprint) const
{
    Plan2 low{infinity, infinity};
    Plan2 high{-infinity, -infinity};
    for (const Plan2& p : footprint) {
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    if (dimensions_ == 2) {
        low[1] = high[1] = 0;
    }
    Range range;
    for (const std::size_t n : near(low, high)) {
        std::vector<Vec3> polygon(triangles_[n].begin(), triangles_[n].end());
        if (dimensions_ == 2) { // the section: its part between two verticals
            polygon = clipped(polygon, {low[0], 1}, {low[0], 0});
            polygon = clipped(polygon, {high[0], 0}, {high[0], 1});
        }
        for (std::size_t k = 0; dimensions_ == 3 && k < footprint.size(); ++k) {
            polygon = clipped(polygon, footprint[k], footprint[(k + 1) % footprint.size()]);
        }
        for (const Vec3& p : polygon) {
            range.highest = std::max(range.highest, p.z());
            range.lowest = std::min(range.lowest, p.z());
        }
    }
    return range;
}

double Ground::height_at(const Plan2& place) const
{
    // A square of a size that does not count, so that no place falls between two triangles.
    const double e = 1e-9 * (1 + std::abs(place[0]) + std::abs(place[1]));
    return highest_under({{place[0] - e, place[1] - e},
                          {place[0] + e, place[1] - e},
                          {place[0] + e, place[1] + e},
                          {place[0] - e, place[1] + e}});
}

} // namespace hyoryu
