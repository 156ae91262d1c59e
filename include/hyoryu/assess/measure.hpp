// SPDX-License-Identifier: MIT
// From the files that a run wrote to the numbers that a benchmark asks for.
#pragma once

#include "hyoryu/assess/benchmark.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hyoryu {

/// The files of one run and of its benchmark, each read once.
class RunFiles {
public:
    /// `results`: folder of the run; `benchmark`: where reference files stand.
    RunFiles(std::filesystem::path results, std::filesystem::path benchmark);

    /// "bodies" is `bodies.csv` of the run; "summary" its `summary.json` as a table of one row with
    /// dotted names ("contact.impacts"); a name that ends in ".csv" is a file of the benchmark.
    /// Throws IoError.
    const CsvTable& table(const std::string& file);

    /// The particles of the frame "fluid" at `time` [s], the last one if it is NaN, one a row:
    /// time, x, y, z, vx, vy, vz, p, rho. Throws IoError if there is no frame at that time.
    const CsvTable& frame(double time);

private:
    std::filesystem::path results_, benchmark_;
    std::map<std::string, CsvTable> tables_;
    std::map<std::string, CsvTable> frames_; // by file
};

/// Values over time, in the order of the rows.
struct Samples {
    std::vector<double> t; // [s]; zero for a table without the column `time`
    std::vector<double> values;
};

/// The values of the rows that the series selects. Throws FormulaError for a name that the file
/// does not have, and IoError.
Samples samples(const Series& series, const Scope& scope, RunFiles& files);

/// A number, or the reason why there is none.
struct Measured {
    double value = 0; // NaN if there is none
    std::string why;  // empty if there is one
};

/// The samples at the times that the quantity asks for. Throws FormulaError.
Samples within(const Quantity& quantity, const Scope& scope, const Samples& all);

/// One number of the samples. Not for the error measures, bands and reflection.
Measured measure(const Quantity& quantity, const Scope& scope, const Samples& samples);

/// Root mean square or largest absolute difference of the quantity from an expression of its rows,
/// or from reference samples at their times, between which the run is linear.
Measured error_from(const Quantity& quantity, const std::string& expected, const Scope& scope,
                    RunFiles& files);
Measured error_from(const Quantity& quantity, const Samples& reference, const Scope& scope,
                    RunFiles& files);

/// Share of the rows of the band, 0 to 1, in which the run, linear between its rows, lies within.
Measured share_within(const Quantity& quantity, const Scope& scope, RunFiles& files);

/// A finished run, with the numbers that its expressions may use and its files.
struct MadeRun {
    const BenchmarkRun& run;
    Scope scope;
    RunFiles files;
};

/// The computed and the expected value of a quantity in a run.
struct Compared {
    double got = 0;      // NaN if it cannot be measured
    double expected = 0; // NaN if nothing is; of an error measure zero
    std::string why;     // one of the two values cannot be determined; empty if both can
};
/// By the expectation, or by the same quantity in another run, with the parameters of that run.
/// `${...}` stands for its value in each run. Throws FormulaError and IoError.
Compared compare(const Quantity& quantity, const Expectation& expected, MadeRun& made,
                 MadeRun* other = nullptr);

} // namespace hyoryu
