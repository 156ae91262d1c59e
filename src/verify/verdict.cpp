// SPDX-License-Identifier: MIT
#include "hyoryu/verify/verdict.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace hyoryu {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool is_error_measure(Measure measure)
{
    return measure == Measure::rms_error || measure == Measure::largest_error;
}

/// Fills in what was expected and what came out.
void take(const Check& check, const BenchmarkRun& run, const Scope& scope, RunFiles& files,
          CheckResult& result)
{
    Quantity quantity = check.quantity;
    quantity.series = expanded(quantity.series, run, scope);
    const Series reference = expanded(check.reference.value_or(Series{}), run, scope);
    Measured got;
    if (quantity.band) {
        quantity.band->lower = expanded(quantity.band->lower, run, scope);
        got = share_within(quantity, scope, files);
        result.expected = evaluate(check.expected, scope);
    } else if (is_error_measure(quantity.measure)) {
        got = check.reference ? error_from(quantity, reference, scope, files)
                              : error_from(quantity, check.expected, scope, files);
    } else {
        got = measure(quantity, scope, samples(quantity.series, scope, files));
        Measured expected;
        if (check.reference) {
            expected = measure(quantity, scope, samples(reference, scope, files));
        } else {
            expected.value = evaluate(check.expected, scope);
        }
        result.expected = expected.value;
        result.note = expected.why.empty() ? "" : "reference: " + expected.why;
    }
    result.got = got.value;
    if (!got.why.empty()) {
        result.note = got.why;
    }
    result.allowed = check.tolerance.empty() ? check.relative * std::abs(result.expected)
                                             : evaluate(check.tolerance, scope);
}

bool is_good(const CheckResult& result)
{
    // A NaN is never good: each comparison with it is false.
    switch (result.comparison) {
    case Comparison::at_most:
        return result.got <= result.expected;
    case Comparison::at_least:
        return result.got >= result.expected;
    case Comparison::equal:
        break;
    }
    return std::abs(result.got - result.expected) <= result.allowed;
}

Verdict verdict_of(bool good, bool known_to_fail)
{
    if (known_to_fail) {
        return good ? Verdict::xpass : Verdict::xfail;
    }
    return good ? Verdict::pass : Verdict::fail;
}

} // namespace

RunCost read_cost(RunFiles& files)
{
    const CsvTable& summary = files.table("summary");
    const auto number = [&](const char* name) {
        const auto* column = summary.find(name);
        return column != nullptr ? column->numbers.front() : 0;
    };
    double solver_seconds = 0;
    for (const CsvTable::Column& column : summary.columns) {
        solver_seconds += column.name.starts_with("stages.") ? column.numbers.front() : 0;
    }
    return {.wall_seconds = number("wall_seconds"),
            .solver_seconds = solver_seconds,
            .steps = number("steps"),
            .simulated_seconds = number("simulated_seconds")};
}

std::string to_string(Verdict verdict)
{
    switch (verdict) {
    case Verdict::pass:
        return "PASS";
    case Verdict::xfail:
        return "XFAIL";
    case Verdict::xpass:
        return "XPASS";
    case Verdict::measured:
        return "measured";
    case Verdict::fail:
        break;
    }
    return "FAIL";
}

bool counts_as_failure(Verdict verdict)
{
    return verdict == Verdict::fail || verdict == Verdict::xpass;
}

CheckResult judge(const Check& check, const BenchmarkRun& run, const Scope& scope, RunFiles& files)
{
    CheckResult result{
        .check = check.name, .comparison = check.comparison, .got = none, .because = check.because};
    // A check that cannot be made as it is written is no known failure.
    try {
        take(check, run, scope, files, result);
    } catch (const FormulaError& fault) {
        result.note = fault.what();
        return result;
    } catch (const IoError& fault) { // the run did not write the file that the check asks for
        result.note = fault.what();
        return result;
    }
    if (!matches(check.judged, run.name)) {
        result.verdict = Verdict::measured;
        return result;
    }
    const bool known_to_fail = !check.xfail.empty() && matches(check.xfail_runs, run.name);
    result.verdict = verdict_of(is_good(result), known_to_fail);
    if (result.verdict == Verdict::xfail && result.note.empty()) {
        result.note = check.xfail;
    }
    if (result.verdict == Verdict::xpass) {
        result.note = fmt::format("passes now, take away its xfail: {}", check.xfail);
    }
    return result;
}

namespace {

// What is said of a check of a run that did not end as it should.
CheckResult unmade(const Check& check, const std::string& error)
{
    return {.check = check.name,
            .comparison = check.comparison,
            .expected = none,
            .got = none,
            .allowed = none,
            .note = error.empty() ? "the run did not stop" : "the run stopped: " + error,
            .because = check.because};
}

// Whether a run that is to stop did, and said why.
CheckResult stop_as_asked(const BenchmarkRun& run, const std::string& error)
{
    CheckResult result{.check = "stops and says why",
                       .expected = none,
                       .got = none,
                       .allowed = none,
                       .note = error.empty() ? "it came to its end" : error,
                       .because = fmt::format("\"{}\"", run.stops)};
    result.verdict = verdict_of(error.find(run.stops) != std::string::npos, false);
    return result;
}

} // namespace

RunResult judge_run(const Benchmark& benchmark, const BenchmarkRun& run,
                    const std::filesystem::path& results, const std::string& error)
{
    RunResult result{.run = run, .cost = {}, .error = error, .checks = {}};
    const Scope scope = scope_of(benchmark, run);
    RunFiles files(results, benchmark.folder);
    if (!run.stops.empty()) {
        result.checks.push_back(stop_as_asked(run, error));
    }
    const bool good =
        run.stops.empty() ? error.empty() : result.checks.front().verdict == Verdict::pass;
    if (good) {
        result.cost = read_cost(files);
    }
    for (const Check& check : benchmark.checks) {
        if (!matches(check.runs, run.name)) {
            continue;
        }
        if (good) {
            result.checks.push_back(judge(check, run, scope, files));
        } else {
            result.checks.push_back(unmade(check, error));
        }
    }
    return result;
}

Tally tally(const std::vector<BenchmarkResult>& results)
{
    Tally count;
    for (const BenchmarkResult& result : results) {
        for (const RunResult& run : result.runs) {
            // A run without checks still fails if it stopped.
            count.fail += run.checks.empty() && !run.error.empty() ? 1 : 0;
            for (const CheckResult& check : run.checks) {
                count.pass += check.verdict == Verdict::pass ? 1 : 0;
                count.fail += check.verdict == Verdict::fail ? 1 : 0;
                count.xfail += check.verdict == Verdict::xfail ? 1 : 0;
                count.xpass += check.verdict == Verdict::xpass ? 1 : 0;
                count.measured += check.verdict == Verdict::measured ? 1 : 0;
            }
        }
    }
    return count;
}

} // namespace hyoryu
