// SPDX-License-Identifier: MIT
// `[[check]]`: what is measured, what it must be, and how far it may be off.
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/scene/reader_hint.hpp"
#include "reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace hyoryu {

namespace {

struct MeasureName {
    std::string_view name;
    Measure measure;
};
constexpr std::array measures{
    MeasureName{"at", Measure::at},
    MeasureName{"first", Measure::first},
    MeasureName{"last", Measure::last},
    MeasureName{"min", Measure::min},
    MeasureName{"max", Measure::max},
    MeasureName{"mean", Measure::mean},
    MeasureName{"sum", Measure::sum},
    MeasureName{"count", Measure::count},
    MeasureName{"range", Measure::range},
    MeasureName{"drift", Measure::drift},
    MeasureName{"gain", Measure::gain},
    MeasureName{"growth", Measure::growth},
    MeasureName{"row", Measure::row},
    MeasureName{"peak", Measure::peak},
    MeasureName{"peak_time", Measure::peak_time},
    MeasureName{"trough", Measure::trough},
    MeasureName{"crossing", Measure::crossing},
    MeasureName{"integral", Measure::integral},
    MeasureName{"period", Measure::period},
    MeasureName{"decay", Measure::decay},
    MeasureName{"share_within", Measure::share_within},
    MeasureName{"rms_error", Measure::rms_error},
    MeasureName{"largest_error", Measure::largest_error},
};

constexpr std::array<std::string_view, 5> against_names{"experiment", "analytic", "program",
                                                        "conservation", "itself"};

Measure read_measure(Section& check)
{
    check.require("measure");
    const std::string name = check.text("measure", "last");
    std::vector<std::string_view> names;
    for (const MeasureName& known : measures) {
        if (known.name == name) {
            return known.measure;
        }
        names.push_back(known.name);
    }
    const std::string near = did_you_mean(name, names);
    check.error("measure", fmt::format("unknown \"{}\"", name),
                near.empty() ? "there are: " + quoted_list(names) : near);
    return Measure::last;
}

/// Exactly one of `expected`, `at_most`, `at_least`, `reference` and `same_as`.
void read_expectation(Section& section, Check& check)
{
    int given = 0;
    const auto take = [&](std::string_view key, Comparison comparison) {
        const std::string text = section.expression(key);
        if (!text.empty()) {
            check.expected = text;
            check.comparison = comparison;
            given += 1;
        }
    };
    take("expected", Comparison::equal);
    take("at_most", Comparison::at_most);
    take("at_least", Comparison::at_least);
    if (auto reference = section.table("reference")) {
        check.reference = read_series(*reference, "value");
        reference->require("file");
        reference->finish();
        given += 1;
    }
    check.same_as = section.text("same_as");
    given += check.same_as.empty() ? 0 : 1;
    if (given != 1) {
        section.error("",
                      "give one of `expected`, `at_most`, `at_least`, `reference` and `same_as`");
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
                      "a bound has no tolerance besides itself");
    }
    if (is_error_measure(check.quantity.measure) && section.has("relative")) {
        section.error("relative", "has no meaning for an error",
                      "give `tolerance` in the unit of the value");
    }
    if (check.because.empty()) {
        section.error("because", "is missing: why this tolerance or bound?");
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
        const std::string name = expanded(check.same_as, run, scope_of(benchmark, run));
        const BenchmarkRun* other = find_run(benchmark, name);
        if (other == nullptr) {
            section.error("same_as", fmt::format("no run is named \"{}\"", name));
        } else if (place(*other) > place(run) || other->tier > run.tier) {
            section.error("same_as",
                          fmt::format("\"{}\" is not made before \"{}\"", name, run.name),
                          "put it before, in the same tier or a lower one");
        }
    }
}

/// What the expected number comes from.
std::optional<Against> read_against(Section& section, std::optional<Against> fallback)
{
    const std::string name = section.text("against");
    if (!section.has("against")) {
        return fallback;
    }
    const auto against = against_of(name);
    if (!against) {
        const std::string near = did_you_mean(name, against_names);
        section.error("against", fmt::format("unknown \"{}\"", name),
                      near.empty() ? "there are: " + quoted_list(against_names) : near);
    }
    return against;
}

/// Why it is known to fail, where, and how far it may be off there.
void read_known_failure(Section& section, const std::vector<BenchmarkRun>& runs, Check& check)
{
    check.xfail = section.text("xfail");
    check.xfail_runs = section.has("xfail_runs") ? read_patterns(section, "xfail_runs", runs)
                                                 : std::vector<std::string>{"*"};
    check.xfail_within = section.expression("xfail_within");
    for (const char* key : {"xfail_runs", "xfail_within"}) {
        if (section.has(key) && check.xfail.empty()) {
            section.error(key, "has no meaning without `xfail`");
        }
    }
    if (!check.xfail.empty() && !section.has("xfail_within")) {
        section.error("xfail_within",
                      "is missing: how far may it be off what is expected before it fails?",
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
    check.runs =
        section.has("runs") ? read_patterns(section, "runs", runs) : std::vector<std::string>{"*"};
    check.judged = section.has("judged") ? read_patterns(section, "judged", runs)
                                         : std::vector<std::string>{"*"};
    check.quantity = read_quantity(section);
    read_expectation(section, check);
    read_tolerance(section, check);
    read_known_failure(section, runs, check);
    check.against = read_against(section, check.same_as.empty() ? against : Against::itself);
    try {
        if (!check.same_as.empty()) {
            find_same(section, check, benchmark);
        }
    } catch (const FormulaError& fault) {
        section.error("same_as", fault.what());
    }
    section.finish();
    return check;
}

} // namespace

Quantity read_quantity(Section& check)
{
    Quantity quantity;
    quantity.series = read_series(check, "value");
    quantity.measure = read_measure(check);
    if (auto band = check.table("band")) {
        quantity.band = Band{read_series(*band, "lower"), band->expression("upper")};
        band->require("file");
        band->require("upper");
        band->finish();
    }
    if (quantity.band.has_value() != (quantity.measure == Measure::share_within)) {
        check.error("band", "belongs to the measure \"share_within\", and that measure to it");
    }
    quantity.index = static_cast<int>(check.integer("index", 1));
    quantity.time = check.expression("time");
    quantity.level = check.expression("level");
    quantity.from = check.expression("from");
    quantity.until = check.expression("until");
    if (quantity.index < 1) {
        check.error("index", "counts from 1");
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

std::optional<Against> against_of(const std::string& name)
{
    const auto* at = std::ranges::find(against_names, name);
    return at == against_names.end()
               ? std::nullopt
               : std::optional(static_cast<Against>(at - against_names.begin()));
}

bool is_error_measure(Measure measure)
{
    return measure == Measure::rms_error || measure == Measure::largest_error;
}

namespace {

// A table beside the file is looked for now and not after hours of runs; one whose name depends on
// the run cannot be.
void check_file(Section& section, const std::string& name)
{
    const bool bad = has_control_characters(name);
    if (name.empty() || bad) {
        section.error("file", name.empty() ? "is empty" : "holds control characters",
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
        section.error("frame", "has a meaning for `file = \"fluid\"` only");
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

std::vector<Check> read_checks(Section& root, const Benchmark& benchmark)
{
    std::vector<Check> checks;
    const std::optional<Against> against = read_against(root, std::nullopt);
    for (Section& section : root.tables("check")) {
        checks.push_back(read_check(section, benchmark, against));
        const auto same = [&](const Check& other) { return other.name == checks.back().name; };
        if (std::find_if(checks.begin(), checks.end() - 1, same) != checks.end() - 1) {
            section.error("name", fmt::format("the check \"{}\" stands twice", checks.back().name));
        }
    }
    return checks;
}

} // namespace hyoryu
