// SPDX-License-Identifier: MIT
#include "mesh_parts.hpp"

#include "hyoryu/scene/triangle_tree.hpp"

#include <array>

namespace hyoryu {

namespace {

// Behind a triangle, of the extent of the mesh: less than any part is thick, but more than the
// numbers of a file are rounded; and what an overlap must have at least.
constexpr double just_behind = 1e-6;
constexpr double least_overlap = 1e-3;
constexpr double thin_part = 1e-3; // of `just_behind`
// Winding numbers are wrong by a few hundredths.
constexpr double out = 0.5;
constexpr double twice = 1.5;

// The boxes about the parts.
std::vector<Bounds> boxes_of(const TriangleTree& tree)
{
    const std::vector<int> parts = pieces_of(tree);
    std::vector<Bounds> of_part(parts.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
        for (const int corner : tree.triangles[k].corner) {
            of_part[at(parts[k])].add(tree.corners[at(corner)]);
        }
    }
    std::erase_if(of_part, [](const Bounds& box) { return !(box.min.x() <= box.max.x()); });
    return of_part;
}

class PartJudge {
public:
    PartJudge(const MeshShape& mesh, PartsAsked asked)
        : mesh_(mesh), asked_(asked), tree_(triangle_tree(mesh.corners, mesh.triangles))
    {
        Bounds box;
        for (const Vec3& corner : mesh.corners) {
            box.add(corner);
        }
        extent_ = (box.max - box.min).norm();
    }

    PartFaults judge()
    {
        if (tree_.is_one_piece) {
            return {};
        }
        for (const auto& triangle : mesh_.triangles) {
            look_behind(triangle);
        }
        if (asked_ == PartsAsked::all) {
            look_for_overlaps();
        }
        return faults_;
    }

private:
    void look_behind(const std::array<int, 3>& triangle)
    {
        const auto corner = [&](std::size_t k) { return mesh_.corners[at(triangle[k])]; };
        const Vec3 area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        if (!(area.norm() > 0)) {
            return;
        }
        const Vec3 normal = area.normalized();
        const Vec3 middle = (corner(0) + corner(1) + corner(2)) / 3;
        look_behind(middle, normal);
        // Triangles of finer meshes are smaller than any part.
        constexpr std::size_t many = 20000;
        for (std::size_t k = 0; mesh_.triangles.size() < many && k < 3; ++k) {
            constexpr double share = 0.7;
            look_behind(middle + share * (corner(k) - middle), normal);
        }
    }
    void look_for_overlaps()
    {
        std::vector<Bounds> boxes = boxes_of(tree_);
        std::ranges::stable_sort(boxes, {}, [](const Bounds& box) { return box.min.x(); });
        for (std::size_t a = 0; a < boxes.size(); ++a) {
            for (std::size_t b = a + 1; b < boxes.size() && boxes[b].min.x() < boxes[a].max.x();
                 ++b) {
                look_between(boxes[a], boxes[b]);
                if (faults_.overlap) {
                    return;
                }
            }
        }
    }
    void look_behind(const Vec3& place, const Vec3& normal)
    {
        const auto winding = [&](double depth) {
            return winding_number(tree_, place - depth * extent_ * normal);
        };
        const double turns = winding(just_behind);
        // The part may be thinner than that.
        if (turns < out && !faults_.inside_out && winding(thin_part * just_behind) < out) {
            faults_.inside_out = place;
        }
        if (asked_ == PartsAsked::all && turns > twice && !faults_.overlap &&
            winding(least_overlap) > twice) {
            faults_.overlap = place;
        }
    }
    // Within what two boxes share.
    void look_between(const Bounds& a, const Bounds& b)
    {
        constexpr int steps = 5;
        const Vec3 low = a.min.cwiseMax(b.min);
        const Vec3 edge = a.max.cwiseMin(b.max) - low;
        if (!(edge.minCoeff() > least_overlap * extent_)) {
            return;
        }
        for (int k = 0; k < steps * steps * steps && !faults_.overlap; ++k) {
            const int layer = k / (steps * steps);
            const Vec3 cell(k % steps, k / steps % steps, layer);
            // Off the planes of symmetry, in which faces of parts that only touch often lie.
            const Vec3 middle(0.4363, 0.5127, 0.5719);
            const Vec3 place = low + edge.cwiseProduct((cell + middle) / steps);
            if (winding_number(tree_, place) > twice) {
                faults_.overlap = place;
            }
        }
    }

    const MeshShape& mesh_;
    PartsAsked asked_;
    TriangleTree tree_;
    double extent_ = 0; // of the whole mesh [m]
    PartFaults faults_;
};

} // namespace

PartFaults part_faults(const MeshShape& mesh, PartsAsked asked)
{
    return PartJudge(mesh, asked).judge();
}

} // namespace hyoryu
