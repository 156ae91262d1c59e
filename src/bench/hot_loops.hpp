// SPDX-License-Identifier: MIT
// Loops of the benchmark that depend on the instruction set.
#pragma once

#include "hyoryu/core/compiled_sets.hpp"
#include "hyoryu/fluid/pair_loops.hpp"

namespace hyoryu::bench {

template <class Real>
struct HotLoops {
    using Loop = typename PairLoops<Real>::Loop;

    /// x = x a + b in `rounds` rounds of independent chains of packs; returns a value that depends
    /// on x.
    double (*chains)(Index rounds, double a, double b) = nullptr;
    double flops_of_a_round = 0;
    /// Pressure, diffusion, continuity and viscosity in one loop, as schemes with one evaluation
    /// a step have them. Both effects must be on.
    Loop all_terms = nullptr;
};

using HotLoopTable = std::tuple<HotLoops<float>, HotLoops<double>>;

/// The loops as compiled for one instruction set.
template <int bytes>
const HotLoopTable* hot_loops();

/// The same for an instruction set that must be available.
const HotLoopTable& hot_loops_for(InstructionSet set);

} // namespace hyoryu::bench
