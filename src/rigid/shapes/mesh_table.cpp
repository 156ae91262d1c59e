// SPDX-License-Identifier: MIT
#include "mesh_table.hpp"

#include "hyoryu/core/triangle_sides.hpp"

#include <cmath>
#include <span>
#include <utility>

namespace hyoryu {

namespace {

// Distance within which a corner lies in a plane, relative to the size of the mesh: three times the
// rounding of a file in single precision.
constexpr double flat_crease = 2e-7;
// Triangles whose unit normals differ by more are never one patch, however thin they are.
constexpr double flat_angle = 1e-3;
// Sine of the angle up to which two creases at a corner are one straight line.
constexpr double straight = 1e-6;
// Slack of a cone of normals, as the cosine with its boundary.
constexpr double cone_slack = 1e-6;

class MeshTableBuilder {
public:
    explicit MeshTableBuilder(const MeshSurface& surface) : triangles_(surface.triangles)
    {
        for (const Vec3& corner : surface.corners) {
            mesh_.corners.push_back({surface.position + surface.orientation * corner, 0, 0, false});
            bounds_.add(mesh_.corners.back().point);
        }
        std::erase_if(triangles_, [&](const auto& t) { return !(area_vector(t).norm() > 0); });
        sort_sides();
    }

    MeshTable table()
    {
        grow_patches();
        flatten();
        release(edge_);
        release(triangles_);
        grow_tree();
        find_neighbours();
        find_creases();
        find_sharp_corners();
        return std::move(mesh_);
    }

private:
    const Vec3& point(int corner) const { return mesh_.corners[at(corner)].point; }

    Vec3 area_vector(const std::array<int, 3>& t) const
    {
        return (point(t[1]) - point(t[0])).cross(point(t[2]) - point(t[0]));
    }

    // A table may be nearly as large as the memory: lists are freed after their last use.
    template <class T>
    static void release(std::vector<T>& list)
    {
        list = std::vector<T>();
    }

    // The sides of all edges, edge by edge, and where those of each edge of a triangle begin.
    void sort_sides()
    {
        sides_ = sorted_sides(triangles_);
        edge_.resize(triangles_.size());
        for_edges([&](std::span<const TriangleSide> both) {
            for (const TriangleSide& s : both) {
                edge_[at(s.triangle)][at(s.side)] = static_cast<int>(both.data() - sides_.data());
            }
        });
    }

    std::span<const TriangleSide> sides_from(std::size_t first) const
    {
        std::size_t last = first;
        while (last < sides_.size() && sides_[last].low == sides_[first].low &&
               sides_[last].high == sides_[first].high) {
            ++last;
        }
        return std::span(sides_).subspan(first, last - first);
    }

    // Calls visit(sides) for every edge, in the order of its corners.
    void for_edges(const auto& visit) const
    {
        for (std::size_t k = 0; k < sides_.size();) {
            const std::span<const TriangleSide> both = sides_from(k);
            visit(both);
            k += both.size();
        }
    }

    // The largest triangles are the first seeds, since their planes are the most accurate.
    void grow_patches()
    {
        std::vector<std::pair<double, int>> seeds;
        seeds.reserve(triangles_.size());
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
        const double tolerance = flat_crease * (bounds_.high - bounds_.low).norm();
        const int patch = static_cast<int>(mesh_.patches.size());
        mesh_.patches.push_back({normal, offset});
        std::vector<int> open{seed};
        patch_[at(seed)] = patch;
        while (!open.empty()) {
            const std::size_t t = at(open.back());
            open.pop_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const std::span<const TriangleSide> both = sides_from(at(edge_[t][k]));
                for (const auto& [low, high, other, side] : both) {
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
        mesh_.triangles.reserve(triangles_.size());
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
    Vec3 into(const TriangleSide& s) const
    {
        return -mesh_.triangles[at(s.triangle)].sideways[at(s.side)];
    }

    void grow_tree()
    {
        std::vector<AlignedBox> boxes;
        boxes.reserve(mesh_.triangles.size());
        for (const FlatTriangle& t : mesh_.triangles) {
            AlignedBox box;
            for (const Vec3& point : t.point) {
                box.add(point);
            }
            boxes.push_back(box);
        }
        mesh_.tree = tree_over(boxes);
    }

    // Corners along the edges of each corner, in the order of the edges.
    void find_neighbours()
    {
        for_edges([&](std::span<const TriangleSide> both) {
            ++mesh_.corners[at(both[0].low)].count;
            ++mesh_.corners[at(both[0].high)].count;
        });
        int first = 0;
        for (MeshCorner& corner : mesh_.corners) {
            corner.first = first;
            first += std::exchange(corner.count, 0);
        }
        mesh_.neighbours.resize(at(first));
        const auto add = [&](MeshCorner& corner, int end) {
            mesh_.neighbours[at(corner.first + corner.count++)] = end;
        };
        for_edges([&](std::span<const TriangleSide> both) {
            add(mesh_.corners[at(both[0].low)], both[0].high);
            add(mesh_.corners[at(both[0].high)], both[0].low);
        });
    }

    bool within_a_patch(std::span<const TriangleSide> both) const
    {
        return both.size() == 2 && patch_[at(both[0].triangle)] == patch_[at(both[1].triangle)];
    }

    Crease crease_of(std::span<const TriangleSide> both) const
    {
        const TriangleSide& a = both.front();
        const TriangleSide& b = both.back();
        Crease crease{a.low, a.high, into(a), into(b)};
        crease.outward = both.size() == 1 ? Vec3(-crease.left)
                                          : Vec3(normal_of(a.triangle) + normal_of(b.triangle));
        return crease;
    }

    const Vec3& normal_of(int triangle) const
    {
        return mesh_.patches[at(patch_[at(triangle)])].normal;
    }

    bool is_convex(std::span<const TriangleSide> both) const
    {
        return !within_a_patch(both) &&
               (both.size() == 1 ||
                normal_of(both.front().triangle).dot(crease_of(both).right) < 0);
    }

    void find_creases()
    {
        std::size_t count = 0;
        for_edges([&](std::span<const TriangleSide> both) { count += is_convex(both) ? 1 : 0; });
        mesh_.creases.reserve(count);
        for_edges([&](std::span<const TriangleSide> both) {
            if (is_convex(both)) {
                note(both);
            }
        });
    }

    void note(std::span<const TriangleSide> both)
    {
        for (const TriangleSide& s : both) {
            mesh_.triangles[at(s.triangle)].crease[at(s.side)] =
                static_cast<int>(mesh_.creases.size());
        }
        mesh_.creases.push_back(crease_of(both));
    }

    void find_sharp_corners()
    {
        struct Ends {
            int count = 0; // of edges between patches
            std::array<int, 2> corner{};
        };
        std::vector<Ends> ends(mesh_.corners.size());
        const auto add = [&](int corner, int end) {
            Ends& known = ends[at(corner)];
            known.corner[at(std::min(known.count++, 1))] = end;
        };
        for_edges([&](std::span<const TriangleSide> both) {
            if (!within_a_patch(both)) {
                add(both[0].low, both[0].high);
                add(both[0].high, both[0].low);
            }
        });
        for (std::size_t k = 0; k < ends.size(); ++k) {
            const auto direction = [&](std::size_t end) {
                return Vec3((point(ends[k].corner[end]) - mesh_.corners[k].point).normalized());
            };
            const bool on_a_line =
                ends[k].count == 2 && (direction(0) + direction(1)).norm() < straight;
            mesh_.corners[k].sharp = ends[k].count > 0 && !on_a_line;
        }
    }

    MeshTable mesh_;
    std::vector<std::array<int, 3>> triangles_;
    AlignedBox bounds_;
    std::vector<TriangleSide> sides_;
    std::vector<std::array<int, 3>> edge_; // of a triangle: where the sides of its edges begin
    std::vector<int> patch_;
};

} // namespace

MeshTable mesh_table(const MeshSurface& surface)
{
    return MeshTableBuilder(surface).table();
}

bool in_cone(const Crease& crease, const Vec3& n)
{
    return n.dot(crease.left) <= cone_slack && n.dot(crease.right) <= cone_slack;
}

bool in_cone(const MeshTable& mesh, const MeshCorner& corner, const Vec3& n)
{
    const std::span ends(mesh.neighbours);
    return std::ranges::all_of(ends.subspan(at(corner.first), at(corner.count)), [&](int k) {
        const Vec3 d = mesh.corners[at(k)].point - corner.point;
        return n.dot(d) <= cone_slack * d.norm();
    });
}

} // namespace hyoryu
