// SPDX-License-Identifier: MIT
// Numbers of which all ranks want the sum or the largest, collected for one call.
#pragma once

#include "hyoryu/ranks/comm.hpp"

#include <span>
#include <vector>

namespace hyoryu {

/// Collects numbers of a rank, then makes each that of all ranks. All ranks collect the same
/// numbers in the same order. With one process it does nothing.
class Reduction {
public:
    /// `comm` is null for one process.
    explicit Reduction(Comm* comm) : comm_(comm) {}

    /// Each of the sums is to become that of all ranks. They stay where they are until `run`.
    void add(std::span<FixedSum> sums);
    /// Each of the numbers is to become the largest of those of all ranks; not-a-number if any is.
    void largest(std::span<double> numbers);

    /// Makes all collected numbers those of all ranks, in one call.
    void run();

private:
    Comm* comm_;
    std::vector<FixedSum*> sums_;
    std::vector<double*> largest_;
};

/// Each number becomes the largest of those of all ranks.
void largest_of_all(Comm* comm, std::span<double> numbers);

} // namespace hyoryu
