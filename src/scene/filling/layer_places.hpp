// SPDX-License-Identifier: MIT
// Where the layers of a wall may have particles: places behind its surface by their number.
#pragma once

#include "fill_region.hpp"
#include "mesh_points.hpp"
#include "shape_points.hpp"

#include "hyoryu/scene/solid_surface.hpp"

#include <optional>
#include <span>

namespace hyoryu {

/// Parameters common to the layers of all walls.
struct LayerLattice {
    double spacing = 0; // [m]
    int layers = 0;
    int dimensions = 3;
    Bounds domain;

    double depth() const { return layers * spacing; }
};

LayerLattice layer_lattice(const Scene& scene, const Bounds& domain);

/// A place of an obstacle in the scene.
inline Vec3 in_world(const SolidWall& solid, const Vec3& own)
{
    return solid.centre + solid.rotation * own;
}

/// Where a layer may have a particle.
struct WallCell {
    Vec3 place{0, 0, 0}; // [m]
    double cubes = 1;    // volume of its cell [cubes of the spacing]
};

/// Layers behind a plane, on a lattice that is aligned with it and covers the domain. Its indices
/// count from the origin, so that parallel walls share one lattice.
struct PlanePlaces {
    PlaneWall plane;
    Vec3 along{1, 0, 0}, across{0, 1, 0}; // unit tangents; the second is unused in two dimensions
    std::array<Index, 2> first{};         // cells along them
    std::array<Index, 3> count{};         // and layers
    double spacing = 0;                   // [m]
    int dimensions = 3;
    Bounds box; // of the domain with a margin for the layers

    Index number() const { return count[0] * count[1] * count[2]; }
    std::optional<WallCell> place(Index k) const;
};

/// The cells outside a basin whose cavity whole cells fill.
struct BasinPlaces {
    BasinWall basin;
    std::array<Index, 3> cavity{}; // cells of it
    std::array<Index, 3> layers{}; // on each side of it
    double cubes = 1;              // volume of a cell
    int dimensions = 3;

    Index number() const;
    std::optional<WallCell> place(Index k) const;
};

/// The outermost shells of a ball, which are behind the surface of a smaller one.
struct RoundPlaces {
    RoundWall round;
    ShapePoints points;
    double cubes = 1; // volume of a cell

    Index number() const { return number_of(points); }
    std::optional<WallCell> place(Index k) const;
};

/// The particles of a simple obstacle, or of one that consists of cubes, without its core, which is
/// out of reach of the fluid.
struct ObstaclePlaces {
    const SolidWall* solid = nullptr;
    ShapePoints points;
    double cubes = 1; // volume of a cell
    double depth = 0; // of the layers [m]
    int dimensions = 3;

    Index number() const { return number_of(points); }
    std::optional<WallCell> place(Index k) const;
};

/// Lattice points inside a mesh, down to the layers.
///
/// Where the surface is about perpendicular to an axis of the lattice, the points below it move
/// along this axis so that their cells begin at the surface. On the lattice itself the surface that
/// the fluid sees would be up to half a spacing too deep. Between two surfaces up to 24
/// spacings apart the cells share the thickness evenly. Elsewhere the surface cuts the cells:
/// each has the volume of its part within the mesh, and its particle is in the middle of this part.
struct MeshPlaces {
    const SolidWall* solid = nullptr;
    const TriangleTree* tree = nullptr;
    Cells lattice;
    double cubes = 1;              // volume of a cell of the lattice
    double spacing = 0, depth = 0; // [m]

    std::optional<WallCell> place(Index k) const;
    /// Empty if the cell has no part within the mesh.
    std::optional<WallCell> cell_of(const MeshPoint& point) const;
    /// Of the middles of the cells that may have a particle.
    DepthRange range() const { return {depth, lattice.edges().norm() / 2}; }

private:
    /// A point in a row along an axis that begins at a surface.
    struct InRow {
        double shift = 0;  // along the axis [m]
        double ratio = 1;  // of its pitch to that of the lattice; 0 if the row has no room for it
        double weight = 0; // 1 if the row follows a surface, 0 if it does not
    };
    /// The same along all axes: of the rows that follow a surface at all, and of those that surely
    /// do.
    struct InRows {
        Vec3 shift{0, 0, 0}, sure_shift{0, 0, 0}; // [m]
        double cubes = 1, sure_cubes = 1;         // volume [cells of the lattice]
        double weight = 0;                        // the largest below 1
        Vec3 free{0, 0, 0};                       // cell along the axes that surely follow none [m]
        double least = infinity;                  // depth that a point keeps [m]
    };
    InRows in_rows(const Vec3& point) const;
    InRow in_row(int axis, const Vec3& point) const;
};

using LayerPlaces = std::variant<PlanePlaces, BasinPlaces, RoundPlaces, ObstaclePlaces, MeshPlaces>;

/// The layers of a wall. `surface`: the surface of this wall.
LayerPlaces layer_places(const Wall& wall, const SolidSurface& surface,
                         const LayerLattice& lattice);

/// Volume of the cell of a place [cubes of the spacing].
double cubes_at(const LayerPlaces& places, Index number);

/// Calls put(number, place) for every place in the layers, in the order of numbers. Each of several
/// processes handles a part of the places.
void for_each_place(const LayerPlaces& places, Comm* comm, const auto& put)
{
    if (const auto* mesh = std::get_if<MeshPlaces>(&places)) {
        for (const MeshPoint& point :
             points_within(mesh->lattice, *mesh->tree, mesh->range(), comm)) {
            if (const std::optional<WallCell> cell = mesh->cell_of(point)) {
                put(point.number, cell->place);
            }
        }
        return;
    }
    const auto walk = [&]<class Places>(const Places& own) {
        if constexpr (!std::same_as<Places, MeshPlaces>) {
            const FillPart part = part_of(own.number(), comm);
            for (Index k = part.first; k < part.last; ++k) {
                if (const std::optional<WallCell> place = own.place(k)) {
                    put(k, place->place);
                }
            }
        }
    };
    std::visit(walk, places);
}

} // namespace hyoryu
