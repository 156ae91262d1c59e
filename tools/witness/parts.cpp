// SPDX-License-Identifier: MIT
// Convex parts of shapes.
#include "convex.hpp"
#include "mass.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace witness {

namespace {

// A body whose corners lie no farther out of any of its faces, by its size, is its hull.
constexpr double convex_body = 1e-3;
// The same of a wall, whose surface counts as it is: round-off of single precision.
constexpr double convex_wall = 1e-6;
// A hull of more edges is so smooth that the descent finds its valleys.
constexpr std::size_t most_edges = 100;

void measure(Convex& part)
{
    part.reach = std::hypot(part.cylinder_radius, part.half_length) + part.radius;
    for (const Vec3& corner : part.corners) {
        part.reach = std::max(part.reach, (corner - part.middle).norm() + part.radius);
    }
}

std::vector<Vec3> face_normals(const Mesh& mesh)
{
    std::vector<Vec3> normals;
    for (const auto& t : mesh.triangles) {
        const Vec3& a = mesh.corners[static_cast<std::size_t>(t[0])];
        const Vec3 n = (mesh.corners[static_cast<std::size_t>(t[1])] - a)
                           .cross(mesh.corners[static_cast<std::size_t>(t[2])] - a);
        if (n.norm() > 0) {
            normals.push_back(n.normalized());
        }
    }
    return normals;
}

// Directions of the edges, each once; none if they are many. Without them an edge of a hull over
// that of another is a valley that the descent may miss by its whole depth.
std::vector<Vec3> edge_directions(const Mesh& mesh)
{
    std::set<std::pair<int, int>> edges;
    for (const auto& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
        }
    }
    std::vector<Vec3> directions;
    for (const auto& [i, j] : edges) {
        const Vec3 along =
            mesh.corners[static_cast<std::size_t>(j)] - mesh.corners[static_cast<std::size_t>(i)];
        if (along.norm() > 0 && edges.size() <= most_edges) {
            directions.push_back(along.normalized());
        }
    }
    return directions;
}

// How far a corner lies out of a face at most, over the size of the mesh.
double excess(const Mesh& mesh)
{
    double most = 0, size = 0;
    const std::vector<Vec3> normals = face_normals(mesh);
    for (std::size_t k = 0; k < normals.size(); ++k) {
        const Vec3& on = mesh.corners[static_cast<std::size_t>(mesh.triangles[k][0])];
        for (const Vec3& corner : mesh.corners) {
            most = std::max(most, normals[k].dot(corner - on));
            size = std::max(size, (corner - on).norm());
        }
    }
    return most / size;
}

// Cells on a lattice as boxes: runs along x.
std::vector<Convex> runs_of(const std::vector<Vec3>& centres, const Vec3& cell)
{
    std::map<std::array<long, 2>, std::vector<double>> lines;
    for (const Vec3& p : centres) {
        const Vec3 steps = (p - centres[0]).cwiseQuotient(cell);
        lines[{std::lround(steps.z()), std::lround(steps.y())}].push_back(p.x());
    }
    std::vector<Convex> boxes;
    for (auto& [line, xs] : lines) {
        std::sort(xs.begin(), xs.end());
        const double y = centres[0].y() + cell.y() * static_cast<double>(line[1]);
        const double z = centres[0].z() + cell.z() * static_cast<double>(line[0]);
        for (std::size_t first = 0, k = 0; k < xs.size(); ++k) {
            if (k + 1 == xs.size() || xs[k + 1] - xs[k] > 1.5 * cell.x()) {
                const Vec3 half = cell / 2;
                boxes.push_back(
                    box_between(Vec3(xs[first], y, z) - half, Vec3(xs[k], y, z) + half, 3));
                first = k + 1;
            }
        }
    }
    return boxes;
}

std::vector<Convex> cells_within(const Mesh& mesh, double spacing)
{
    const Eigen::AlignedBox3d box = bounds_of(mesh);
    const Vec3 count = (box.sizes() / spacing).array().round().max(1);
    const Vec3 cell = box.sizes().cwiseQuotient(count);
    std::vector<Vec3> inside;
    for (double k = 0.5; k < count.z(); ++k) {
        for (double j = 0.5; j < count.y(); ++j) {
            for (double i = 0.5; i < count.x(); ++i) {
                const Vec3 p = box.min() + cell.cwiseProduct(Vec3(i, j, k));
                if (winding_number(mesh, p) > 0.5) {
                    inside.push_back(p);
                }
            }
        }
    }
    return runs_of(inside, cell);
}

} // namespace

bool is_convex(const Mesh& mesh)
{
    return excess(mesh) <= convex_wall;
}

Convex hull_of(const Mesh& mesh)
{
    Convex part;
    part.corners = mesh.corners;
    part.faces = mesh.triangles;
    for (const Vec3& corner : mesh.corners) {
        part.middle += corner / static_cast<double>(mesh.corners.size());
    }
    part.normals = face_normals(mesh);
    part.edges = edge_directions(mesh);
    measure(part);
    return part;
}

Convex box_between(const Vec3& low, const Vec3& high, int dimensions)
{
    Convex part;
    part.middle = (low + high) / 2;
    part.box = high - low;
    const bool flat = dimensions == 2;
    for (int k = 0; k < (flat ? 4 : 8); ++k) {
        part.corners.emplace_back(k & 1 ? low.x() : high.x(),
                                  flat    ? 0.0
                                  : k & 4 ? low.y()
                                          : high.y(),
                                  k & 2 ? low.z() : high.z());
    }
    for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitY())}) {
        if (!flat || axis.y() == 0) {
            part.normals.insert(part.normals.end(), {axis, -axis});
            part.edges.push_back(axis);
        }
    }
    if (flat) {
        part.middle.y() = 0;
        part.edges.clear();
    }
    measure(part);
    return part;
}

Convex triangle_of(const Vec3& a, const Vec3& b, const Vec3& c)
{
    Convex part;
    part.corners = {a, b, c};
    part.middle = (a + b + c) / 3;
    const Vec3 n = (b - a).cross(c - a).normalized();
    part.normals = {n, -n};
    part.edges = {(b - a).normalized(), (c - b).normalized(), (a - c).normalized()};
    part.faces = {{0, 1, 2}, {0, 2, 1}};
    measure(part);
    return part;
}

std::vector<Convex> parts_of(const Solid& solid, int dimensions)
{
    if (solid.kind == Kind::cubes) {
        return runs_of(solid.points, Vec3::Constant(solid.edge));
    }
    if (solid.kind == Kind::mesh) {
        return excess(solid.mesh) <= convex_body ? std::vector<Convex>{hull_of(solid.mesh)}
                                                 : cells_within(solid.mesh, solid.spacing);
    }
    Convex part;
    if (solid.kind == Kind::ball) {
        part.corners = {Vec3::Zero()};
        part.radius = solid.radius;
    } else if (solid.kind == Kind::cylinder && dimensions == 3) {
        part.cylinder_radius = solid.radius;
        part.half_length = solid.length / 2;
        part.normals = {Vec3::UnitX(), -Vec3::UnitX()};
    } else {
        const Vec3 size =
            solid.kind == Kind::cylinder ? Vec3(solid.length, 0, 2 * solid.radius) : solid.size;
        return {box_between(-size / 2, size / 2, dimensions)};
    }
    measure(part);
    return {part};
}

} // namespace witness
