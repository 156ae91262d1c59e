// SPDX-License-Identifier: MIT
// Sums and maxima over all ranks, collected for one call.
#pragma once

#include "hyoryu/ranks/comm.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// Collects numbers of a rank, then reduces all of them over the ranks. All ranks collect the same
/// numbers in the same order. With one process it does nothing.
class Reduction {
public:
    /// `comm` is null for one process.
    explicit Reduction(Comm* comm) : comm_(comm) {}

    /// Registers sums that `run` replaces by those over all ranks. They must stay in place until
    /// then.
    void add(std::span<FixedSum> sums);
    /// Registers numbers that `run` replaces by the largest of all ranks; not-a-number if any is.
    void largest(std::span<double> numbers);

    /// Reduces all registered numbers over the ranks, in one call.
    void run();

private:
    Comm* comm_;
    std::vector<FixedSum*> sums_;
    std::vector<double*> largest_;
};

/// Replaces each number by the largest of all ranks.
void largest_of_all(Comm* comm, std::span<double> numbers);

} // namespace hyoryu
