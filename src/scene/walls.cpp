// SPDX-License-Identifier: MIT
#include "walls.hpp"

#include "mesh_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

namespace hyoryu {

namespace {

struct Lattice {
    double spacing;
    int layers;
    int dimensions;
    Bounds domain;
};

// Calls put(point) for the cells [first, last) along each axis of a lattice.
void over_cells(const std::array<Index, 3>& first, const std::array<Index, 3>& last,
                const auto& put)
{
    for (Index k = first[2]; k < last[2]; ++k) {
        for (Index j = first[1]; j < last[1]; ++j) {
            for (Index i = first[0]; i < last[0]; ++i) {
                put(std::array<Index, 3>{i, j, k});
            }
        }
    }
}

// Layers behind a plane, on a lattice that is aligned with it and covers the domain.
void add_points(const PlaneWall& plane, const Lattice& lattice, std::vector<Vec3>& points)
{
    const Vec3 n = plane.normal;
    // Tangents: in two dimensions along the section, else along the coordinate axes as far as
    // possible.
    const Vec3 helper = std::abs(n.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
    const Vec3 t = lattice.dimensions == 2 ? Vec3(Vec3::UnitY().cross(n))
                                           : Vec3((helper - helper.dot(n) * n).normalized());
    const Vec3 s = lattice.dimensions == 2 ? Vec3::Zero().eval() : n.cross(t).eval();
    const double margin = lattice.layers * lattice.spacing;
    const Bounds box{lattice.domain.min - Vec3::Constant(margin),
                     lattice.domain.max + Vec3::Constant(margin)};
    const Vec3 centre = (box.min + box.max) / 2;
    const double reach = (box.max - box.min).norm() / 2;
    // Lattice indices count from the origin, so that parallel walls share one lattice.
    const auto index = [&](double x) {
        return static_cast<Index>(std::floor(x / lattice.spacing));
    };
    const double ct = t.dot(centre);
    const double cs = s.dot(centre);
    const Index s_first = lattice.dimensions == 2 ? 0 : index(cs - reach);
    const Index s_last = lattice.dimensions == 2 ? 1 : index(cs + reach) + 1;
    over_cells({index(ct - reach), s_first, 0}, {index(ct + reach) + 1, s_last, lattice.layers},
               [&](const std::array<Index, 3>& c) {
                   const auto half = [&](Index k) {
                       return (static_cast<double>(k) + 0.5) * lattice.spacing;
                   };
                   Vec3 p = (n.dot(plane.point) - half(c[2])) * n + half(c[0]) * t;
                   if (lattice.dimensions == 3) {
                       p += half(c[1]) * s;
                   }
                   const Vec3 inside = p.cwiseMax(box.min).cwiseMin(box.max);
                   const bool near = lattice.dimensions == 2
                                         ? inside.x() == p.x() && inside.z() == p.z()
                                         : inside == p;
                   if (near) {
                       points.push_back(p);
                   }
               });
}

void add_points(const BasinWall& basin, const Lattice& lattice, std::vector<Vec3>& points)
{
    std::array<Index, 3> n{};
    std::array<double, 3> step{};
    const Vec3 size = basin.max - basin.min;
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        n[k] = std::max<Index>(1, std::llround(size[a] / lattice.spacing));
        step[k] = size[a] / static_cast<double>(n[k]);
    }
    const auto layers = static_cast<Index>(lattice.layers);
    std::array<Index, 3> first{-layers, -layers, -layers};
    std::array<Index, 3> last{n[0] + layers, n[1] + layers, n[2] + layers};
    if (lattice.dimensions == 2) {
        first[1] = 0;
        last[1] = 1;
    }
    over_cells(first, last, [&](const std::array<Index, 3>& c) {
        bool outside = false;
        for (std::size_t a = 0; a < 3; ++a) {
            const bool below = c[a] < 0;
            const bool above = c[a] >= n[a];
            if ((below && basin.open[2 * a]) || (above && basin.open[2 * a + 1])) {
                return;
            }
            outside = outside || ((below || above) && !(lattice.dimensions == 2 && a == 1));
        }
        if (outside) {
            Vec3 p;
            for (int a = 0; a < 3; ++a) {
                const auto k = static_cast<std::size_t>(a);
                p[a] = basin.min[a] + (static_cast<double>(c[k]) + 0.5) * step[k];
            }
            points.push_back(lattice.dimensions == 2 ? Vec3{p.x(), 0, p.z()} : p);
        }
    });
}

void add_points(const RoundWall& round, const Lattice& lattice, std::vector<Vec3>& points)
{
    // The outermost layers of a larger ball are those behind the surface of this one.
    const double behind = lattice.layers * lattice.spacing;
    const SphereShape ball{round.radius + behind};
    for (const Vec3& p : aggregate(ball, lattice.spacing, lattice.dimensions).points) {
        if (p.norm() > round.radius) {
            points.push_back(round.centre + p);
        }
    }
}

// Wall particles of a mesh that its lattice puts nearer to the surface than half a spacing move to
// that depth; otherwise they would crowd the fluid. Points farther inside than the layers are out
// of reach of the fluid.
void add_mesh_points(const SolidWall& solid, const MeshShape& mesh, const Lattice& lattice,
                     std::vector<Vec3>& points)
{
    const TriangleTree tree = triangle_tree(mesh.corners, mesh.triangles);
    const double depth = lattice.layers * lattice.spacing;
    for (const MeshPoint& found : points_within(mesh, tree, lattice.spacing, depth).points) {
        const double lacking = found.nearest.distance + lattice.spacing / 2;
        const Vec3 p = found.place - std::max(lacking, 0.0) * found.nearest.normal;
        points.push_back(solid.centre + solid.rotation * p);
    }
}

void add_points(const SolidWall& solid, const Lattice& lattice, std::vector<Vec3>& points)
{
    if (const auto* mesh = std::get_if<MeshShape>(&solid.shape)) {
        add_mesh_points(solid, *mesh, lattice, points);
        return;
    }
    const Placed own{.shape = &solid.shape, .dimensions = lattice.dimensions};
    // The core of a thick obstacle is out of reach of the fluid.
    const double depth = lattice.layers * lattice.spacing;
    for (const Vec3& p : aggregate(solid.shape, lattice.spacing, lattice.dimensions).points) {
        if (signed_distance(own, p) > -depth) {
            points.push_back(solid.centre + solid.rotation * p);
        }
    }
}

// Keeps points that are at least 0.6 spacings from every earlier one.
class Crowd {
public:
    explicit Crowd(double spacing) : cell_(0.6 * spacing) {}

    bool add(const Vec3& p)
    {
        const auto c = cell_of(p);
        for (Index k = -1; k <= 1; ++k) {
            for (Index j = -1; j <= 1; ++j) {
                for (Index i = -1; i <= 1; ++i) {
                    const auto near = taken_.find({c[0] + i, c[1] + j, c[2] + k});
                    if (near != taken_.end() && (near->point - p).norm() < cell_) {
                        return false;
                    }
                }
            }
        }
        return taken_.insert({c[0], c[1], c[2], p}).second;
    }

private:
    struct Entry {
        Index i, j, k;
        Vec3 point{0, 0, 0};
        bool operator==(const Entry& o) const { return i == o.i && j == o.j && k == o.k; }
    };
    struct Hash {
        std::size_t operator()(const Entry& e) const
        {
            const auto mix = [](std::size_t h, Index v) {
                return (h ^ static_cast<std::size_t>(v)) * 0x9E3779B97F4A7C15ULL;
            };
            return mix(mix(mix(1, e.i), e.j), e.k);
        }
    };
    std::array<Index, 3> cell_of(const Vec3& p) const
    {
        std::array<Index, 3> c{};
        for (int a = 0; a < 3; ++a) {
            c[static_cast<std::size_t>(a)] = static_cast<Index>(std::floor(p[a] / cell_));
        }
        return c;
    }
    double cell_;
    std::unordered_set<Entry, Hash> taken_; // only looked up, never walked: order does not matter
};

double depth_in(const PlaneWall& plane, const Vec3& p, int)
{
    return -plane.normal.dot(p - plane.point);
}
double depth_in(const BasinWall& basin, const Vec3& p, int dimensions)
{
    double depth = -infinity;
    for (int a = 0; a < 3; ++a) {
        const auto k = static_cast<std::size_t>(a);
        if (dimensions == 2 && a == 1) {
            continue;
        }
        if (!basin.open[2 * k]) {
            depth = std::max(depth, basin.min[a] - p[a]);
        }
        if (!basin.open[2 * k + 1]) {
            depth = std::max(depth, p[a] - basin.max[a]);
        }
    }
    return depth;
}
double depth_in(const RoundWall& round, const Vec3& p, int)
{
    return (p - round.centre).norm() - round.radius;
}
double depth_in(const SolidWall& solid, const Vec3& p, int dimensions)
{
    return -signed_distance({&solid.shape, solid.centre, solid.rotation, dimensions}, p);
}

// Beyond a period there are images of the particles within it.
bool in_period(const Scene& scene, const Vec3& point)
{
    for (Index axis = 0; axis < 3; ++axis) {
        const bool repeats = scene.domain && scene.domain->periodic[static_cast<std::size_t>(axis)];
        if (repeats &&
            !(point[axis] >= scene.domain->min[axis] && point[axis] < scene.domain->max[axis])) {
            return false;
        }
    }
    return true;
}

} // namespace

void fill_walls(const Scene& scene, Filling& filling)
{
    const Lattice lattice{scene.spacing, wall_layers(scene.fluid->smoothing_ratio),
                          scene.dimensions, filling.domain};
    Crowd crowd(scene.spacing);
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        std::vector<Vec3> points;
        std::visit([&](const auto& geometry) { add_points(geometry, lattice, points); },
                   scene.walls[w].geometry);
        for (const Vec3& p : points) {
            if (in_period(scene, p) && crowd.add(p)) {
                filling.wall.push_back(p);
                filling.wall_owner.push_back(static_cast<std::int32_t>(w));
                if (scene.fluid->walls.sticks) {
                    filling.wall_depth.push_back(depth_behind(scene.walls[w], p, scene.dimensions));
                }
            }
        }
    }
}

double depth_behind(const Wall& wall, const Vec3& point, int dimensions)
{
    return std::visit([&](const auto& g) { return depth_in(g, point, dimensions); }, wall.geometry);
}

} // namespace hyoryu
