// SPDX-License-Identifier: MIT
// Worst and rms errors over runs that share some parameters.
#include "hyoryu/assess/verify_report.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

std::string text_of(const RunParameter& value)
{
    const auto* text = std::get_if<std::string>(&value);
    return text != nullptr ? *text : cell(std::get<double>(value));
}

/// The values of the parameters that name a row of the table; empty if the run lacks one.
std::vector<std::string> key_of(const BenchmarkRun& run, const std::vector<std::string>& by)
{
    std::vector<std::string> key;
    for (const std::string& name : by) {
        for (const auto& [parameter, value] : run.parameters) {
            if (parameter == name) {
                key.push_back(text_of(value));
            }
        }
    }
    return key.size() == by.size() ? key : std::vector<std::string>();
}

struct Group {
    std::vector<std::string> key;
    std::vector<const RunResult*> runs;
};

std::vector<Group> groups_of(const BenchmarkResult& result, const SummaryTable& table)
{
    std::vector<Group> groups;
    for (const RunResult& run : result.runs) {
        const std::vector<std::string> key = key_of(run.run, table.by);
        if (key.empty()) {
            continue;
        }
        auto at = std::find_if(groups.begin(), groups.end(),
                               [&](const Group& group) { return group.key == key; });
        if (at == groups.end()) {
            groups.push_back({key, {}});
            at = groups.end() - 1;
        }
        at->runs.push_back(&run);
    }
    return groups;
}

const CheckResult* find_check(const RunResult& run, const std::string& name)
{
    const auto at = std::find_if(run.checks.begin(), run.checks.end(),
                                 [&](const CheckResult& check) { return check.check == name; });
    return at == run.checks.end() ? nullptr : &*at;
}

/// What was asked of a check and what came out, in the unit shown; a bound asks for zero.
struct Errors {
    std::vector<double> asked, errors;
};

Errors errors_of(const std::vector<const RunResult*>& runs, const SummaryTable::Item& item)
{
    Errors result;
    for (const RunResult* run : runs) {
        if (const CheckResult* check = find_check(*run, item.check)) {
            const double asked = check->comparison == Comparison::equal ? check->expected : 0;
            result.asked.push_back(item.scale * asked);
            result.errors.push_back(item.scale * (check->got - asked));
        }
    }
    return result;
}

/// "worst | rms" of one check over the runs of a row.
std::string cells_of(const Group& group, const SummaryTable::Item& item)
{
    const std::vector<double> errors = errors_of(group.runs, item).errors;
    if (errors.empty()) {
        return " | |";
    }
    const double worst = *std::max_element(errors.begin(), errors.end(), [](double a, double b) {
        return std::isnan(b) || std::abs(a) < std::abs(b);
    });
    double squares = 0;
    for (const double error : errors) {
        squares += error * error;
    }
    const double rms = std::sqrt(squares / static_cast<double>(errors.size()));
    return fmt::format(" {:.2g} | {:.2g} |", worst, rms);
}

/// "us/step | solver seconds a simulated second" of the runs of a row that came to their end.
std::string cost_cells(const Group& group)
{
    RunCost sum;
    for (const RunResult* run : group.runs) {
        sum.solver_seconds += run->cost.solver_seconds;
        sum.steps += run->cost.steps;
        sum.simulated_seconds += run->cost.simulated_seconds;
    }
    if (sum.simulated_seconds <= 0) {
        return " | |";
    }
    return fmt::format(" {:.3g} | {:.3g} |", sum.microseconds_per_step(),
                       sum.solver_seconds / sum.simulated_seconds);
}

/// "restitution, asked 0.75: worst error".
std::string title_of(const std::vector<Group>& groups, const SummaryTable::Item& item)
{
    std::vector<double> asked;
    for (const Group& group : groups) {
        const std::vector<double> of_group = errors_of(group.runs, item).asked;
        asked.insert(asked.end(), of_group.begin(), of_group.end());
    }
    const std::string unit = item.unit.empty() ? "" : fmt::format(" [{}]", item.unit);
    if (asked.empty()) {
        return item.label + unit;
    }
    const auto [low, high] = std::minmax_element(asked.begin(), asked.end());
    return *low == *high
               ? fmt::format("{}{}, asked {:.6g}", item.label, unit, *low)
               : fmt::format("{}{}, asked {:.4g} to {:.4g}", item.label, unit, *low, *high);
}

std::string header_of(const SummaryTable& table, const std::vector<Group>& groups)
{
    std::string names = "|";
    std::string rule = "|";
    for (const std::string& by : table.by) {
        names += fmt::format(" {} |", by);
        rule += "---|";
    }
    names += " runs |";
    rule += "---|";
    for (const SummaryTable::Item& item : table.items) {
        names += fmt::format(" {}: worst error | rms |", title_of(groups, item));
        rule += "---|---|";
    }
    return names + " us/step | solver s per s |\n" + rule + "---|---|\n";
}

std::string table_text(const BenchmarkResult& result, const SummaryTable& table)
{
    const std::vector<Group> groups = groups_of(result, table);
    std::string text = table.preface.empty() ? "" : table.preface + "\n\n";
    text += fmt::format("## {}\n\n{}\n\n", table.title, table.text);
    text += header_of(table, groups);
    for (const Group& group : groups) {
        text += fmt::format("| {} | {} |", fmt::join(group.key, " | "), group.runs.size());
        for (const SummaryTable::Item& item : table.items) {
            text += cells_of(group, item);
        }
        text += cost_cells(group) + "\n";
    }
    return text + "\n";
}

} // namespace

std::map<std::string, std::string> summary_documents(const std::vector<BenchmarkResult>& results,
                                                     const VerifyInfo& info)
{
    std::map<std::string, std::string> documents;
    for (const BenchmarkResult& result : results) {
        for (const SummaryTable& table : result.benchmark.tables) {
            documents[table.file] += table_text(result, table);
        }
    }
    for (auto& [file, text] : documents) {
        text += fmt::format("Made by hyoryu {} (commit {}, {}) with {} threads in {:.3g} s.\n",
                            info.version, info.commit, info.build, info.threads, info.wall_seconds);
    }
    return documents;
}

} // namespace hyoryu
