// SPDX-License-Identifier: MIT
#include "covered.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// An open contact represents an overlap if it has at least this part of its depth and lies within
// `beside` times this depth.
constexpr double as_deep = 0.5;
constexpr double beside = 2;

} // namespace

void add_covered(std::vector<Candidate>& covered, double depth, std::size_t first,
                 std::vector<Candidate>& found)
{
    std::erase_if(covered, [&](const Candidate& c) { return !(c.touch.gap < -depth); });
    std::ranges::stable_sort(
        covered, [](const Candidate& c, const Candidate& d) { return c.touch.gap > d.touch.gap; });
    const std::size_t open = found.size();
    for (const Candidate& c : covered) {
        bool shown = false;
        for (std::size_t k = first; k < found.size(); ++k) {
            const Touch& touch = found[k].touch;
            const bool near = (touch.point - c.touch.point).norm() < -beside * c.touch.gap;
            shown = shown || (near && (k >= open || touch.gap < as_deep * c.touch.gap));
        }
        if (!shown) {
            found.push_back(c);
        }
    }
}

} // namespace hyoryu
