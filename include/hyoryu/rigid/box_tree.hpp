// SPDX-License-Identifier: MIT
// Axis-aligned boxes, and a tree of them that answers which ones meet a given box.
#pragma once

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <span>
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

/// Calls f(index) for the boxes of every leaf below the node `from` that meets `box`, until f
/// returns true; whether it did.
bool any_of_near(const BoxTree& tree, const AlignedBox& box, const auto& f, std::size_t from = 0)
{
    if (from >= tree.nodes.size() || !tree.nodes[from].box.meets(box)) {
        return false;
    }
    const BoxTree::Node& node = tree.nodes[from];
    if (node.right >= 0) {
        return any_of_near(tree, box, f, from + 1) || any_of_near(tree, box, f, at(node.right));
    }
    return std::ranges::any_of(std::span(tree.order).subspan(at(node.first), at(node.count)), f);
}

/// Replaces `found` by the leaves' boxes that may meet `box`: indices in ascending order.
void find_near(const BoxTree& tree, const AlignedBox& box, std::vector<int>& found);

} // namespace hyoryu
