// SPDX-License-Identifier: MIT
// All checks, one line each.
#include "hyoryu/assess/verify_report.hpp"

#include "hyoryu/report/table.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <utility>

namespace hyoryu {

namespace {

using nlohmann::ordered_json;

// Missing numbers are left blank.
std::string number_text(double number, int digits)
{
    return std::isnan(number) ? "" : fmt::format("{:.{}g}", number, digits);
}

std::string expected_text(const CheckResult& check)
{
    const char* sign = check.comparison == Comparison::at_most    ? "<= "
                       : check.comparison == Comparison::at_least ? ">= "
                                                                  : "";
    return std::isnan(check.expected) ? "" : sign + number_text(check.expected, 8);
}

std::string tolerance_text(const CheckResult& check)
{
    return check.comparison == Comparison::equal ? number_text(check.allowed, 2) : "bound";
}

std::string cost_text(const RunCost& cost)
{
    return fmt::format("{:.3g} s, {} steps, {:.3g} us/step", cost.wall_seconds,
                       static_cast<long long>(cost.steps), cost.microseconds_per_step());
}

// In the order of `Comparison`.
constexpr std::array comparison_names{"equal", "at_most", "at_least"};

ordered_json json_of(const CheckResult& check)
{
    // NaN has no JSON number; the library writes null.
    return {{"check", check.check},
            {"verdict", to_string(check.verdict)},
            {"comparison", comparison_names[static_cast<std::size_t>(check.comparison)]},
            {"expected", check.expected},
            {"got", check.got},
            {"allowed", check.allowed},
            {"known_within", check.known_within},
            {"against", check.against ? ordered_json(to_string(*check.against)) : ordered_json()},
            {"because", check.because},
            {"note", check.note}};
}

ordered_json json_of(const RunResult& run)
{
    ordered_json json{{"name", run.run.name}};
    json["parameters"] = ordered_json::object();
    for (const auto& [name, value] : run.run.parameters) {
        std::visit([&, key = name](const auto& v) { json["parameters"][key] = v; }, value);
    }
    json["error"] = run.error;
    json["wall_seconds"] = run.cost.wall_seconds;
    json["solver_seconds"] = run.cost.solver_seconds;
    json["steps"] = run.cost.steps;
    json["simulated_seconds"] = run.cost.simulated_seconds;
    json["microseconds_per_step"] = run.cost.microseconds_per_step();
    json["checks"] = ordered_json::array();
    for (const CheckResult& check : run.checks) {
        json["checks"].push_back(json_of(check));
    }
    return json;
}

/// Where the section of a benchmark stands in its document, as GitHub names it.
std::string anchor(const Benchmark& benchmark)
{
    std::string name;
    for (const char letter : benchmark.name + "-" + benchmark.title) {
        const auto code = static_cast<unsigned char>(letter);
        if (std::isalnum(code) != 0 || letter == '_' || letter == '-') {
            name += static_cast<char>(std::tolower(code));
        } else if (letter == ' ') {
            name += '-';
        }
    }
    return name;
}

std::string markdown_section(const BenchmarkResult& result)
{
    std::string text = fmt::format("## {}: {}\n\nReference: {}\n\n", result.benchmark.name,
                                   result.benchmark.title, result.benchmark.source);
    if (!result.benchmark.uncertainty.empty()) {
        text += fmt::format("Uncertainty of the reference: {}\n\n", result.benchmark.uncertainty);
    }
    TextTable table{
        {{"run"}, {"check"}, {"expected"}, {"got"}, {"tolerance"}, {"verdict"}, {"why"}, {"cost"}},
        {}};
    for (const RunResult& run : result.runs) {
        std::string name = run.run.name;
        std::string cost = cost_text(run.cost);
        for (const CheckResult& check : run.checks) {
            table.rows.push_back(
                {std::exchange(name, ""), check.check, expected_text(check),
                 number_text(check.got, 8), tolerance_text(check), to_string(check.verdict),
                 check.note.empty() ? check.because : check.note, std::exchange(cost, "")});
        }
        if (run.checks.empty()) {
            table.rows.push_back(
                {name, "", "", "", "", run.error.empty() ? "" : "FAIL", run.error, cost});
        }
    }
    return text + markdown_table(table) + "\n";
}

/// One line a case: its results and its cost.
std::string markdown_overview(const std::vector<BenchmarkResult>& results)
{
    TextTable table{{{"case"},
                     {"group"},
                     {"tier"},
                     {"runs"},
                     {"passed"},
                     {"failed"},
                     {"known to fail"},
                     {"cost"}},
                    {}};
    for (const BenchmarkResult& result : results) {
        const Tally count = tally({result});
        Tier lowest = Tier::release;
        double seconds = 0;
        for (const RunResult& run : result.runs) {
            lowest = std::min(lowest, run.run.tier);
            seconds += run.cost.wall_seconds;
        }
        table.rows.push_back(
            {fmt::format("[{}](#{})", result.benchmark.name, anchor(result.benchmark)),
             result.benchmark.group, to_string(lowest), std::to_string(result.runs.size()),
             std::to_string(count.pass), std::to_string(count.failed()),
             std::to_string(count.xfail), fmt::format("{:.3g} s", seconds)});
    }
    return markdown_table(table) + "\n";
}

} // namespace

TableWidths widths_of(const std::vector<Benchmark>& benchmarks)
{
    TableWidths widths;
    for (const Benchmark& benchmark : benchmarks) {
        widths.benchmark = std::max(widths.benchmark, benchmark.name.size());
        for (const BenchmarkRun& run : benchmark.runs) {
            widths.run = std::max(widths.run, run.name.size());
        }
        for (const Check& check : benchmark.checks) {
            widths.check = std::max(widths.check, check.name.size());
        }
    }
    return widths;
}

std::string terminal_header(const TableWidths& widths)
{
    return fmt::format("{:<{}}  {:<{}}  {:<{}}  {:>15}  {:>15}  {:>9}  {:<8}  {}\n", "case",
                       widths.benchmark, "run", widths.run, "check", widths.check, "expected",
                       "got", "tolerance", "verdict", "cost");
}

std::string terminal_rows(const TableWidths& widths, const std::string& benchmark,
                          const RunResult& run)
{
    std::string text;
    bool first = true;
    for (const CheckResult& check : run.checks) {
        text += fmt::format("{:<{}}  {:<{}}  {:<{}}  {:>15}  {:>15}  {:>9}  {:<8}  {}\n", benchmark,
                            widths.benchmark, run.run.name, widths.run, check.check, widths.check,
                            expected_text(check), number_text(check.got, 8), tolerance_text(check),
                            to_string(check.verdict), first ? cost_text(run.cost) : "");
        if (!check.note.empty()) {
            text += fmt::format("    {}\n", check.note);
        }
        first = false;
    }
    if (run.checks.empty()) {
        text += fmt::format("{:<{}}  {:<{}}  {}\n", benchmark, widths.benchmark, run.run.name,
                            widths.run, run.error.empty() ? cost_text(run.cost) : run.error);
    }
    return text;
}

std::string summary_line(const Tally& tally)
{
    std::string line = fmt::format("{} passed, {} failed", tally.pass, tally.failed());
    if (tally.xpass > 0) {
        line += fmt::format(" ({} of them pass although marked as known to fail)", tally.xpass);
    }
    if (tally.xfail > 0) {
        line += fmt::format(", {} known to fail", tally.xfail);
    }
    if (tally.measured > 0) {
        line += fmt::format(", {} measured only", tally.measured);
    }
    return line;
}

std::string against_line(const Tally& tally)
{
    constexpr std::array<const char*, 5> words{"an experiment", "an analytic solution",
                                               "another program", "a conservation law",
                                               "the program itself"};
    std::string line = "Checks held against";
    const auto add = [&](const char* what, const Held& held) {
        line += fmt::format("{} {}: {} ({} pass)", line.ends_with("against") ? "" : ",", what,
                            held.judged, held.pass);
    };
    for (std::size_t k = 0; k < words.size(); ++k) {
        add(words[k], tally.against[k]);
    }
    if (tally.unstated.judged > 0) {
        add("an unstated reference", tally.unstated);
    }
    return line;
}

std::string threads_of(const VerifyInfo& info)
{
    const std::string threads =
        fmt::format("{} thread{}", info.threads, info.threads == 1 ? "" : "s");
    return info.jobs > 1 ? fmt::format("{} per run, {} parallel runs", threads, info.jobs)
                         : threads;
}

std::string verify_json(const std::vector<BenchmarkResult>& results, const VerifyInfo& info)
{
    const Tally count = tally(results);
    ordered_json json{{"version", info.version},
                      {"commit", info.commit},
                      {"build", info.build},
                      {"tier", to_string(info.tier)},
                      {"wall_seconds", info.wall_seconds},
                      {"threads", info.threads},
                      {"jobs", info.jobs}};
    json["passed"] = count.pass;
    json["failed"] = count.failed();
    json["known_to_fail"] = count.xfail;
    json["measured"] = count.measured;
    for (std::size_t k = 0; k < count.against.size(); ++k) {
        json["against"][to_string(static_cast<Against>(k))] = {{"judged", count.against[k].judged},
                                                               {"passed", count.against[k].pass}};
    }
    json["cases"] = ordered_json::array();
    for (const BenchmarkResult& result : results) {
        ordered_json runs = ordered_json::array();
        for (const RunResult& run : result.runs) {
            runs.push_back(json_of(run));
        }
        json["cases"].push_back({{"name", result.benchmark.name},
                                 {"title", result.benchmark.title},
                                 {"group", result.benchmark.group},
                                 {"source", result.benchmark.source},
                                 {"uncertainty", result.benchmark.uncertainty},
                                 {"runs", std::move(runs)}});
    }
    return json.dump(2) + "\n";
}

std::string verify_markdown(const std::vector<BenchmarkResult>& results, const VerifyInfo& info,
                            const DrawnFigures& figures)
{
    std::string text =
        fmt::format("# Verification\n\nhyoryu {} (commit {}, {}), tier {}, {}, {:.3g} s: "
                    "**{}**. {}.\n\n",
                    info.version, info.commit, info.build, to_string(info.tier), threads_of(info),
                    info.wall_seconds, summary_line(tally(results)), against_line(tally(results)));
    text += markdown_overview(results);
    for (const BenchmarkResult& result : results) {
        text += markdown_section(result);
        const auto drawn = figures.files.find(result.benchmark.name);
        if (drawn != figures.files.end()) {
            for (const SvgFile& file : drawn->second) {
                text += fmt::format("![{0}]({0})\n\n", file.name);
            }
        }
    }
    return text;
}

} // namespace hyoryu
