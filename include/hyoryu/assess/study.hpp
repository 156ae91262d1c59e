// SPDX-License-Identifier: MIT
// A study: a case, the keys that are swept, and the measured quantities. Plain data, read from a
// TOML file (docs/study.md explains the keys).
#pragma once

#include "hyoryu/assess/benchmark.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hyoryu {

/// The varied setting: a key of the case, or any set of overrides of the case.
struct StudySweep {
    enum class Finest { smallest, largest, none };
    std::string key;                  // of the case, or `threads`; may be empty
    std::string name;                 // of the value in expressions; the last part of the key
    std::vector<RunParameter> values; // numbers or texts
    std::vector<std::string> set;     // overrides with `${...}`, for every value
    std::vector<std::vector<std::string>> choices; // overrides for each value; may be empty
    Finest finest = Finest::smallest; // which end of the numbers is meant to be the most accurate
    const std::string& label() const { return key.empty() ? name : key; }
    bool numeric() const;
    /// Numbers of which one end is meant to be the most accurate: an order has a meaning.
    bool ordered() const { return numeric() && finest != Finest::none; }
};

/// As names of runs and legends have it.
std::string text_of(const RunParameter& value);

/// The key of a sweep over the threads of a run, which no case has.
inline constexpr const char* threads_key = "threads";

/// A measured number and its expected value.
struct StudyQuantity {
    std::string name;
    std::string unit;
    Quantity quantity;
    Expectation expected;
    bool against_finest = false; // held against the finest run of the sweep instead
    /// Expression by which errors are divided; empty: the magnitude of the expected value.
    std::string scale;
};

struct Study {
    enum class Mode { one_at_a_time, grid };
    std::string title;
    std::filesystem::path file, case_file;
    Mode mode = Mode::one_at_a_time;
    std::vector<std::string> set; // overrides of the case in all runs
    int repeats = 1;              // of each run, for wall times
    /// Expression of the columns of the summary: the cost of a run, which is the same on every
    /// machine of one instruction set (lists are padded to its registers); empty: pair
    /// interactions, or steps where there are none.
    std::string cost;
    Definitions definitions;
    std::vector<StudySweep> sweeps;
    std::vector<StudyQuantity> quantities;
};

/// Throws CaseError with every mistake of the file.
Study read_study(const std::filesystem::path& file);

/// One run: its overrides, its parameters by the names of the sweeps, and which value each sweep
/// has in it (-1: that of the case).
struct StudyRun {
    BenchmarkRun run;
    std::vector<int> value_of;
    int threads = 0; // 0: as the command says
};
/// All combinations of the values, or one sweep at a time. Throws FormulaError for an override that
/// cannot be evaluated.
std::vector<StudyRun> runs_of(const Study& study);

/// The value of a numeric sweep in a run.
double number_in(const Study& study, const StudyRun& run, std::size_t sweep);

/// The runs that differ in this sweep only from the first of them, in the order from coarse to
/// fine where the sweep is numeric: one list for each combination of the other sweeps.
std::vector<std::vector<std::size_t>>
series_of(const Study& study, const std::vector<StudyRun>& runs, std::size_t sweep);

} // namespace hyoryu
