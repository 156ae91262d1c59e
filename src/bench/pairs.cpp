// SPDX-License-Identifier: MIT
#include "pairs.hpp"

namespace hyoryu::bench {

namespace {

std::size_t row_of(const FluidNeighbours& n, Index slot)
{
    for (const Tiles* tiles : {&n.body, &n.wall}) {
        if (slot >= tiles->first_slot) {
            return static_cast<std::size_t>(
                tiles->row[static_cast<std::size_t>(slot - tiles->first_slot)]);
        }
    }
    return static_cast<std::size_t>(n.fluid.row[static_cast<std::size_t>(slot)]);
}

} // namespace

double pairs_within_support(const Fluid& fluid, const PairList& list)
{
    const auto x = fluid.particles.fluid[field::position];
    double pairs = 0;
    list.for_each_pair([&](Index i, Index j) {
        const double squared =
            (x[row_of(fluid.neighbours, i)] - x[row_of(fluid.neighbours, j)]).squaredNorm();
        pairs += i != j && squared < sq(fluid.kernel.support) ? 1 : 0;
    });
    return pairs;
}

} // namespace hyoryu::bench
