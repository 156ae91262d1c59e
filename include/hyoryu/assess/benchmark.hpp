// SPDX-License-Identifier: MIT
// A benchmark: a case with runs, and the expected results. Plain data, read from the file
// `verify.toml` beside `case.toml` (docs/verify.md explains the keys).
#pragma once

#include "hyoryu/assess/formula.hpp"
#include "hyoryu/report/svg.hpp"
#include "hyoryu/scene/scene.hpp"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hyoryu {

/// When a run is made; each tier includes the ones before it.
enum class Tier { quick, nightly, release };
std::string to_string(Tier tier);
std::optional<Tier> tier_of(const std::string& name);

/// As the files name them.
inline constexpr std::array<std::string_view, 3> tier_names{"quick", "nightly", "release"};

/// A parameter of a run: a number, usable in expressions, or a text.
using RunParameter = std::variant<double, std::string>;
/// As tables have it; the shortest text that reads back as the same number.
std::string cell(const RunParameter& value);

/// Numbers, or expressions of the constants before them.
using Constants = std::vector<std::pair<std::string, std::string>>;

/// The names that expressions of a file may use besides the parameters of a run.
struct Definitions {
    Constants constants;
    std::map<std::string, std::string> columns; // derived columns: expressions of other columns
};

/// One run of the case.
struct BenchmarkRun {
    std::string name;
    std::vector<std::string> set; // overrides of the case, as `hyoryu run --set` takes them
    Tier tier = Tier::quick;
    std::vector<std::pair<std::string, RunParameter>> parameters; // in the order of the file
    std::string stops; // words of the error that it must stop with; empty: it must come to its end
};

/// Values over time, or of the particles of a frame: an expression of the columns of some rows of a
/// file.
struct Series {
    /// A history of the run, "summary", a CSV file of the benchmark, or "fluid": a row a particle.
    std::string file = "bodies";
    std::string frame; // of "fluid": expression of its time [s]; empty: the last one
    std::map<std::string, std::string> where; // cells that a row must hold, by column
    std::string filter;                       // expression that is not zero in a row; may be empty
    std::string value;                        // expression
};

/// One number of a series, as `measure` names it.
enum class Measure {
    at,    // at the time `time`, linear between rows
    first, // row
    last,
    min,
    max,
    mean,
    sum,
    count,         // of rows
    range,         // max - min
    drift,         // last - first
    gain,          // largest rise above an earlier value
    growth,        // the largest value over the first
    row,           // of number `index`
    peak,          // local maximum of number `index`, by the parabola through three rows
    peak_time,     // when that is [s]
    trough,        // local minimum of number `index`
    crossing,      // time [s] at which the value passes `level` for the `index`-th time
    integral,      // over time, by trapezoids
    period,        // [s] of an oscillation about `level`: mean time between passes
    decay,         // rate [1/s] at which its extrema fall, by least squares of their logarithms
    height,        // of regular waves: 2 sqrt(2) times the standard deviation over whole periods
    reflection,    // height of the waves that go back over that of those that come
    share_within,  // of the rows of a band in which the run lies within the band
    rms_error,     // root mean square of the difference from a series
    largest_error, // largest absolute difference from a series
};
/// Whether it is the difference from something expected.
bool is_error_measure(Measure measure);

/// Two bounds over time, for instance percentiles of repeated experiments.
struct Band {
    Series lower;
    std::string upper; // expression of the same rows
};

/// What the measure `reflection` needs besides the elevation at the first gauge.
struct WaveGauges {
    std::vector<std::string> beside; // elevation at the others: expressions of the same rows
    std::vector<double> distance;    // of each from the first, the way the waves come [m]
    std::string period;              // expression [s]
    std::string wavenumber;          // expression [rad/m]
};

/// A measured number and how it is taken. Expressions are of constants and the run's parameters.
struct Quantity {
    Series series;
    std::optional<Band> band;        // of share_within
    std::optional<WaveGauges> waves; // of reflection
    Measure measure = Measure::last;
    int index = 1;     // from 1
    std::string time;  // [s]
    std::string level; // in the unit of the value; of an oscillation, if empty, its mean
    std::string since; // expression of the rows whose measure is subtracted; may be empty
    std::string from;  // only rows from this time on [s]; may be empty
    std::string until; // only rows until this time [s]; may be empty
};

/// The expected value of a measured number.
struct Expectation {
    std::string formula;             // expression; of rows for the error measures
    std::optional<Series> reference; // taken instead
};

/// How a measured number is judged against the expected one.
enum class Comparison { equal, at_most, at_least };

/// Where the expected number of a check comes from.
enum class Against {
    experiment,   // measured in a laboratory
    analytic,     // a closed form, or an ordinary differential equation integrated to round-off
    program,      // computed by another program
    conservation, // mass, momentum and energy, which any flow has to keep
    itself,       // another run of this program, or bounds on its own diagnostics
};
/// As `against` of verify.toml names it.
std::string to_string(Against against);

struct Check {
    std::string name;
    Place place;
    std::vector<std::string> runs;   // patterns of the runs in which it is measured
    std::vector<std::string> judged; // patterns of the runs in which it is judged as well
    Quantity quantity;
    Comparison comparison = Comparison::equal;
    Expectation expected;
    /// A run whose value of the same quantity, with the parameters of that run, is the expected
    /// value; may contain `${...}` like the names of runs.
    std::string same_as;
    /// Parameter of a grid that tells draws of one result apart: the mean over the runs that differ
    /// in it alone is judged, at the last of them; empty: each run by itself.
    std::string mean_over;
    std::string tolerance; // expression: absolute, in the unit of the value; empty: relative
    double relative = 0;   // part of the expected value
    std::string because;   // where the tolerance comes from
    std::string xfail;     // why it is known to fail; empty: it must pass
    std::vector<std::string> xfail_runs; // patterns
    /// Expression: how far a known failure may be off the expected value, in the unit of the value.
    std::string xfail_within;
    std::optional<Against> against; // nothing: the file does not say
};

struct Curve {
    std::string label;
    std::string run;     // results that it shows; empty: a reference or an expression of t alone
    Series series;       // of the vertical axis
    std::string x = "t"; // expression of the horizontal axis
    ChartLine::Style style = ChartLine::Style::line;
};

struct Panel {
    std::string title, x_axis, y_axis;
    std::optional<Range> x_range, y_range; // none: of the curves
    std::vector<Curve> curves;
};

struct Figure {
    std::string file; // SVG in the output folder
    std::string title;
    std::vector<Panel> panels; // side by side
};

/// Worst and rms errors of checks over runs that share some parameters, as a table of a document.
struct SummaryTable {
    struct Item {
        std::string check;
        std::string label;
        std::string unit;
        double scale = 1; // of the numbers shown
    };
    std::string file; // Markdown in the output folder; tables that name the same file follow there
    std::string preface; // before the title, for the first table of a file
    std::string title;
    std::string text;            // before the table
    std::vector<std::string> by; // parameters: one row of the table for each of their combinations
    std::vector<Item> items;
};

struct Benchmark {
    std::string name; // of its folder
    std::filesystem::path folder;
    std::string title;
    std::string group;
    std::vector<std::string> also; // other groups that it belongs to
    std::string source;            // of the reference
    std::string uncertainty;       // of the reference, in words; may be empty
    Definitions definitions;
    std::vector<BenchmarkRun> runs;
    std::vector<Check> checks;
    std::vector<Figure> figures;
    std::vector<SummaryTable> tables;
};

/// Reads `folder/verify.toml`. Throws CaseError with every mistake of the file.
Benchmark read_benchmark(const std::filesystem::path& folder);

/// The folders in a folder of cases that have a `verify.toml`; none if it cannot be read.
std::set<std::filesystem::path> benchmark_folders(const std::filesystem::path& cases);

/// The benchmarks of a folder of cases, by name. Throws CaseError with the mistakes of all files.
std::vector<Benchmark> read_benchmarks(const std::filesystem::path& cases);

/// Those whose folder or group is named, all if no name is given, without runs above `tier`. Throws
/// CaseError for an unknown name, and for a name that has no run in this tier.
std::vector<Benchmark> select(std::vector<Benchmark> benchmarks,
                              const std::vector<std::string>& names, Tier tier);

/// The run of that name, or none.
const BenchmarkRun* find_run(const Benchmark& benchmark, const std::string& name);

/// Constants, derived columns and the numbers among the run's parameters; a parameter replaces the
/// constant of its name. Throws FormulaError.
Scope scope_of(const Definitions& definitions, const BenchmarkRun& run);

/// The text with every `${...}` replaced by the run's parameter of that name if it is a text, else
/// by the number that the expression gives. Throws FormulaError.
std::string expanded(const std::string& text, const BenchmarkRun& run, const Scope& scope);

/// The series with every `${...}` in its file and its cells replaced by its value in that run.
/// Throws FormulaError.
Series expanded(Series series, const BenchmarkRun& run, const Scope& scope);

/// True if one of the patterns fits the name; `*` stands for any letters.
bool matches(const std::vector<std::string>& patterns, const std::string& name);

/// Whether the check takes the mean over both runs: they differ at most in its parameter of draws.
bool are_draws(const Check& check, const BenchmarkRun& a, const BenchmarkRun& b);

} // namespace hyoryu
