// SPDX-License-Identifier: MIT
// The signed distance to a closed triangle surface by a tree of boxes: O(log n) for n triangles.
#pragma once

#include "hyoryu/scene/shapes.hpp"

#include <array>
#include <vector>

namespace hyoryu {

/// The place of a surface that is nearest to a point.
struct NearestPlace {
    double distance = infinity; // of the point from it, negative inside [m]
    Vec3 normal{0, 0, 1};       // unit: the way in which the distance grows fastest
};

/// A closed triangle surface. Plain data; the first child of a node follows it.
struct TriangleTree {
    struct Node {
        Bounds box;
        int right = -1;           // second child; -1: a leaf
        int first = 0, count = 0; // range of its triangles, of all below it
    };
    /// The triangles below a node, for the winding number of distant points.
    struct Moment {
        Vec3 area{0, 0, 0};   // sum of area times normal [m2]
        Vec3 middle{0, 0, 0}; // of the triangles, by area [m]
        double radius = 0;    // from there to the farthest corner [m]
    };
    struct Triangle {
        std::array<int, 3> corner;
        std::array<int, 3> edge; // from corner k on
    };
    std::vector<Node> nodes;
    std::vector<Moment> moments; // of each node; of the first one only if the surface is connected
    std::vector<Triangle> triangles; // in the order of the leaves
    std::vector<Vec3> corners;       // [m]
    /// Any length: of corners, weighted by angles, and of edges; with those of the faces, on which
    /// side a point is, is the sign of the one of the nearest feature.
    std::vector<Vec3> corner_normals, edge_normals;
    /// The surface is joined by edges, so that none of it can lie inside another part of it.
    bool is_one_piece = false;
};

/// The tree of a closed surface whose triangles wind outwards.
TriangleTree triangle_tree(const std::vector<Vec3>& corners,
                           const std::vector<std::array<int, 3>>& triangles);

/// The piece of each triangle of the tree, by the lowest number of its triangles. Pieces that share
/// corners alone are apart: either may lie inside the other.
std::vector<int> pieces_of(const TriangleTree& tree);

/// The nearest place of the surface. The sign is that of the pseudonormal of the nearest feature
/// (Baerentzen and Aanaes 2005); where parts may overlap, of the winding number (Barill et al.
/// 2018, with one term). Distance infinity if it is farther away than `farthest`.
NearestPlace nearest_place(const TriangleTree& tree, const Vec3& point, double farthest);

/// How often the surface winds about a point: 1 inside, 0 outside, 2 where two parts overlap,
/// within a few hundredths (Barill et al. 2018, with one term). Only for surfaces that are not one
/// piece.
double winding_number(const TriangleTree& tree, const Vec3& point);

} // namespace hyoryu
