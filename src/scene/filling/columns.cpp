// SPDX-License-Identifier: MIT
#include "columns.hpp"

#include "fill_region.hpp"
#include "scene/surfaces/along_ray.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace hyoryu {

namespace {

// The way up, along a coordinate axis.
Vec3 upwards(const Scene& scene)
{
    int axis = 2;
    const Vec3 up = scene.gravity.norm() > 0 ? Vec3(-scene.gravity) : Vec3(Vec3::UnitZ());
    up.cwiseAbs().maxCoeff(&axis);
    axis = has_axis(scene.dimensions, axis) ? axis : 2;
    return (up[axis] < 0 ? -1.0 : 1.0) * Vec3::Unit(axis);
}

int axis_of(const Vec3& along)
{
    int axis = 0;
    along.cwiseAbs().maxCoeff(&axis);
    return axis;
}

// A piece of a column in which the same number of its rays is free.
struct Piece {
    double from = 0, to = 0; // along the column [m]
    int rays = 0;
    Vec3 sum{0, 0, 0}; // of the feet of those rays [m]
};

// An interval of a ray in which the sign of the depth is the same.
struct Interval {
    double to = 0; // it begins where the one before it ends [m]
    bool is_free = false;
};

// `depth` must have a Lipschitz constant of 1.
std::vector<Interval> intervals_of(const AxisRay& ray, double length, double spacing,
                                   const auto& depth)
{
    std::vector<Interval> found;
    double from = 0;
    for (double s = 0; s < length;) {
        s = next_change(ray, s, length, spacing / 64, depth);
        found.push_back({s, depth(ray.at((from + s) / 2)) > 0});
        from = s;
        s += 1e-9 * spacing; // past the change
    }
    return found;
}

// The free intervals of a bundle of rays, cut at all of their ends.
std::vector<Piece> pieces_of(const FreeSpace& space, const Placed& block,
                             const std::vector<AxisRay>& rays, double length, double spacing)
{
    std::vector<std::vector<Interval>> of_ray;
    std::vector<double> cuts{0, length};
    const auto depth = [&](const Vec3& p) { // below the surface of the block and off the walls
        return std::min(space.clearance(p), -signed_distance(block, p));
    };
    for (const AxisRay& ray : rays) {
        of_ray.push_back(intervals_of(ray, length, spacing, depth));
        std::ranges::transform(of_ray.back(), std::back_inserter(cuts), &Interval::to);
    }
    std::ranges::sort(cuts);
    std::vector<Piece> pieces;
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
        Piece piece{cuts[c], cuts[c + 1]};
        if (piece.to - piece.from <= 1e-6 * spacing) {
            continue;
        }
        const double middle = (piece.from + piece.to) / 2;
        for (std::size_t r = 0; r < rays.size(); ++r) {
            const auto around = std::ranges::upper_bound(of_ray[r], middle, {}, &Interval::to);
            if (around != of_ray[r].end() && around->is_free) {
                piece.rays += 1;
                piece.sum += rays[r].from;
            }
        }
        if (piece.rays > 0) {
            pieces.push_back(piece);
        }
    }
    return pieces;
}

// Rays through a column of cells, evenly over it.
std::vector<AxisRay> bundle(const Cells& cells, const std::array<Index, 3>& cell, const Vec3& along,
                            int dimensions)
{
    constexpr Index across = 4;
    const int axis = axis_of(along);
    std::array<Index, 3> n{across, dimensions == 3 ? across : 1, across};
    n[at(axis)] = 1;
    Cells parts{cells.middle(cell), cells.length, n};
    for (int a = 0; a < 3; ++a) {
        parts.length[a] = cells.edge(a);
    }
    std::vector<AxisRay> rays;
    over_cells(n, [&](const std::array<Index, 3>& part) {
        AxisRay ray{parts.middle(part), along};
        ray.from[axis] = cells.centre[axis] - along[axis] * cells.length[axis] / 2;
        rays.push_back(ray);
    });
    return rays;
}

// The free pieces of a column, and their volume.
struct WaterColumn {
    std::vector<Piece> pieces;
    double area_of_ray = 0; // [m2]
    double volume = 0;      // [m3]
};

WaterColumn column_of(const Scene& scene, const FreeSpace& space, const Placed& block,
                      const Cells& cells, const std::array<Index, 3>& cell)
{
    const Vec3 along = upwards(scene);
    const int axis = axis_of(along);
    const std::vector<AxisRay> rays = bundle(cells, cell, along, scene.dimensions);
    WaterColumn column{pieces_of(space, block, rays, cells.length[axis], scene.spacing)};
    column.area_of_ray =
        volume_of(cells, scene.dimensions) / cells.edge(axis) / static_cast<double>(rays.size());
    for (const Piece& piece : column.pieces) {
        column.volume += piece.rays * column.area_of_ray * (piece.to - piece.from);
    }
    return column;
}

Index particles_in(double volume, double share)
{
    return std::llround(volume / share);
}

// The middles of shares of the volume of a column, from its bottom up.
void share_out(const WaterColumn& column, const Vec3& along, double share,
               std::vector<Vec3>& points)
{
    const Index count = particles_in(column.volume, share);
    double filled = 0;
    Index next = 0;
    for (const Piece& piece : column.pieces) {
        const double area = piece.rays * column.area_of_ray;
        const double volume = area * (piece.to - piece.from);
        for (; next < count; ++next) {
            const double wanted =
                std::min((static_cast<double>(next) + 0.5) * share, column.volume);
            if (wanted > filled + volume && &piece != &column.pieces.back()) {
                break;
            }
            const double s = std::min(piece.from + (wanted - filled) / area, piece.to);
            points.emplace_back(piece.sum / piece.rays + s * along);
        }
        filled += volume;
    }
}

// The share of a particle, near the volume of a cube of the spacing, with which whole numbers of
// particles in all columns have the volume of the columns.
double fair_share(const std::vector<double>& volumes, double cube)
{
    constexpr int most = 8; // rounds; each changes the number by fewer
    const double volume = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    double share = cube;
    for (int round = 0; round < most; ++round) {
        Index count = 0;
        for (const double of_column : volumes) {
            count += particles_in(of_column, share);
        }
        const double next = count > 0 ? volume / static_cast<double>(count) : cube;
        if (next == share) {
            break;
        }
        share = next;
    }
    return share;
}

// The volumes of the columns of all processes, in their order.
std::vector<double> volumes_of_all(const std::vector<WaterColumn>& columns, Comm* comm)
{
    std::vector<double> volumes;
    std::ranges::transform(columns, std::back_inserter(volumes), &WaterColumn::volume);
    return of_all_ranks(comm, std::move(volumes));
}

} // namespace

ColumnParticles in_columns(const Scene& scene, const FreeSpace& space, const Placed& block,
                           const Cells& cells, Comm* comm)
{
    const Vec3 along = upwards(scene);
    std::array<Index, 3> count = cells.count;
    count[at(axis_of(along))] = 1;
    const FillPart own = part_of(count[0] * count[1] * count[2], comm);
    const Index number = own.last - own.first;
    std::vector<WaterColumn> columns(at(number));
    parallel_blocks(0, number, [&](Index c) {
        columns[at(c)] = column_of(scene, space, block, cells, cell_at(own.first + c, count));
    });
    const double cube = std::pow(scene.spacing, scene.dimensions);
    const double share =
        scene.open.empty() ? fair_share(volumes_of_all(columns, comm), cube) : cube;
    std::vector<std::vector<Vec3>> of_column(at(number));
    parallel_blocks(0, number, [&](Index c) {
        std::vector<Vec3>& points = of_column[at(c)];
        share_out(columns[at(c)], along, share, points);
        std::erase_if(points,
                      [&](Vec3& p) { return !step_off(space, space.all(), scene.spacing / 2, p); });
    });
    ColumnParticles all{.cell = share};
    for (const std::vector<Vec3>& points : of_column) {
        all.points.insert(all.points.end(), points.begin(), points.end());
    }
    return all;
}

} // namespace hyoryu
