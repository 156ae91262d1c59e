// SPDX-License-Identifier: MIT
#include "hyoryu/assess/verdict.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace hyoryu {

namespace {

/// How far it is off, in the unit of the value; not positive within a bound. NaN if nothing could
/// be measured.
double distance_off(const CheckResult& result)
{
    switch (result.comparison) {
    case Comparison::at_most:
        return result.got - result.expected;
    case Comparison::at_least:
        return result.expected - result.got;
    case Comparison::equal:
        break;
    }
    return std::abs(result.got - result.expected);
}

bool is_good(const CheckResult& result)
{
    // A NaN is never good: each comparison with it is false.
    return distance_off(result) <= (result.comparison == Comparison::equal ? result.allowed : 0.0);
}

/// "off by 0.021 (4.1 %)", by the numbers of this run.
std::string distance_text(const CheckResult& result)
{
    const double off = distance_off(result);
    std::string text = fmt::format("off by {:.3g}", off);
    if (result.expected != 0) {
        text += fmt::format(" ({:.2g} %)", 100 * off / std::abs(result.expected));
    }
    return text;
}

/// The verdict of a check that is known to fail, and the note that says by how much it does.
void judge_known_failure(const Check& check, const Scope& scope, CheckResult& result)
{
    result.known_within = evaluate(check.xfail_within, scope);
    if (is_good(result)) {
        result.verdict = Verdict::xpass;
        result.note = fmt::format("passes now, remove its xfail: {}", check.xfail);
        return;
    }
    const bool within = distance_off(result) <= result.known_within;
    result.verdict = within ? Verdict::xfail : Verdict::fail;
    if (result.note.empty()) {
        result.note = fmt::format("{}, {} {:.3g}: {}", distance_text(result),
                                  within ? "known up to" : "MORE THAN THE KNOWN ERROR",
                                  result.known_within, check.xfail);
    }
}

/// A measured value with its verdict in that run.
CheckResult verdict_on(const Check& check, const MadeRun& made, const MadeRun* other,
                       CheckResult result)
{
    const bool is_other = other != nullptr && other->run.name == made.run.name;
    if (is_other || !matches(check.judged, made.run.name)) {
        result.verdict = Verdict::measured;
        return result;
    }
    if (!check.xfail.empty() && matches(check.xfail_runs, made.run.name)) {
        judge_known_failure(check, made.scope, result);
    } else {
        result.verdict = is_good(result) ? Verdict::pass : Verdict::fail;
    }
    return result;
}

/// The mean of a quantity over the draws before a run and that run, with their standard deviation
/// in words; the expected value is that of the run.
Compared compare_mean(const Check& check, MadeRun& made, std::vector<MadeRun>& before,
                      std::string& because)
{
    Compared found = compare(check.quantity, check.expected, made, nullptr);
    std::vector<double> values{found.got};
    for (MadeRun& draw : before) {
        const Compared one = compare(check.quantity, check.expected, draw, nullptr);
        values.push_back(one.got);
        found.why =
            found.why.empty() && !one.why.empty() ? draw.run.name + ": " + one.why : found.why;
    }
    const auto n = static_cast<double>(values.size());
    found.got = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (const double value : values) {
        squares += (value - found.got) * (value - found.got);
    }
    because += fmt::format("; the mean of {} runs, standard deviation {:.2g}", values.size(),
                           std::sqrt(squares / (n - 1)));
    return found;
}

// The text for a check of a run that failed.
CheckResult unmade(const Check& check, const std::string& error)
{
    return {.check = check.name,
            .comparison = check.comparison,
            .note = error.empty() ? "the run did not stop" : "the run stopped: " + error,
            .because = check.because,
            .against = check.against};
}

// The run that the check names, opened once; null where it names none.
MadeRun* other_of(const Check& check, const Benchmark& benchmark, const MadeRun& made,
                  const std::filesystem::path& runs, std::map<std::string, MadeRun>& opened)
{
    if (check.same_as.empty()) {
        return nullptr;
    }
    const std::string name = expanded(check.same_as, made.run, made.scope);
    const BenchmarkRun* run = find_run(benchmark, name);
    if (run == nullptr) {
        throw FormulaError(fmt::format("no run is named \"{}\"", name));
    }
    MadeRun other{*run, scope_of(benchmark.definitions, *run), {runs / name, benchmark.folder}};
    return &opened.try_emplace(name, std::move(other)).first->second;
}

// The draws of the check beside a run: made before it, with the same other parameters.
std::vector<MadeRun> draws_before(const Check& check, const Benchmark& benchmark,
                                  const BenchmarkRun& run, const std::filesystem::path& runs)
{
    std::vector<MadeRun> draws;
    for (const BenchmarkRun& other : benchmark.runs) {
        if (other.name == run.name) {
            break;
        }
        if (are_draws(check, other, run)) {
            draws.push_back({other,
                             scope_of(benchmark.definitions, other),
                             {runs / other.name, benchmark.folder}});
        }
    }
    return draws;
}

bool has_draws_after(const Check& check, const Benchmark& benchmark, const BenchmarkRun& run)
{
    const auto* at = find_run(benchmark, run.name);
    return at != nullptr &&
           std::any_of(at + 1, benchmark.runs.data() + benchmark.runs.size(),
                       [&](const BenchmarkRun& other) { return are_draws(check, other, run); });
}

// One check of a run that came to its end. Where draws follow, its value is only measured.
CheckResult judge_in(const Benchmark& benchmark, const Check& check, MadeRun& made,
                     const std::filesystem::path& runs, std::map<std::string, MadeRun>& others)
{
    if (check.mean_over.empty()) {
        return judge(check, made, other_of(check, benchmark, made, runs, others));
    }
    if (has_draws_after(check, benchmark, made.run)) {
        Check measured = check;
        measured.judged.clear();
        return judge(measured, made);
    }
    std::vector<MadeRun> draws = draws_before(check, benchmark, made.run, runs);
    return judge(check, made, nullptr, draws.empty() ? nullptr : &draws);
}

// Whether a run that is to stop did, and said why.
CheckResult stop_as_asked(const BenchmarkRun& run, const std::string& error)
{
    CheckResult result{.check = "stops and says why",
                       .note = error.empty() ? "the run reached its end" : error,
                       .because = fmt::format("\"{}\"", run.stops)};
    result.against = Against::itself;
    result.verdict = error.find(run.stops) != std::string::npos ? Verdict::pass : Verdict::fail;
    return result;
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
    constexpr std::array names{"PASS", "FAIL", "XFAIL", "XPASS", "measured"};
    return names[static_cast<std::size_t>(verdict)];
}

CheckResult judge(const Check& check, MadeRun& made, MadeRun* other, std::vector<MadeRun>* draws)
{
    CheckResult result{.check = check.name,
                       .comparison = check.comparison,
                       .because = check.because,
                       .against = check.against};
    // A check that cannot be evaluated as written does not count as a known failure.
    try {
        const Compared found = draws != nullptr
                                   ? compare_mean(check, made, *draws, result.because)
                                   : compare(check.quantity, check.expected, made, other);
        result.got = found.got;
        result.expected = found.expected;
        result.note = found.why;
        result.allowed = check.tolerance.empty() ? check.relative * std::abs(result.expected)
                                                 : evaluate(check.tolerance, made.scope);
        return verdict_on(check, made, other, result);
    } catch (const FormulaError& fault) {
        result.note = fault.what();
    } catch (const IoError& fault) { // the run did not write the file that the check asks for
        result.note = fault.what();
    }
    return result;
}

RunResult judge_run(const Benchmark& benchmark, const BenchmarkRun& run,
                    const std::filesystem::path& results, const std::string& error)
{
    RunResult result{.run = run, .cost = {}, .error = error, .checks = {}};
    MadeRun made{run, scope_of(benchmark.definitions, run), {results, benchmark.folder}};
    if (!run.stops.empty()) {
        result.checks.push_back(stop_as_asked(run, error));
    }
    const bool good =
        run.stops.empty() ? error.empty() : result.checks.front().verdict == Verdict::pass;
    if (good) {
        result.cost = read_cost(made.files);
    }
    std::map<std::string, MadeRun> others;
    for (const Check& check : benchmark.checks) {
        if (!matches(check.runs, run.name)) {
            continue;
        }
        if (good) {
            result.checks.push_back(
                judge_in(benchmark, check, made, results.parent_path(), others));
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
                if (check.verdict != Verdict::measured) {
                    Held& held = check.against
                                     ? count.against[static_cast<std::size_t>(*check.against)]
                                     : count.unstated;
                    held.judged += 1;
                    held.pass += check.verdict == Verdict::pass ? 1 : 0;
                }
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
