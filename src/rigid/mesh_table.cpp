// SPDX-License-Identifier: MIT
#include "mesh_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hyoryu {

namespace {

// A corner this part of the size of the mesh off a plane lies in it: three times the rounding of a
// file in single precision.
constexpr double flat = 2e-7;
// Triangles whose unit normals differ by more are never one patch, however thin they are.
constexpr double flat_angle = 1e-3;
// Sine of the angle up to which two creases at a corner are one straight line.
constexpr double straight = 1e-6;
// Slack of a cone of normals, as the cosine with its border.
constexpr double cone_slack = 1e-6;

using Sides = std::map<std::pair<int, int>, std::vector<int>>; // edge to triangles

std::size_t at(int k)
{
    return static_cast<std::size_t>(k);
}

std::pair<int, int> edge_of(const std::array<int, 3>& triangle, std::size_t k)
{
    return std::minmax(triangle[k], triangle[(k + 1) % 3]);
}

class Builder {
public:
    explicit Builder(const MeshSurface& surface) : triangles_(surface.triangles)
    {
        for (const Vec3& corner : surface.corners) {
            mesh_.corners.push_back({surface.position + surface.orientation * corner, {}, false});
            bounds_.add(mesh_.corners.back().point);
        }
        std::erase_if(triangles_, [&](const auto& t) { return !(area_vector(t).norm() > 0); });
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
                sides_[edge_of(triangles_[t], k)].push_back(static_cast<int>(t));
            }
        }
    }

    MeshTable table()
    {
        grow_patches();
        flatten();
        find_creases();
        find_sharp_corners();
        std::vector<AlignedBox> boxes;
        for (const FlatTriangle& t : mesh_.triangles) {
            AlignedBox box;
            for (const Vec3& point : t.point) {
                box.add(point);
            }
            boxes.push_back(box);
        }
        mesh_.tree = tree_over(boxes);
        return std::move(mesh_);
    }

private:
    const Vec3& point(int corner) const { return mesh_.corners[at(corner)].point; }

    Vec3 area_vector(const std::array<int, 3>& t) const
    {
        return (point(t[1]) - point(t[0])).cross(point(t[2]) - point(t[0]));
    }

    // Seeds the largest triangles first: their planes are the best known.
    void grow_patches()
    {
        std::vector<std::pair<double, int>> seeds;
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            seeds.emplace_back(-area_vector(triangles_[t]).norm(), static_cast<int>(t));
        }
        std::sort(seeds.begin(), seeds.end());
        patch_.assign(triangles_.size(), -1);
        for (const auto& [area, seed] : seeds) {
            if (patch_[at(seed)] < 0) {
                grow(seed);
            }
        }
    }

    void grow(int seed)
    {
        const auto& first = triangles_[at(seed)];
        const Vec3 normal = area_vector(first).normalized();
        const double offset = normal.dot(point(first[0]));
        const double tolerance = flat * (bounds_.high - bounds_.low).norm();
        const int patch = static_cast<int>(mesh_.patches.size());
        mesh_.patches.push_back({normal, offset});
        std::vector<int> open{seed};
        patch_[at(seed)] = patch;
        while (!open.empty()) {
            const auto& t = triangles_[at(open.back())];
            open.pop_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const auto& both = sides_[edge_of(t, k)];
                for (const int other : both) {
                    const auto& o = triangles_[at(other)];
                    const bool fits =
                        patch_[at(other)] < 0 && both.size() == 2 &&
                        (area_vector(o).normalized() - normal).norm() < flat_angle &&
                        std::all_of(o.begin(), o.end(), [&](int c) {
                            return std::abs(normal.dot(point(c)) - offset) <= tolerance;
                        });
                    if (fits) {
                        patch_[at(other)] = patch;
                        open.push_back(other);
                    }
                }
            }
        }
    }

    void flatten()
    {
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            FlatTriangle triangle{patch_[t], triangles_[t], {-1, -1, -1}, {}, {}};
            const Patch& patch = mesh_.patches[at(triangle.patch)];
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3& p = point(triangle.corner[k]);
                triangle.point[k] = p - (patch.normal.dot(p) - patch.offset) * patch.normal;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 d = triangle.point[(k + 1) % 3] - triangle.point[k];
                triangle.sideways[k] = d.cross(patch.normal).normalized();
            }
            mesh_.triangles.push_back(triangle);
        }
    }

    // The direction from an edge into a triangle.
    Vec3 into(int triangle, const std::pair<int, int>& edge) const
    {
        const FlatTriangle& t = mesh_.triangles[at(triangle)];
        for (std::size_t k = 0; k < 3; ++k) {
            if (edge_of(t.corner, k) == edge) {
                return -t.sideways[k];
            }
        }
        return Vec3::Zero();
    }

    void find_creases()
    {
        for (const auto& [edge, both] : sides_) {
            const int a = both.front();
            const int b = both.back();
            if (both.size() == 2 && patch_[at(a)] == patch_[at(b)]) {
                continue;
            }
            edges_within_[edge.first].push_back(edge.second);
            edges_within_[edge.second].push_back(edge.first);
            Crease crease{edge.first, edge.second, into(a, edge), into(b, edge)};
            const Vec3& na = mesh_.patches[at(patch_[at(a)])].normal;
            const Vec3& nb = mesh_.patches[at(patch_[at(b)])].normal;
            const bool rim = both.size() == 1;
            crease.outward = rim ? Vec3(-crease.left) : Vec3(na + nb);
            if (rim || na.dot(crease.right) < 0) {
                note(crease, both);
            }
        }
    }

    void note(const Crease& crease, const std::vector<int>& triangles)
    {
        const int number = static_cast<int>(mesh_.creases.size());
        mesh_.creases.push_back(crease);
        for (const int t : triangles) {
            FlatTriangle& triangle = mesh_.triangles[at(t)];
            for (std::size_t k = 0; k < 3; ++k) {
                if (edge_of(triangle.corner, k) == std::pair(crease.i, crease.j)) {
                    triangle.crease[k] = number;
                }
            }
        }
    }

    void find_sharp_corners()
    {
        for (const auto& [edge, both] : sides_) {
            mesh_.corners[at(edge.first)].neighbours.push_back(edge.second);
            mesh_.corners[at(edge.second)].neighbours.push_back(edge.first);
        }
        for (const auto& [corner, ends] : edges_within_) {
            const auto direction = [&](int end) {
                return Vec3((point(end) - point(corner)).normalized());
            };
            const bool on_a_line =
                ends.size() == 2 && (direction(ends[0]) + direction(ends[1])).norm() < straight;
            mesh_.corners[at(corner)].sharp = !on_a_line;
        }
    }

    MeshTable mesh_;
    std::vector<std::array<int, 3>> triangles_;
    AlignedBox bounds_;
    Sides sides_;
    std::vector<int> patch_;
    std::map<int, std::vector<int>> edges_within_; // edges between patches, by their corners
};

} // namespace

MeshTable mesh_table(const MeshSurface& surface)
{
    return Builder(surface).table();
}

bool in_cone(const Crease& crease, const Vec3& n)
{
    return n.dot(crease.left) <= cone_slack && n.dot(crease.right) <= cone_slack;
}

bool in_cone(const MeshTable& mesh, const MeshCorner& corner, const Vec3& n)
{
    return std::all_of(corner.neighbours.begin(), corner.neighbours.end(), [&](int k) {
        const Vec3 d = mesh.corners[at(k)].point - corner.point;
        return n.dot(d) <= cone_slack * d.norm();
    });
}

} // namespace hyoryu
