// SPDX-License-Identifier: MIT
#include "layer_places.hpp"

#include "crowd.hpp"

#include "hyoryu/scene/fill.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A volume in cubes of the spacing; that of a lattice that fits is one cube but for rounding.
double in_cubes(double volume, const LayerLattice& lattice)
{
    constexpr double rounding = 1e-9;
    const double cubes = volume / std::pow(lattice.spacing, lattice.dimensions);
    return std::abs(cubes - 1) < rounding ? 1 : cubes;
}

PlanePlaces places_of(const PlaneWall& plane, const LayerLattice& lattice)
{
    PlanePlaces places{.plane = plane, .spacing = lattice.spacing};
    places.dimensions = lattice.dimensions;
    const Vec3 n = plane.normal;
    // Tangents: in two dimensions along the section, else along the coordinate axes as far as
    // possible.
    const Vec3 helper = std::abs(n.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
    places.along = lattice.dimensions == 2 ? Vec3(Vec3::UnitY().cross(n))
                                           : Vec3((helper - helper.dot(n) * n).normalized());
    places.across = lattice.dimensions == 2 ? Vec3::Zero().eval() : n.cross(places.along).eval();
    places.box = {lattice.domain.min - Vec3::Constant(lattice.depth()),
                  lattice.domain.max + Vec3::Constant(lattice.depth())};
    const Vec3 centre = (places.box.min + places.box.max) / 2;
    const double reach = (places.box.max - places.box.min).norm() / 2;
    const auto index = [&](double x) {
        return static_cast<Index>(std::floor(x / lattice.spacing));
    };
    const double ct = places.along.dot(centre);
    const double cs = places.across.dot(centre);
    places.first = {index(ct - reach), lattice.dimensions == 2 ? 0 : index(cs - reach)};
    const Index last_across = lattice.dimensions == 2 ? 1 : index(cs + reach) + 1;
    places.count = {index(ct + reach) + 1 - places.first[0], last_across - places.first[1],
                    lattice.layers};
    return places;
}

BasinPlaces places_of(const BasinWall& basin, const LayerLattice& lattice)
{
    BasinPlaces places{.basin = basin, .dimensions = lattice.dimensions};
    const Vec3 size = basin.max - basin.min;
    for (int a = 0; a < 3; ++a) {
        places.cavity[at(a)] = std::max<Index>(1, std::llround(size[a] / lattice.spacing));
        places.layers[at(a)] = lattice.layers;
    }
    if (lattice.dimensions == 2) {
        places.cavity[1] = 1;
        places.layers[1] = 0;
    }
    double volume = 1;
    for (int a = 0; a < 3; ++a) {
        const bool is_across = lattice.dimensions == 2 && a == 1;
        volume *= is_across ? 1 : size[a] / static_cast<double>(places.cavity[at(a)]);
    }
    places.cubes = in_cubes(volume, lattice);
    return places;
}

// Volume of each of the cells that a shape consists of.
double cubes_of(const Shape& shape, Index cells, const LayerLattice& lattice)
{
    return in_cubes(volume(shape, lattice.dimensions) / static_cast<double>(cells), lattice);
}

RoundPlaces places_of(const RoundWall& round, const LayerLattice& lattice)
{
    const SphereShape ball{round.radius + lattice.depth()};
    const ShapePoints points = shape_points(ball, lattice.spacing, lattice.dimensions);
    return {round, points, cubes_of(ball, number_of(points), lattice)};
}

LayerPlaces places_of(const SolidWall& solid, const SolidSurface& surface,
                      const LayerLattice& lattice)
{
    const auto of_shape = [&]<class Own>(const Own& shape) -> LayerPlaces {
        if constexpr (std::same_as<Own, MeshShape>) {
            const Cells cells = mesh_lattice(shape, lattice.spacing);
            return MeshPlaces{&solid,          &std::get<TriangleTree>(surface.shape),
                              cells,           in_cubes(cells.edges().prod(), lattice),
                              lattice.spacing, lattice.depth()};
        } else if constexpr (std::same_as<Own, ParticleShape>) {
            // Finer cubes are not all taken.
            const double edge =
                shape.spacing < Crowd::distance * lattice.spacing ? lattice.spacing : shape.spacing;
            return ObstaclePlaces{&solid, GivenPoints{&shape.points},
                                  in_cubes(std::pow(edge, lattice.dimensions), lattice),
                                  lattice.depth(), lattice.dimensions};
        } else {
            const ShapePoints points = shape_points(shape, lattice.spacing, lattice.dimensions);
            return ObstaclePlaces{&solid, points, cubes_of(shape, number_of(points), lattice),
                                  lattice.depth(), lattice.dimensions};
        }
    };
    return std::visit(of_shape, solid.shape);
}

} // namespace

LayerLattice layer_lattice(const Scene& scene, const Bounds& domain)
{
    return {scene.spacing, wall_layers(scene.fluid->smoothing_ratio), scene.dimensions, domain};
}

std::optional<WallCell> PlanePlaces::place(Index k) const
{
    const auto half = [&](Index index) { return (static_cast<double>(index) + 0.5) * spacing; };
    const std::array<Index, 3> c = cell_at(k, count);
    Vec3 p =
        (plane.normal.dot(plane.point) - half(c[2])) * plane.normal + half(first[0] + c[0]) * along;
    if (dimensions == 3) {
        p += half(first[1] + c[1]) * across;
    }
    const Vec3 inside = p.cwiseMax(box.min).cwiseMin(box.max);
    const bool in_box = dimensions == 2 ? inside.x() == p.x() && inside.z() == p.z() : inside == p;
    return in_box ? std::optional(WallCell{p}) : std::nullopt;
}

Index BasinPlaces::number() const
{
    Index product = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        product *= cavity[a] + 2 * layers[a];
    }
    return product;
}

std::optional<WallCell> BasinPlaces::place(Index k) const
{
    const std::array<Index, 3> c = cell_at(
        k, {cavity[0] + 2 * layers[0], cavity[1] + 2 * layers[1], cavity[2] + 2 * layers[2]});
    bool outside = false;
    Vec3 p(0, 0, 0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = at(axis);
        if (dimensions == 2 && axis == 1) {
            continue;
        }
        const Index own = c[a] - layers[a];
        const bool below = own < 0;
        const bool above = own >= cavity[a];
        if ((below && basin.open[2 * a]) || (above && basin.open[2 * a + 1])) {
            return std::nullopt;
        }
        outside = outside || below || above;
        const double step = (basin.max - basin.min)[axis] / static_cast<double>(cavity[a]);
        p[axis] = basin.min[axis] + (static_cast<double>(own) + 0.5) * step;
    }
    return outside ? std::optional(WallCell{p, cubes}) : std::nullopt;
}

std::optional<WallCell> RoundPlaces::place(Index k) const
{
    const Vec3 p = point_of(points, k).place;
    return p.norm() > round.radius ? std::optional(WallCell{round.centre + p, cubes})
                                   : std::nullopt;
}

std::optional<WallCell> ObstaclePlaces::place(Index k) const
{
    const Vec3 p = point_of(points, k).place;
    const bool is_core =
        signed_distance({.shape = &solid->shape, .dimensions = dimensions}, p) <= -depth;
    return is_core ? std::nullopt : std::optional(WallCell{in_world(*solid, p), cubes});
}

LayerPlaces layer_places(const Wall& wall, const SolidSurface& surface, const LayerLattice& lattice)
{
    if (const auto* solid = std::get_if<SolidWall>(&wall.geometry)) {
        return places_of(*solid, surface, lattice);
    }
    if (const auto* plane = std::get_if<PlaneWall>(&wall.geometry)) {
        return places_of(*plane, lattice);
    }
    if (const auto* basin = std::get_if<BasinWall>(&wall.geometry)) {
        return places_of(*basin, lattice);
    }
    return places_of(std::get<RoundWall>(wall.geometry), lattice);
}

double cubes_at(const LayerPlaces& places, Index number)
{
    const auto cubes = [&]<class Own>(const Own& own) -> double {
        if constexpr (std::same_as<Own, MeshPlaces>) {
            return own.place(number).value().cubes;
        } else if constexpr (std::same_as<Own, PlanePlaces>) {
            return 1;
        } else {
            return own.cubes;
        }
    };
    return std::visit(cubes, places);
}

} // namespace hyoryu
