// SPDX-License-Identifier: MIT
// Predicted size of the histories of a run, as text and as columns of results.h5.
#pragma once

#include "hyoryu/scene/disk.hpp"

#include <vector>

namespace hyoryu {

/// An array that is smaller is stored as it is (io/packed_array) [B].
inline constexpr double worth_compressing = 65536;

/// One table of the results.
struct HistorySize {
    double rows = 0;
    double row_text = 0; // bytes of a row of the CSV file [B]
    double active = 0;   // columns of numbers that change
    double idle = 0;     // columns of constant numbers, mostly zero
    double names = 0;    // bytes of the columns of texts in a row of results.h5 [B]
    double text_columns = 0;
    double header = 0; // bytes of the names and units of its columns beyond the usual [B]
};

/// The tables that a run writes: energy, and bodies, contacts, gauges and open sides where there
/// are any.
std::vector<HistorySize> histories(const Scene& scene, const Plan& plan, const Course& course);

/// Bytes of the CSV files and of their columns in results.h5 [B].
double history_bytes(const std::vector<HistorySize>& tables);

/// Pairs that rest on each other at one time, if everything that may touch something does.
double resting_pairs(const Scene& scene, const Plan& plan);

} // namespace hyoryu
