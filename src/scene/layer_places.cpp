// SPDX-License-Identifier: MIT
#include "layer_places.hpp"

#include "hyoryu/scene/fill.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Indices of cell k of a lattice, the first axis fastest.
std::array<Index, 3> cell(Index k, const std::array<Index, 3>& count)
{
    return {k % count[0], k / count[0] % count[1], k / count[0] / count[1]};
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
        const auto k = static_cast<std::size_t>(a);
        places.cavity[k] = std::max<Index>(1, std::llround(size[a] / lattice.spacing));
        places.layers[k] = lattice.layers;
    }
    if (lattice.dimensions == 2) {
        places.cavity[1] = 1;
        places.layers[1] = 0;
    }
    return places;
}

RoundPlaces places_of(const RoundWall& round, const LayerLattice& lattice)
{
    return {round, shape_points(SphereShape{round.radius + lattice.depth()}, lattice.spacing,
                                lattice.dimensions)};
}

LayerPlaces places_of(const SolidWall& solid, const SolidSurface& surface,
                      const LayerLattice& lattice)
{
    const auto of_shape = [&]<class Own>(const Own& shape) -> LayerPlaces {
        if constexpr (std::same_as<Own, MeshShape>) {
            return MeshPlaces{&solid, &std::get<TriangleTree>(surface.shape),
                              mesh_lattice(shape, lattice.spacing), lattice.spacing,
                              lattice.depth()};
        } else if constexpr (std::same_as<Own, ParticleShape>) {
            return CubePlaces{&solid, &shape.points, lattice.depth(), lattice.dimensions};
        } else {
            return ObstaclePlaces{&solid, shape_points(shape, lattice.spacing, lattice.dimensions),
                                  lattice.depth(), lattice.dimensions};
        }
    };
    return std::visit(of_shape, solid.shape);
}

Vec3 in_world(const SolidWall& solid, const Vec3& own)
{
    return solid.centre + solid.rotation * own;
}

} // namespace

LayerLattice layer_lattice(const Scene& scene, const Bounds& domain)
{
    return {scene.spacing, wall_layers(scene.fluid->smoothing_ratio), scene.dimensions, domain};
}

std::optional<Vec3> PlanePlaces::place(Index k) const
{
    const auto half = [&](Index index) { return (static_cast<double>(index) + 0.5) * spacing; };
    const std::array<Index, 3> c = cell(k, count);
    Vec3 p =
        (plane.normal.dot(plane.point) - half(c[2])) * plane.normal + half(first[0] + c[0]) * along;
    if (dimensions == 3) {
        p += half(first[1] + c[1]) * across;
    }
    const Vec3 inside = p.cwiseMax(box.min).cwiseMin(box.max);
    const bool in_box = dimensions == 2 ? inside.x() == p.x() && inside.z() == p.z() : inside == p;
    return in_box ? std::optional(p) : std::nullopt;
}

Index BasinPlaces::number() const
{
    Index product = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        product *= cavity[a] + 2 * layers[a];
    }
    return product;
}

std::optional<Vec3> BasinPlaces::place(Index k) const
{
    const std::array<Index, 3> c =
        cell(k, {cavity[0] + 2 * layers[0], cavity[1] + 2 * layers[1], cavity[2] + 2 * layers[2]});
    bool outside = false;
    Vec3 p(0, 0, 0);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
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
    return outside ? std::optional(p) : std::nullopt;
}

std::optional<Vec3> RoundPlaces::place(Index k) const
{
    const Vec3 p = point_of(points, k).place;
    return p.norm() > round.radius ? std::optional(Vec3(round.centre + p)) : std::nullopt;
}

std::optional<Vec3> ObstaclePlaces::place(Index k) const
{
    const Vec3 p = point_of(points, k).place;
    const bool is_core =
        signed_distance({.shape = &solid->shape, .dimensions = dimensions}, p) <= -depth;
    return is_core ? std::nullopt : std::optional(in_world(*solid, p));
}

std::optional<Vec3> CubePlaces::place(Index k) const
{
    const Vec3 p = (*points)[static_cast<std::size_t>(k)];
    const bool is_core =
        signed_distance({.shape = &solid->shape, .dimensions = dimensions}, p) <= -depth;
    return is_core ? std::nullopt : std::optional(in_world(*solid, p));
}

std::optional<Vec3> MeshPlaces::place(Index k) const
{
    const Vec3 p = lattice.place(k);
    return place_of({k, p, nearest_place(*tree, p, infinity)});
}

Vec3 MeshPlaces::place_of(const MeshPoint& point) const
{
    const double lacking = point.nearest.distance + spacing / 2;
    return in_world(*solid, point.place - std::max(lacking, 0.0) * point.nearest.normal);
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

} // namespace hyoryu
