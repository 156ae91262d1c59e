// SPDX-License-Identifier: MIT
// `[[check]]`: the measured quantity, its expected value and the tolerance.
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/scene/reader_hint.hpp"
#include "reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hyoryu {

namespace {

// In the order of `Measure`.
constexpr std::array<std::string_view, 25> measures{
    "at",         "first",        "last",      "min",          "max",    "mean",  "sum",
    "count",      "range",        "drift",     "gain",         "growth", "row",   "peak",
    "peak_time",  "trough",       "crossing",  "integral",     "period", "decay", "height",
    "reflection", "share_within", "rms_error", "largest_error"};

constexpr std::array<std::string_view, 5> against_names{"experiment", "analytic", "program",
                                                        "conservation", "itself"};

/// Exactly one of `expected`, `at_most`, `at_least`, `reference` and `same_as`.
void read_expected(Section& section, Check& check)
{
    int given = read_expectation(section, check.expected);
    for (const auto& [key, comparison] :
         {std::pair("at_most", Comparison::at_most), std::pair("at_least", Comparison::at_least)}) {
        if (const std::string bound = section.expression(key); !bound.empty()) {
            check.expected.formula = bound;
            check.comparison = comparison;
            given += 1;
        }
    }
    check.same_as = section.text("same_as");
    given += check.same_as.empty() ? 0 : 1;
    if (given != 1) {
        section.error("",
                      "give one of `expected`, `at_most`, `at_least`, `reference` and `same_as`");
    }
    if (check.quantity.waves && !check.same_as.empty()) {
        section.error("same_as", "has no meaning for the measure \"reflection\"");
    }
    if (is_error_measure(check.quantity.measure) && check.comparison != Comparison::equal) {
        section.error("measure", "is the difference from `expected` or `reference`",
                      "give `expected` as an expression of t and `tolerance`");
    }
}

void read_tolerance(Section& section, Check& check)
{
    check.tolerance = section.expression("tolerance");
    check.relative = section.number("relative", 0);
    check.because = section.text("because");
    const bool one = section.has("tolerance") != section.has("relative");
    if (check.comparison == Comparison::equal && !one) {
        section.error("tolerance", "give either `tolerance` or `relative`");
    }
    if (check.comparison != Comparison::equal &&
        (section.has("tolerance") || section.has("relative"))) {
        section.error(section.has("tolerance") ? "tolerance" : "relative",
                      "cannot be combined with a bound, which is itself the limit");
    }
    if (is_error_measure(check.quantity.measure) && section.has("relative")) {
        section.error("relative", "has no meaning for an error measure",
                      "give `tolerance` in the unit of the value");
    }
    if (check.because.empty()) {
        section.error("because", "is missing: give the reason for this tolerance or bound");
    }
}

/// Every run of the check must find the one it is held against: made before it, whatever the tier.
void find_same(Section& section, const Check& check, const Benchmark& benchmark)
{
    const auto place = [&](const BenchmarkRun& run) { return &run - benchmark.runs.data(); };
    for (const BenchmarkRun& run : benchmark.runs) {
        if (!matches(check.runs, run.name)) {
            continue;
        }
        const std::string name = expanded(check.same_as, run, scope_of(benchmark.definitions, run));
        const BenchmarkRun* other = find_run(benchmark, name);
        if (other == nullptr) {
            section.error("same_as", fmt::format("no run is named \"{}\"", name));
        } else if (place(*other) > place(run) || other->tier > run.tier) {
            section.error(
                "same_as",
                fmt::format("the run \"{}\" is not made before the run \"{}\"", name, run.name),
                "define it earlier, in the same tier or a lower one");
        }
    }
}

/// Two runs of the check must be draws of one result.
void find_draws(Section& section, const Check& check, const std::vector<BenchmarkRun>& runs)
{
    for (const BenchmarkRun& run : runs) {
        const auto is_draw = [&](const BenchmarkRun& other) {
            return &other != &run && other.tier == run.tier && are_draws(check, other, run);
        };
        if (std::ranges::any_of(runs, is_draw)) {
            return;
        }
    }
    section.error("mean_over",
                  fmt::format("no two runs of the check differ in \"{}\" alone", check.mean_over),
                  "name a parameter of their grid, with two values or more");
}

/// The source of the expected number.
std::optional<Against> read_against(Section& section, std::optional<Against> fallback)
{
    const auto against = section.choice("against", against_names);
    return against ? static_cast<Against>(*against) : fallback;
}

/// Why it is known to fail, where, and how far it may be off there.
void read_known_failure(Section& section, const std::vector<BenchmarkRun>& runs, Check& check)
{
    check.xfail = section.text("xfail");
    check.xfail_runs = read_patterns(section, "xfail_runs", runs);
    check.xfail_within = section.expression("xfail_within");
    for (const char* key : {"xfail_runs", "xfail_within"}) {
        if (section.has(key) && check.xfail.empty()) {
            section.error(key, "has no meaning without `xfail`");
        }
    }
    if (!check.xfail.empty() && !section.has("xfail_within")) {
        section.error("xfail_within",
                      "is missing: the largest error of the known failure, beyond which it fails",
                      "give a distance in the unit of the value");
    }
}

Check read_check(Section& section, const Benchmark& benchmark, std::optional<Against> against)
{
    const std::vector<BenchmarkRun>& runs = benchmark.runs;
    Check check;
    section.require("name");
    check.name = section.label("name");
    check.place = section.place();
    check.runs = read_patterns(section, "runs", runs);
    check.judged = read_patterns(section, "judged", runs);
    check.quantity = read_quantity(section);
    read_expected(section, check);
    read_tolerance(section, check);
    read_known_failure(section, runs, check);
    check.mean_over = section.text("mean_over");
    if (!check.mean_over.empty() && !check.same_as.empty()) {
        section.error("mean_over", "cannot be combined with `same_as`");
    } else if (!check.mean_over.empty()) {
        find_draws(section, check, runs);
    }
    check.against = read_against(section, check.same_as.empty() ? against : Against::itself);
    try {
        if (!check.same_as.empty()) {
            if (!check.quantity.since.empty()) {
                section.error("since", "cannot be combined with `same_as`");
            }
            find_same(section, check, benchmark);
        }
    } catch (const FormulaError& fault) {
        section.error("same_as", fault.what());
    }
    section.finish();
    return check;
}

// Two gauges half a wavelength apart record the same wave; a third one resolves the ambiguity.
constexpr std::size_t fewest_gauges = 3;

WaveGauges read_waves(Section& section)
{
    WaveGauges waves;
    for (const char* key : {"beside", "distance", "period", "wavenumber"}) {
        section.require(key);
    }
    for (const TomlNode* item : section.items("beside", "a list of expressions")) {
        waves.beside.push_back(checked_expression(section.file(), *item, section.full("beside")));
    }
    waves.distance = section.numbers("distance");
    waves.period = section.expression("period");
    waves.wavenumber = section.expression("wavenumber");
    if (section.has("beside") && waves.beside.size() + 1 < fewest_gauges) {
        section.error("beside", "needs at least two gauges in addition to that of `value`");
    } else if (section.has("distance") && waves.distance.size() != waves.beside.size()) {
        section.error("distance", fmt::format("has {} numbers for {} gauges", waves.distance.size(),
                                              waves.beside.size()));
    }
    section.finish();
    return waves;
}

// Notes an unreadable CSV file before hours of runs begin. A name that contains "${" depends on the
// run and is looked for later.
void check_file(Section& section, const std::string& name)
{
    const bool bad = has_control_characters(name);
    if (name.empty() || bad) {
        section.error("file", name.empty() ? "is empty" : "contains control characters",
                      "a history of the run, or a CSV file beside this one");
    } else if (name.ends_with(".csv") && name.find("${") == std::string::npos) {
        const auto path = section.file().file.parent_path() / name;
        const std::string why = why_unreadable(path);
        if (!why.empty()) {
            section.error("file", fmt::format("the file {} {}", path.string(), why),
                          "the path is relative to this file");
        }
    }
}

} // namespace

Quantity read_quantity(Section& check)
{
    Quantity quantity;
    quantity.series = read_series(check, "value");
    check.require("measure");
    const auto measure = check.choice("measure", measures);
    quantity.measure = measure ? static_cast<Measure>(*measure) : Measure::last;
    if (auto band = check.table("band")) {
        quantity.band = Band{read_series(*band, "lower"), band->expression("upper")};
        band->require("file");
        band->require("upper");
        band->finish();
    }
    if (quantity.band.has_value() != (quantity.measure == Measure::share_within)) {
        check.error("band", "must be given with the measure \"share_within\", and only with it");
    }
    if (auto waves = check.table("waves")) {
        quantity.waves = read_waves(*waves);
    }
    if (quantity.waves.has_value() != (quantity.measure == Measure::reflection)) {
        check.error("waves", "must be given with the measure \"reflection\", and only with it");
    }
    quantity.index = static_cast<int>(check.integer("index", 1));
    quantity.time = check.expression("time");
    quantity.level = check.expression("level");
    quantity.since = check.expression("since");
    if (!quantity.since.empty() &&
        (quantity.band || quantity.waves || is_error_measure(quantity.measure))) {
        check.error("since", "has no meaning for this measure",
                    "it subtracts the same measure of another expression, such as a peak_time");
    }
    quantity.from = check.expression("from");
    quantity.until = check.expression("until");
    if (quantity.index < 1) {
        check.error("index", "must be at least 1");
    }
    if (quantity.measure == Measure::at && quantity.time.empty()) {
        check.error("time", "is missing: the measure \"at\" needs it");
    }
    if (quantity.measure == Measure::crossing && quantity.level.empty()) {
        check.error("level", "is missing: the measure \"crossing\" needs it");
    }
    return quantity;
}

std::string to_string(Against against)
{
    return std::string(against_names[static_cast<std::size_t>(against)]);
}

Series read_series(Section& section, std::string_view key)
{
    Series series;
    section.require(key);
    series.file = section.text("file", series.file);
    if (section.has("file")) {
        check_file(section, series.file);
    }
    series.frame = section.expression("frame");
    if (!series.frame.empty() && series.file != "fluid") {
        section.error("frame", "has a meaning only for `file = \"fluid\"`");
    }
    series.filter = section.expression("filter");
    series.value = section.expression(key);
    for (const TomlEntry* entry : section.entries("where")) {
        const auto text = scalar_text(entry->node);
        if (!text) {
            section.file().error(
                entry->node.place, section.full("where." + entry->key),
                fmt::format("expected a text or a number, found {}", found(entry->node)));
        }
        series.where[entry->key] = text.value_or("");
    }
    return series;
}

int read_expectation(Section& section, Expectation& expected)
{
    expected.formula = section.expression("expected");
    if (auto reference = section.table("reference")) {
        if (section.has("since")) {
            section.error("since", "cannot be combined with `reference`",
                          "give `expected` as a number");
        }
        expected.reference = read_series(*reference, "value");
        reference->require("file");
        reference->finish();
    }
    if (expected.reference && section.has("waves")) {
        section.error("reference", "has no meaning for the measure \"reflection\"");
    }
    return (expected.formula.empty() ? 0 : 1) + (expected.reference ? 1 : 0);
}

std::vector<Check> read_checks(Section& root, const Benchmark& benchmark)
{
    std::vector<Check> checks;
    const std::optional<Against> against = read_against(root, std::nullopt);
    for (Section& section : root.tables("check")) {
        checks.push_back(read_check(section, benchmark, against));
        const auto same = [&](const Check& other) { return other.name == checks.back().name; };
        if (std::find_if(checks.begin(), checks.end() - 1, same) != checks.end() - 1) {
            section.error("name",
                          fmt::format("the check \"{}\" is defined twice", checks.back().name));
        }
    }
    return checks;
}

} // namespace hyoryu
