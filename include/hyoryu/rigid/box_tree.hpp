// SPDX-License-Identifier: MIT
// Axis-aligned boxes, and a tree of them that answers which ones meet a given box.
#pragma once

#include "hyoryu/core/types.hpp"

#include <vector>

namespace hyoryu {

/// An axis-aligned box [m].
struct AlignedBox {
    Vec3 low = Vec3::Constant(infinity);
    Vec3 high = Vec3::Constant(-infinity);

    void add(const Vec3& point)
    {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    void add(const AlignedBox& other)
    {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
    }
    AlignedBox grown(double margin) const
    {
        return {low - Vec3::Constant(margin), high + Vec3::Constant(margin)};
    }
    bool meets(const AlignedBox& other) const
    {
        return (low.array() <= other.high.array()).all() &&
               (other.low.array() <= high.array()).all();
    }
};

/// A binary tree over boxes, split at the median of their centres along the longest axis. Plain
/// data; nodes stand in the order in which they are walked.
struct BoxTree {
    struct Node {
        AlignedBox box;
        int right = -1;           // the second child; the first one follows the node. -1: a leaf
        int first = 0, count = 0; // of a leaf: its range in `order`
    };
    std::vector<Node> nodes;
    std::vector<int> order; // indices of the boxes
};

BoxTree tree_over(const std::vector<AlignedBox>& boxes);

/// Replaces `found` by the leaves' boxes that may meet `box`: indices in ascending order.
void find_near(const BoxTree& tree, const AlignedBox& box, std::vector<int>& found);

/// Whether the box meets a leaf of the tree.
bool any_near(const BoxTree& tree, const AlignedBox& box);

} // namespace hyoryu
