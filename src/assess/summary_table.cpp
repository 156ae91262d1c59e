// SPDX-License-Identifier: MIT
// Worst and rms errors over runs that share some parameters.
#include "hyoryu/assess/verify_report.hpp"
#include "hyoryu/report/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

/// The values of the parameters that name a row of the table; empty if the run lacks one.
std::vector<std::string> key_of(const BenchmarkRun& run, const std::vector<std::string>& by)
{
    std::vector<std::string> key;
    for (const std::string& name : by) {
        for (const auto& [parameter, value] : run.parameters) {
            if (parameter == name) {
                key.push_back(cell(value));
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
        auto at = std::ranges::find(groups, key, &Group::key);
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
    const auto at = std::ranges::find(run.checks, name, &CheckResult::check);
    return at == run.checks.end() ? nullptr : &*at;
}

/// The expected and the computed value of a check, in the unit shown; a bound expects zero.
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

/// Worst and rms error of one check over the runs of a row.
void append_errors(const Group& group, const SummaryTable::Item& item,
                   std::vector<std::string>& row)
{
    const std::vector<double> errors = errors_of(group.runs, item).errors;
    if (errors.empty()) {
        row.insert(row.end(), {"", ""});
        return;
    }
    const double worst = *std::max_element(errors.begin(), errors.end(), [](double a, double b) {
        return std::isnan(b) || std::abs(a) < std::abs(b);
    });
    double squares = 0;
    for (const double error : errors) {
        squares += error * error;
    }
    const double rms = std::sqrt(squares / static_cast<double>(errors.size()));
    row.insert(row.end(), {fmt::format("{:.2g}", worst), fmt::format("{:.2g}", rms)});
}

/// Cost of the runs of a row that came to their end.
void append_cost(const Group& group, std::vector<std::string>& row)
{
    RunCost sum;
    for (const RunResult* run : group.runs) {
        sum.solver_seconds += run->cost.solver_seconds;
        sum.steps += run->cost.steps;
        sum.simulated_seconds += run->cost.simulated_seconds;
    }
    const auto text = [&](double number) {
        return sum.simulated_seconds > 0 ? fmt::format("{:.3g}", number) : std::string();
    };
    row.push_back(text(sum.microseconds_per_step()));
    row.push_back(text(sum.solver_seconds / sum.simulated_seconds));
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
               ? fmt::format("{}{}, expected {:.6g}", item.label, unit, *low)
               : fmt::format("{}{}, expected {:.4g} to {:.4g}", item.label, unit, *low, *high);
}

std::vector<TextTable::Head> heads_of(const SummaryTable& table, const std::vector<Group>& groups)
{
    std::vector<TextTable::Head> heads;
    for (const std::string& by : table.by) {
        heads.push_back({by});
    }
    heads.push_back({"runs"});
    for (const SummaryTable::Item& item : table.items) {
        heads.push_back({title_of(groups, item) + ": worst error"});
        heads.push_back({"rms"});
    }
    heads.push_back({"us/step"});
    heads.push_back({"solver s per s"});
    return heads;
}

std::string table_text(const BenchmarkResult& result, const SummaryTable& table)
{
    const std::vector<Group> groups = groups_of(result, table);
    TextTable shown{heads_of(table, groups), {}};
    for (const Group& group : groups) {
        std::vector<std::string> row = group.key;
        row.push_back(std::to_string(group.runs.size()));
        for (const SummaryTable::Item& item : table.items) {
            append_errors(group, item, row);
        }
        append_cost(group, row);
        shown.rows.push_back(std::move(row));
    }
    return fmt::format("{}{}## {}\n\n{}\n\n{}\n", table.preface,
                       table.preface.empty() ? "" : "\n\n", table.title, table.text,
                       markdown_table(shown));
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
        text +=
            fmt::format("Made by hyoryu {} (commit {}, {}) with {} in {:.3g} s.\n", info.version,
                        info.commit, info.build, threads_of(info), info.wall_seconds);
    }
    return documents;
}

} // namespace hyoryu
