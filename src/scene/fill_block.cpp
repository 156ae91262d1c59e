// SPDX-License-Identifier: MIT
#include "fill_block.hpp"

#include "seeded_water.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace hyoryu {

namespace {

// Cells whose volume is right within this part are those of the spacing.
constexpr double as_asked = 0.02;
// A particle fits where it has this part of a cell's shortest edge to the nearest surface; or is
// as deep in a wall.
constexpr double fitting = 0.45;
// A face is covered by walls if they are deeper than this part of a spacing on all of it.
constexpr double covered = 1e-6;

std::size_t at(Index k)
{
    return static_cast<std::size_t>(k);
}

// A box of cells; in two dimensions y does not count.
struct Cells {
    Vec3 centre{0, 0, 0}; // of the box [m]
    Vec3 length{0, 0, 0}; // of its edges [m]
    std::array<Index, 3> count{1, 1, 1};

    double edge(int axis) const { return length[axis] / static_cast<double>(count[at(axis)]); }
    Vec3 middle(const std::array<Index, 3>& cell) const
    {
        Vec3 p = centre;
        for (int a = 0; a < 3; ++a) {
            p[a] += ((static_cast<double>(cell[at(a)]) + 0.5) / static_cast<double>(count[at(a)]) -
                     0.5) *
                    length[a];
        }
        return p;
    }
};

// Along a coordinate axis; in two dimensions there is none along y.
bool has_axis(int dimensions, int axis)
{
    return dimensions == 3 || axis != 1;
}

double volume_of(const Cells& cells, int dimensions)
{
    return cells.edge(0) * cells.edge(2) * (dimensions == 3 ? cells.edge(1) : 1);
}

double shortest_edge(const Cells& cells, int dimensions)
{
    const double least = std::min(cells.edge(0), cells.edge(2));
    return dimensions == 3 ? std::min(least, cells.edge(1)) : least;
}

// Whether an edge differs from the spacing by so much that the lattice would rearrange.
bool is_stretched(const Cells& cells, double spacing, int dimensions)
{
    constexpr double stretched = 0.025; // of the spacing
    bool any = false;
    for (int a = 0; a < 3; ++a) {
        any = any || (has_axis(dimensions, a) && std::abs(cells.edge(a) / spacing - 1) > stretched);
    }
    return any;
}

// Calls f for every cell.
void over_cells(const std::array<Index, 3>& count, const auto& f)
{
    for (Index k = 0; k < count[2]; ++k) {
        for (Index j = 0; j < count[1]; ++j) {
            for (Index i = 0; i < count[0]; ++i) {
                f(std::array<Index, 3>{i, j, k});
            }
        }
    }
}

// A half goes up, also where round-off has taken something off it: the same block has the same
// cells wherever it lies.
Index whole(double number)
{
    constexpr double round_off = 1e-9;
    return std::max<Index>(1, std::llround(number * (1 + round_off)));
}

// Cells nearest to cubes of the spacing.
Cells plain_cells(const Bounds& box, double spacing, int dimensions)
{
    Cells cells{(box.min + box.max) / 2, box.max - box.min};
    for (int a = 0; a < 3; ++a) {
        cells.count[at(a)] = has_axis(dimensions, a) ? whole(cells.length[a] / spacing) : 1;
    }
    return cells;
}

// Cells of the volume of cubes of the spacing: each edge compensates the rounding of the shorter
// ones, in equal parts with the longer ones.
Cells even_cells(const Bounds& box, double spacing, int dimensions)
{
    Cells cells = plain_cells(box, spacing, dimensions);
    std::vector<int> axes;
    for (int a = 0; a < 3; ++a) {
        if (has_axis(dimensions, a)) {
            axes.push_back(a);
        }
    }
    std::ranges::stable_sort(axes, {}, [&](int a) { return cells.length[a]; });
    double rest = std::pow(spacing, dimensions);
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const int a = axes[k];
        const double wanted = std::pow(rest, 1.0 / static_cast<double>(axes.size() - k));
        cells.count[at(a)] = whole(cells.length[a] / wanted);
        rest /= cells.edge(a);
    }
    return cells;
}

std::vector<Vec3> middles_in(const Placed& block, const Cells& cells)
{
    std::vector<Vec3> points;
    over_cells(cells.count, [&](const std::array<Index, 3>& cell) {
        const Vec3 p = cells.middle(cell);
        if (signed_distance(block, p) < 0) {
            points.push_back(p);
        }
    });
    return points;
}

// Those of some points that are free, and whether they all fit the walls.
struct Fit {
    std::vector<Vec3> points;
    bool fits = true;
};

Fit fit(const FreeSpace& space, const std::vector<Vec3>& points, double edge)
{
    std::vector<double> clearance(points.size());
    parallel_for(0, static_cast<Index>(points.size()),
                 [&](Index k) { clearance[at(k)] = space.clearance(points[at(k)]); });
    Fit result;
    for (std::size_t k = 0; k < points.size(); ++k) {
        result.fits = result.fits && std::abs(clearance[k]) >= fitting * edge;
        if (clearance[k] >= 0) {
            result.points.push_back(points[k]);
        }
    }
    return result;
}

// A line from a point along an axis.
struct Ray {
    Vec3 from{0, 0, 0};
    Vec3 along{0, 0, 1};
    Vec3 at(double s) const { return from + s * along; }
};

// The end of a bracket [from, to] of a ray, in which a value takes the other sign, after the
// bracket was made `narrow` [m]: regula falsi (Illinois, Dowell and Jarratt 1971), whose places
// keep from the ends by half of that, so that the bracket closes from both of them.
double narrowed(const Ray& ray, double from, double to, double narrow, const auto& value)
{
    constexpr int most = 40; // a bracket as narrow as the numbers are fine shrinks no more
    double low = value(ray.at(from));
    double high = value(ray.at(to));
    const bool positive = low > 0;
    int kept = 0; // which end was kept the last time
    for (int k = 0; k < most && to - from > narrow; ++k) {
        const double falsi = from + (to - from) * low / (low - high);
        const double s = std::clamp(falsi, from + narrow / 2, to - narrow / 2);
        const double v = value(ray.at(s));
        const bool is_before = (v > 0) == positive;
        (is_before ? from : to) = s;
        (is_before ? low : high) = v;
        const int keeps = is_before ? 1 : -1;
        if (keeps == kept) {
            (is_before ? high : low) /= 2;
        }
        kept = keeps;
    }
    return to;
}

// The next place on a ray, from s on, where a function whose value changes no faster than the place
// takes the other sign; `end` if there is none.
double next_change(const Ray& ray, double s, double end, double least, const auto& value)
{
    constexpr double narrow = 1e-10; // of the least step
    const bool positive = value(ray.at(s)) > 0;
    double before = s;
    while (s < end) {
        const double v = value(ray.at(s));
        if ((v > 0) != positive) {
            return narrowed(ray, before, s, narrow * least, value);
        }
        before = s;
        s += std::max(std::abs(v), least);
    }
    return end;
}

// The depth to which walls cover a whole face of a box.
double covered_depth(const Scene& scene, const FreeSpace& space, const Bounds& box, int axis,
                     double way)
{
    const Cells cells = plain_cells(box, scene.spacing, scene.dimensions);
    std::array<Index, 3> count = cells.count;
    count[at(axis)] = 1;
    const double first = covered * scene.spacing;
    const auto clearance = [&](const Vec3& p) { return space.clearance(p); };
    double depth = cells.length[axis];
    over_cells(count, [&](const std::array<Index, 3>& cell) {
        Ray ray{cells.middle(cell), way * Vec3::Unit(axis)};
        ray.from[axis] = way > 0 ? box.min[axis] : box.max[axis];
        if (depth > 0) {
            const bool open = clearance(ray.at(first)) > 0;
            depth = open ? 0 : next_change(ray, first, depth, scene.spacing / 64, clearance);
        }
    });
    return depth;
}

// A box less the slabs at its faces that walls cover; empty if they cover all of it.
Bounds uncovered(const Scene& scene, const FreeSpace& space, Bounds box)
{
    for (int a = 0; a < 3; ++a) {
        if (has_axis(scene.dimensions, a)) {
            box.min[a] += covered_depth(scene, space, box, a, 1);
            if (box.max[a] - box.min[a] <= covered * scene.spacing) {
                return {};
            }
            box.max[a] -= covered_depth(scene, space, box, a, -1);
        }
    }
    return box;
}

// The way up, along a coordinate axis.
Vec3 upwards(const Scene& scene)
{
    int axis = 2;
    const Vec3 up = scene.gravity.norm() > 0 ? Vec3(-scene.gravity) : Vec3(Vec3::UnitZ());
    up.cwiseAbs().maxCoeff(&axis);
    axis = has_axis(scene.dimensions, axis) ? axis : 2;
    return (up[axis] < 0 ? -1.0 : 1.0) * Vec3::Unit(axis);
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

// `depth` changes no faster than the place.
std::vector<Interval> intervals_of(const Ray& ray, double length, double spacing, const auto& depth)
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
                             const std::vector<Ray>& rays, double length, double spacing)
{
    std::vector<std::vector<Interval>> of_ray;
    std::vector<double> cuts{0, length};
    const auto depth = [&](const Vec3& p) { // below the surface of the block and off the walls
        return std::min(space.clearance(p), -signed_distance(block, p));
    };
    for (const Ray& ray : rays) {
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

// The middles of shares of a volume, from the bottom of a column up.
void share_out(const std::vector<Piece>& pieces, const Vec3& along, double area_of_ray,
               double share, std::vector<Vec3>& points)
{
    double total = 0;
    for (const Piece& piece : pieces) {
        total += piece.rays * area_of_ray * (piece.to - piece.from);
    }
    const auto count = static_cast<Index>(std::llround(total / share));
    double filled = 0;
    Index next = 0;
    for (const Piece& piece : pieces) {
        const double area = piece.rays * area_of_ray;
        const double volume = area * (piece.to - piece.from);
        for (; next < count; ++next) {
            const double wanted = std::min((static_cast<double>(next) + 0.5) * share, total);
            if (wanted > filled + volume && &piece != &pieces.back()) {
                break;
            }
            const double s = std::min(piece.from + (wanted - filled) / area, piece.to);
            points.emplace_back(piece.sum / piece.rays + s * along);
        }
        filled += volume;
    }
}

// Rays through a column of cells, evenly over it.
std::vector<Ray> bundle(const Cells& cells, const std::array<Index, 3>& cell, const Vec3& along,
                        int dimensions)
{
    constexpr Index across = 4;
    int axis = 0;
    along.cwiseAbs().maxCoeff(&axis);
    std::array<Index, 3> n{across, dimensions == 3 ? across : 1, across};
    n[at(axis)] = 1;
    Cells parts{cells.middle(cell), cells.length, n};
    for (int a = 0; a < 3; ++a) {
        parts.length[a] = cells.edge(a);
    }
    std::vector<Ray> rays;
    over_cells(n, [&](const std::array<Index, 3>& part) {
        Ray ray{parts.middle(part), along};
        ray.from[axis] = cells.centre[axis] - along[axis] * cells.length[axis] / 2;
        rays.push_back(ray);
    });
    return rays;
}

std::vector<Vec3> in_columns(const Scene& scene, const FreeSpace& space, const Placed& block,
                             const Cells& cells)
{
    const Vec3 along = upwards(scene);
    int axis = 0;
    along.cwiseAbs().maxCoeff(&axis);
    std::array<Index, 3> count = cells.count;
    count[at(axis)] = 1;
    const double share = std::pow(scene.spacing, scene.dimensions);
    const double area = volume_of(cells, scene.dimensions) / cells.edge(axis);
    const Index columns = count[0] * count[1] * count[2];
    std::vector<std::vector<Vec3>> of_column(at(columns));
    parallel_blocks(0, columns, [&](Index c) {
        const std::array<Index, 3> cell{c % count[0], c / count[0] % count[1],
                                        c / (count[0] * count[1])};
        const std::vector<Ray> rays = bundle(cells, cell, along, scene.dimensions);
        const auto pieces = pieces_of(space, block, rays, cells.length[axis], scene.spacing);
        std::vector<Vec3>& points = of_column[at(c)];
        share_out(pieces, along, area / static_cast<double>(rays.size()), share, points);
        std::erase_if(points,
                      [&](Vec3& p) { return !step_off(space, space.all(), scene.spacing / 2, p); });
    });
    std::vector<Vec3> all;
    for (const std::vector<Vec3>& points : of_column) {
        all.insert(all.end(), points.begin(), points.end());
    }
    return all;
}

// Points in layers below the surface of a block.
std::vector<Vec3> layers_of(const Scene& scene, const FluidBlock& block)
{
    std::vector<Vec3> points;
    for (const Vec3& p : aggregate(block.shape, scene.spacing, scene.dimensions).points) {
        points.push_back(block.centre + block.rotation * p);
    }
    return points;
}

} // namespace

BlockParticles fill_block(const Scene& scene, std::size_t block)
{
    const FluidBlock& own = scene.fluid->blocks[block];
    const Placed shape{&own.shape, own.centre, own.rotation, scene.dimensions};
    const FreeSpace space(scene, block);
    const int d = scene.dimensions;
    const Cells plain = plain_cells(bounds(shape), scene.spacing, d);
    const std::vector<Vec3> all = own.layers ? layers_of(scene, own) : middles_in(shape, plain);
    BlockParticles result{.all = static_cast<Index>(all.size())};
    result.in_walls =
        std::ranges::count_if(all, [&](const Vec3& p) { return space.is_in_wall(p); });
    const double cube = std::pow(scene.spacing, d);
    Fit found = fit(space, all, own.layers ? scene.spacing : shortest_edge(plain, d));
    if (!found.fits || (!own.layers && std::abs(volume_of(plain, d) / cube - 1) > as_asked)) {
        const Bounds box = uncovered(scene, space, bounds(shape));
        if (box.empty()) {
            return result;
        }
        const Cells even = even_cells(box, scene.spacing, d);
        found = fit(space, middles_in(shape, even), shortest_edge(even, d));
        result.cut = is_stretched(even, scene.spacing, d);
        if (!found.fits) {
            found.points = in_columns(scene, space, shape, even);
            result.cut = true;
        }
    }
    result.points = std::move(found.points);
    if (own.seeded) {
        const SeededCells cells = seeded_cells(scene, block, bounds(shape));
        std::erase_if(result.points, [&](const Vec3& p) { return !is_reached(cells, space, p); });
        result.in_walls = 0; // the box about the water is ours, not the user's
    }
    return result;
}

} // namespace hyoryu
