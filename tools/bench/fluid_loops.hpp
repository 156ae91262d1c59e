// SPDX-License-Identifier: MIT
// What the pair loops and the making of lists cost on one core.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

#include <string>
#include <vector>

namespace hyoryu::bench {

/// A cube of a jittered lattice at h/dp = 1.5, velocities and densities at random: the setting of
/// the published rates of pair loops.
struct LoopSetting {
    int edge = 53;        // particles along an edge
    double skin = 0.15;   // of the lists [spacings]
    double seconds = 0.5; // at least so much CPU time for each figure
    Precision precision = Precision::single_precision;
};

/// One figure: the median over repetitions.
struct Figure {
    std::string name;
    double value = 0;
    std::string unit;
};

/// Rates of one thread in CPU time. A pair is a directed interaction inside the support; list
/// entries outside it and padding do not count.
std::vector<Figure> measure_loops(const LoopSetting& setting);

} // namespace hyoryu::bench
