// SPDX-License-Identifier: MIT
// The cells of the particles of a mesh wall. Near a face that is about perpendicular to an axis the
// rows along this axis begin at the face. Where neither is so, the cells of the lattice are cut by
// the surface.
#include "crowd.hpp"
#include "layer_places.hpp"
#include "scene/surfaces/way_out.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A surface above or below a lattice point of a mesh.
struct RowSurface {
    double distance = infinity; // along the axis [m]
    Index rows = 0;             // between it and the point
    double weight = 0;          // 1 if it is about perpendicular to the axis, 0 if it is not
};

constexpr double steep_cosine = 0.75, flat_cosine = 0.85; // cosines of 41 and 32 degrees
// Rows up to this length between two surfaces share it evenly [spacings]; in the middle of longer
// ones up to half a cell is missing or too much.
constexpr double longest_shared = 24;
constexpr double grazing = 1e-6;     // depth of points that lie on the surface [spacings]
constexpr double least_share = 1e-3; // of a cell within the mesh that has a particle

RowSurface row_surface(const WayOut& out, int axis, double pitch, double spacing)
{
    if (!(out.distance < infinity)) {
        return {};
    }
    const double rows = std::floor((out.distance - grazing * spacing) / pitch);
    return {out.distance, std::max<Index>(0, static_cast<Index>(rows)),
            std::clamp((std::abs(out.normal[axis]) - steep_cosine) / (flat_cosine - steep_cosine),
                       0.0, 1.0)};
}

// Parts of a cell along an axis, for the share of it that lies within a mesh.
constexpr int parts = 3;

// Calls look(place, count) for the middles of the parts of a box, `count` being the number of axes
// along which a middle is not that of the box. Axes without extent are not divided.
void for_parts(const Vec3& centre, const Vec3& extent, const auto& look)
{
    const auto offsets = [&](int axis) { return extent[axis] > 0 ? parts / 2 : 0; };
    for (int z = -offsets(2); z <= offsets(2); ++z) {
        for (int y = -offsets(1); y <= offsets(1); ++y) {
            for (int x = -offsets(0); x <= offsets(0); ++x) {
                const Vec3 step = extent.cwiseProduct(Vec3(x, y, z)) / parts;
                look(Vec3(centre + step), std::abs(x) + std::abs(y) + std::abs(z));
            }
        }
    }
}

// The part of a box that lies within a mesh.
struct Inside {
    double share = 0;
    Vec3 middle{0, 0, 0}; // [m]
};

// Each part of the box is cut by the plane of the surface nearest to its middle, as if its width
// across this plane were the same everywhere, sum |n_a| e_a of its edges e_a. The parts of all
// boxes of a lattice that a plane cuts then have exactly the volume below it, since this width is a
// whole multiple of the distance of the layers of the lattice that are parallel to the plane.
// `least`: depth below which a place without extent across the surface is within it [m].
Inside part_inside(const TriangleTree& tree, const Vec3& centre, const Vec3& extent, double least)
{
    Inside inside;
    double all = 0;
    for_parts(centre, extent, [&](const Vec3& place, int) {
        const NearestPlace surface = nearest_place(tree, place, infinity);
        const double width = surface.normal.cwiseAbs().dot(extent) / parts;
        const double share = width > least ? std::clamp(0.5 - surface.distance / width, 0.0, 1.0)
                                           : (surface.distance < -least ? 1.0 : 0.0);
        const double sunk = share < 1 ? surface.distance + share * width / 2 : 0;
        all += 1;
        inside.share += share;
        inside.middle += share * (place - sunk * surface.normal);
    });
    inside.middle /= inside.share > 0 ? inside.share : 1;
    inside.share /= all;
    return inside;
}

// A place within the mesh in a cell whose middle lies outside, beside the middle along as few axes
// as possible, and of those the deepest.
std::optional<Vec3> place_within(const TriangleTree& tree, const Vec3& centre, const Vec3& cell,
                                 double least)
{
    std::optional<Vec3> best;
    int fewest = 4;
    double deepest = -least;
    for_parts(centre, cell, [&](const Vec3& place, int axes) {
        if (axes > fewest) {
            return;
        }
        const double distance = nearest_place(tree, place, infinity).distance;
        if (distance < (axes < fewest ? -least : deepest)) {
            best = place;
            fewest = axes;
            deepest = distance;
        }
    });
    return best;
}

} // namespace

std::optional<WallCell> MeshPlaces::place(Index k) const
{
    const Vec3 p =
        k < lattice.number() ? lattice.middle(cell_at(k, lattice.count)) : lattice.centre;
    return cell_of({k, p, nearest_place(*tree, p, infinity)});
}

MeshPlaces::InRow MeshPlaces::in_row(int axis, const Vec3& point) const
{
    const double pitch = lattice.edge(axis);
    const double longest = longest_shared * spacing;
    const auto surface = [&](int sense) {
        return row_surface(way_out(*tree, point, {axis, sense}, longest), axis, pitch, spacing);
    };
    const RowSurface below = surface(-1);
    const RowSurface above = surface(1);
    const double thickness = below.distance + above.distance;
    if (const double weight = std::min(below.weight, above.weight);
        weight > 0 && thickness < longest) {
        const auto most = static_cast<Index>(thickness / (Crowd::distance * spacing));
        const Index count = std::clamp<Index>(most, 1, below.rows + above.rows + 1);
        const double own = thickness / static_cast<double>(count);
        const double place = (static_cast<double>(below.rows) + 0.5) * own;
        return {place - below.distance, below.rows < count ? own / pitch : 0, weight};
    }
    // A single surface is followed where the row reaches beyond the layers.
    const bool is_below = below.distance < above.distance;
    const RowSurface& nearest = is_below ? below : above;
    if (nearest.weight == 0 || thickness < 2 * depth) {
        return {};
    }
    const double place = (static_cast<double>(nearest.rows) + 0.5) * pitch;
    return {(is_below ? 1 : -1) * (place - nearest.distance), 1, nearest.weight};
}

MeshPlaces::InRows MeshPlaces::in_rows(const Vec3& point) const
{
    InRows rows;
    for (int axis = 0; axis < 3; ++axis) {
        const InRow row = in_row(axis, point);
        if (row.weight == 1) {
            rows.sure_shift[axis] = row.shift;
            rows.sure_cubes *= row.ratio;
            // Half a cell along the axis is nearer to an inclined surface.
            rows.least = std::min(rows.least, flat_cosine / 2 * row.ratio * lattice.edge(axis));
        } else {
            rows.weight = std::max(rows.weight, row.weight);
            rows.free[axis] = lattice.edge(axis);
        }
        rows.shift[axis] = row.shift;
        rows.cubes *= row.ratio;
    }
    return rows;
}

std::optional<WallCell> MeshPlaces::cell_of(const MeshPoint& point) const
{
    const Vec3 pitch = lattice.edges();
    const double on_surface = grazing * spacing;
    const NearestPlace& surface = point.nearest;
    const bool in_lattice = point.number < lattice.number();
    Index across = 0; // the axis about perpendicular to the surface, if there is one
    const bool is_flat = surface.normal.cwiseAbs().maxCoeff(&across) >= flat_cosine;
    const bool is_near = in_lattice && std::abs(surface.distance) < pitch.norm() / 2;
    const bool is_inside = !in_lattice || surface.distance <= -on_surface;
    std::optional<Vec3> within = point.place;
    if (!is_inside) {
        // Below terrain there is room for whole rows, which begin at its surface.
        const bool is_ground = std::get<MeshShape>(solid->shape).terrain.has_value();
        within = is_near && !(is_flat && is_ground)
                     ? place_within(*tree, point.place, pitch, on_surface)
                     : std::nullopt;
    }
    if (!within) {
        return std::nullopt;
    }
    const InRows rows = in_rows(*within);
    const bool is_cut = is_near && !(is_flat && rows.free[across] == 0);
    if (!is_inside && !is_cut) {
        return std::nullopt;
    }
    const Inside inside =
        is_cut ? part_inside(*tree, point.place, rows.free, on_surface) : Inside{1, point.place};
    const double of_rows = is_inside ? rows.weight * rows.cubes : 0;
    const double of_part = (1 - rows.weight) * rows.sure_cubes * inside.share;
    const double all = of_rows + of_part;
    if (!(all > least_share)) {
        return std::nullopt;
    }
    Vec3 place =
        (of_rows * (point.place + rows.shift) + of_part * (inside.middle + rows.sure_shift)) / all;
    if (!is_cut) {
        const NearestPlace nearest = nearest_place(*tree, place, infinity);
        place -=
            std::max(nearest.distance + std::min(rows.least, spacing / 2), 0.0) * nearest.normal;
    }
    return WallCell{in_world(*solid, place), cubes * all};
}

} // namespace hyoryu
