// SPDX-License-Identifier: MIT
#include "hyoryu/rigid/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

constexpr int leaf_size = 4;

class BoxTreeBuilder {
public:
    BoxTreeBuilder(const std::vector<AlignedBox>& boxes, BoxTree& tree) : boxes_(boxes), tree_(tree)
    {
    }

    void build(int first, int count)
    {
        const std::size_t at = tree_.nodes.size();
        tree_.nodes.emplace_back();
        AlignedBox all;
        AlignedBox centres;
        for (int k = first; k < first + count; ++k) {
            all.add(boxes_[item(k)]);
            centres.add(centre(tree_.order[static_cast<std::size_t>(k)]));
        }
        tree_.nodes[at].box = all;
        if (count <= leaf_size) {
            tree_.nodes[at].first = first;
            tree_.nodes[at].count = count;
            return;
        }
        int axis = 0;
        (centres.high - centres.low).maxCoeff(&axis);
        const auto begin = tree_.order.begin() + first;
        std::nth_element(begin, begin + count / 2, begin + count, [&](int a, int b) {
            return std::pair(centre(a)[axis], a) < std::pair(centre(b)[axis], b);
        });
        build(first, count / 2);
        tree_.nodes[at].right = static_cast<int>(tree_.nodes.size());
        build(first + count / 2, count - count / 2);
    }

private:
    std::size_t item(int k) const
    {
        return static_cast<std::size_t>(tree_.order[static_cast<std::size_t>(k)]);
    }
    Vec3 centre(int box) const
    {
        const AlignedBox& b = boxes_[static_cast<std::size_t>(box)];
        return 0.5 * (b.low + b.high);
    }

    const std::vector<AlignedBox>& boxes_;
    BoxTree& tree_;
};

// Calls visit(leaf) for every leaf whose box is met, until it returns false.
void walk(const BoxTree& tree, const AlignedBox& box, const auto& visit)
{
    std::vector<int> open;
    if (!tree.nodes.empty()) {
        open.push_back(0);
    }
    while (!open.empty()) {
        const int at = open.back();
        open.pop_back();
        const BoxTree::Node& node = tree.nodes[static_cast<std::size_t>(at)];
        if (!node.box.meets(box)) {
            continue;
        }
        if (node.right < 0) {
            if (!visit(node)) {
                return;
            }
        } else {
            open.push_back(node.right);
            open.push_back(at + 1);
        }
    }
}

} // namespace

BoxTree tree_over(const std::vector<AlignedBox>& boxes)
{
    BoxTree tree;
    tree.order.resize(boxes.size());
    std::iota(tree.order.begin(), tree.order.end(), 0);
    if (!boxes.empty()) {
        BoxTreeBuilder(boxes, tree).build(0, static_cast<int>(boxes.size()));
    }
    return tree;
}

void find_near(const BoxTree& tree, const AlignedBox& box, std::vector<int>& found)
{
    found.clear();
    walk(tree, box, [&](const BoxTree::Node& leaf) {
        const auto begin = tree.order.begin() + leaf.first;
        found.insert(found.end(), begin, begin + leaf.count);
        return true;
    });
    std::sort(found.begin(), found.end());
}

bool any_near(const BoxTree& tree, const AlignedBox& box)
{
    bool any = false;
    walk(tree, box, [&](const BoxTree::Node&) {
        any = true;
        return false;
    });
    return any;
}

} // namespace hyoryu
