// SPDX-License-Identifier: MIT
// `hyoryu bench`: the limits of the machine and the rates of the solver. It measures arithmetic and
// memory rates, the pair loops on a fixed set of particles, and whole steps of a dam break; results
// are text and JSON.
#pragma once

#include "hyoryu/core/instruction_set.hpp"
#include "hyoryu/core/types.hpp"
#include "hyoryu/fluid/memory.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hyoryu::bench {

/// Limits of the machine, measured by our own loops: the best of several tries.
struct MachineLimits {
    double fma_single = 0;     // of one thread, in fused multiply-adds of packs [flop/s]
    double fma_double = 0;     // [flop/s]
    double fma_single_all = 0; // of all threads together [flop/s]
    double triad = 0;     // a = b + s c from memory, by one thread, three streams counted [B/s]
    double triad_all = 0; // by all threads [B/s]
};
/// `seconds`: for each try.
MachineLimits measure_limits(InstructionSet set, int threads, double seconds);

/// A cube of a jittered lattice at h/dp = 1.5, velocities and densities at random: the setting of
/// the published rates of pair loops.
struct LoopSetting {
    int edge = 53;                // particles along an edge
    double skin = 0.15;           // of the lists [spacings]
    double smoothing_ratio = 1.5; // h/dp
    double seconds = 0.5;         // at least so much CPU time for each figure
    Precision precision = Precision::single_precision;
};

/// Rates of one thread in CPU time. A pair is a directed interaction inside the support; list
/// entries outside it and padding do not count.
struct LoopRates {
    LoopSetting setting;
    double neighbours = 0;     // of a particle
    double hit_share = 0;      // of the list entries that lie inside the support
    double all_terms = 0;      // pressure, diffusion, continuity and viscosity in one loop [pair/s]
    double forces = 0;         // stage [pair/s]
    double rates = 0;          // stage [pair/s]
    double pressure = 0;       // stage [particle/s]
    double lists = 0;          // making them [pair/s]
    double lists_in_loops = 0; // the cost of making lists in loops over all terms
    double list_bytes = 0;     // of a particle
    double flops = 0;          // of a pair in the loop over all terms
    double bytes = 0;          // that a pair must move from and to memory [B]
};
LoopRates measure_loops(const LoopSetting& setting);

/// Operations of the loop over all terms for one pair: those its text asks for and its sums need,
/// each +, -, *, / and root counted once.
double flops_of_a_pair();

/// Seconds of a stage of a step.
struct StageTime {
    std::string name;
    double one = 0; // by one thread [s]
    double all = 0; // by all threads [s]
};

/// Whole steps of a scene.
struct StepRates {
    std::string scene;
    double time = 0;    // where the steps begin [s]
    double spacing = 0; // [m]
    Index fluid = 0;    // particles
    Index solid = 0;    // particles of walls
    int steps = 0;      // of one try
    int threads = 1;    // all
    double one = 0;     // a step by one thread, the best try [s]
    double all = 0;     // by all threads, the best try [s]
    double pairs = 0;   // directed pairs of a fluid particle, over both loops of a step
    double builds = 0;  // of lists, a step
    std::vector<StageTime> stages;
    std::vector<MemoryUse> memory;

    Index particles() const { return fluid + solid; }
    /// T1 / (n Tn).
    double efficiency() const { return one / (threads * all); }
};

/// How much is measured.
struct Extent {
    std::string name;        // "quick", "standard", "full"
    double seconds = 0.5;    // for each figure of a loop
    int edge = 53;           // of the cube of particles
    double spacing = 0.0085; // of the reference scene [m]
    double developed = 0.4;  // time of the developed state [s]
    int steps = 20;          // of one try
    int tries = 3;
    std::vector<double> sizes; // numbers of fluid particles for cost against N
};
Extent quick();
Extent standard();
Extent full();

struct Setting {
    Extent extent;
    int threads = 1;
    std::filesystem::path state; // folder that keeps the developed state; empty: none
    std::function<void(const std::string&)> tell; // reports the current measurement
};

struct Results {
    Extent extent;
    InstructionSet set = InstructionSet::baseline;
    int threads = 1;
    MachineLimits limits;
    std::vector<LoopRates> loops;
    std::vector<StepRates> steps; // of the reference scene
    std::vector<StepRates> sizes; // cost against N
};
Results measure(const Setting& setting);

/// The results as JSON: numbers in SI units, and shares. `build`: version and options.
std::string to_json(const Results& results, const std::string& build);
/// The results as text for a terminal.
std::string table(const Results& results);

} // namespace hyoryu::bench
