// SPDX-License-Identifier: MIT
// Operations counted from the text of a formula.
#include "bench/operations.hpp"

#include "hyoryu/bench/bench.hpp"

#include <gtest/gtest.h>

namespace hyoryu::bench {
namespace {

TEST(Operations, CountWhatAResultNeedsOnce)
{
    Operations all;
    const Counted a = Counted::input(all);
    const Counted b = Counted::input(all);
    const Counted unused = square_root(a * a + b);
    const Counted product = a * b;
    const Counted sum = product / (b - a) + a * b; // the product again: one operation
    EXPECT_EQ(all.needed_for({sum.node()}), 4);    // *, -, /, +
    EXPECT_EQ(all.needed_for({unused.node()}), 3);
    EXPECT_EQ(all.needed_for({sum.node(), unused.node()}), 7);
}

TEST(Operations, OfAPairAsCountedByHand)
{
    // r 3, |r|^2 5, |r| 1, q 1, bracket 1 - q/2 and its positive part 3, cube 2, F 1: 16.
    // Pressure: V V 1, p + p 1, scalar 2, vector 3, sums 3: 10.
    // Diffusion: p - p 1, times 1/c0^2 1, g.r 5, + 1, -strength V 1, times difference 1, F 1, sum
    // 1:
    // 12. Continuity: v_ij 3, dot 5, V 1, F 1, sum 1: 11. Viscosity, whose v_ij.r and V V are
    // known: positive part of -v_ij.r 1, beta 1, + kappa 1, times v_ij.r 1, r^2 + h^2/100 1, / 1,
    // V V mu 1, F 1, vector 3, sums 3: 14.
    EXPECT_EQ(flops_of_a_pair(), 16 + 10 + 12 + 11 + 14);
}

} // namespace
} // namespace hyoryu::bench
