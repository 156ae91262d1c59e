// SPDX-License-Identifier: MIT
#include "hyoryu/rigid/box_tree.hpp"

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
            centres.add(centre(tree_.order[k]));
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
    std::size_t item(int k) const { return static_cast<std::size_t>(tree_.order[k]); }
    Vec3 centre(int box) const
    {
        const AlignedBox& b = boxes_[box];
        return 0.5 * (b.low + b.high);
    }

    const std::vector<AlignedBox>& boxes_;
    BoxTree& tree_;
};

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
    any_of_near(tree, box, [&](int k) {
        found.push_back(k);
        return false;
    });
    std::sort(found.begin(), found.end());
}

} // namespace hyoryu
