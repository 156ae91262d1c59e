// SPDX-License-Identifier: MIT
// Worst and rms errors over runs that share some parameters.
#include "hyoryu/io/results.hpp"
#include "hyoryu/verify/report.hpp"

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

/// "asked | worst | rms" of one check over the runs of a row. For a bound the excess counts.
std::string cells_of(const Group& group, const SummaryTable::Item& item)
{
    std::vector<double> asked;
    std::vector<double> errors;
    for (const RunResult* run : group.runs) {
        if (const CheckResult* check = find_check(*run, item.check)) {
            const bool bound = check->comparison != Comparison::equal;
            asked.push_back(bound ? 0 : check->expected);
            errors.push_back(item.scale * (check->got - asked.back()));
        }
    }
    if (errors.empty()) {
        return " | | |";
    }
    const auto [low, high] = std::minmax_element(asked.begin(), asked.end());
    const double worst = *std::max_element(errors.begin(), errors.end(), [](double a, double b) {
        return std::isnan(b) || std::abs(a) < std::abs(b);
    });
    double squares = 0;
    for (const double error : errors) {
        squares += error * error;
    }
    const double rms = std::sqrt(squares / static_cast<double>(errors.size()));
    const std::string asked_text =
        *low == *high ? fmt::format("{:.4g}", item.scale * *low)
                      : fmt::format("{:.3g} to {:.3g}", item.scale * *low, item.scale * *high);
    return fmt::format(" {} | {:.2g} | {:.2g} |", asked_text, worst, rms);
}

/// "us/step | wall s a simulated s" of the runs of a row that came to their end.
std::string cost_cells(const Group& group)
{
    RunCost sum;
    for (const RunResult* run : group.runs) {
        sum.wall_seconds += run->cost.wall_seconds;
        sum.steps += run->cost.steps;
        sum.simulated_seconds += run->cost.simulated_seconds;
    }
    if (sum.simulated_seconds <= 0) {
        return " | |";
    }
    return fmt::format(" {:.3g} | {:.3g} |", sum.microseconds_per_step(),
                       sum.wall_seconds / sum.simulated_seconds);
}

std::string header_of(const SummaryTable& table)
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
        const std::string unit = item.unit.empty() ? "" : fmt::format(" [{}]", item.unit);
        names += fmt::format(" {}{}: asked | worst error | rms |", item.label, unit);
        rule += "---|---|---|";
    }
    return names + " us/step | wall s per s |\n" + rule + "---|---|\n";
}

std::string table_text(const BenchmarkResult& result, const SummaryTable& table)
{
    std::string text = fmt::format("## {}\n\n{}\n\n", table.title, table.text);
    text += header_of(table);
    for (const Group& group : groups_of(result, table)) {
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
