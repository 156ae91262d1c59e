// SPDX-License-Identifier: MIT
// `[[run]]`: runs and grids of runs.
#include "hyoryu/core/name.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/reader_hint.hpp"
#include "reader.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyoryu {

namespace {

using Parameters = std::vector<std::pair<std::string, RunParameter>>;

// Of one grid; days, if each takes a minute.
constexpr int most_runs = 1000;

/// One parameter of a grid with its values.
struct Axis {
    std::string name;
    std::vector<RunParameter> values;
};

std::vector<Axis> read_grid(Section& run)
{
    std::vector<Axis> axes;
    for (const TomlEntry* entry : run.entries("grid")) {
        Axis axis{entry->key, {}};
        const TomlArray* items = entry->node.array();
        const TomlArray single{entry->node};
        for (const TomlNode& item : items != nullptr ? *items : single) {
            const std::string key = run.full("grid." + entry->key);
            if (const auto value = read_parameter(run.file(), item, key)) {
                axis.values.push_back(*value);
            }
        }
        axes.push_back(std::move(axis));
    }
    double count = 1;
    for (const Axis& axis : axes) {
        count *= static_cast<double>(axis.values.size());
    }
    if (count > most_runs) {
        run.error("grid",
                  fmt::format("defines {:.0f} runs, at most {} are allowed", count, most_runs));
        return {};
    }
    return axes;
}

/// Every combination of the values; the last axis runs fastest.
std::vector<Parameters> combinations(const std::vector<Axis>& axes)
{
    std::vector<int> counts;
    for (const Axis& axis : axes) {
        counts.push_back(static_cast<int>(axis.values.size()));
    }
    std::vector<Parameters> all;
    for (const std::vector<int>& place : grid_of(counts)) {
        all.emplace_back();
        for (std::size_t k = 0; k < axes.size(); ++k) {
            all.back().emplace_back(axes[k].name,
                                    axes[k].values[static_cast<std::size_t>(place[k])]);
        }
    }
    return all;
}

/// The replacement of `${inner}`: the text of that parameter, or the value of the expression.
std::string substitute(const std::string& inner, const Parameters& parameters, const Scope& scope)
{
    for (const auto& [name, value] : parameters) {
        if (const auto* text = std::get_if<std::string>(&value); text != nullptr && name == inner) {
            return *text;
        }
    }
    return cell(evaluate(inner, scope));
}

std::string expand(const std::string& text, const Parameters& parameters, const Scope& scope)
{
    std::string result;
    std::size_t done = 0;
    for (std::size_t at = text.find("${"); at != std::string::npos; at = text.find("${", done)) {
        const std::size_t end = text.find('}', at);
        if (end == std::string::npos) {
            throw FormulaError(fmt::format("\"{}\": the closing }} of ${{ is missing", text));
        }
        result += text.substr(done, at - done);
        result += substitute(text.substr(at + 2, end - at - 2), parameters, scope);
        done = end + 1;
    }
    return result + text.substr(done);
}

/// Constants and parameters; a parameter replaces the constant of its name, and the constants that
/// are expressions of it follow.
Scope with_parameters(const Constants& constants, const Parameters& parameters)
{
    Scope scope;
    for (const auto& [name, value] : parameters) {
        if (const auto* number = std::get_if<double>(&value)) {
            scope.numbers[name] = *number;
        }
    }
    for (const auto& [name, text] : constants) {
        if (scope.numbers.count(name) == 0) {
            scope.numbers[name] = evaluate(text, scope);
        }
    }
    return scope;
}

// The results of a run lie in a folder of its name.
bool is_folder_name(const std::string& name)
{
    return !name.empty() && label_fault(name).empty() && name != "." && name != ".." &&
           name.find_first_of("/\\") == std::string::npos;
}

void append_run(Section& section, const Constants& constants, Tier tier,
                const std::vector<std::string>& common, std::vector<BenchmarkRun>& runs)
{
    section.require("name");
    const std::string name = section.text("name", "run");
    const std::vector<std::string> set = section.texts("set");
    const Tier own_tier = read_tier(section, tier);
    const std::string stops = section.text("stops");
    const std::size_t mistakes = section.file().mistakes.size();
    const std::vector<Axis> axes = read_grid(section);
    section.finish();
    if (section.file().mistakes.size() > mistakes) {
        return;
    }
    for (const Parameters& parameters : combinations(axes)) {
        BenchmarkRun run{.name = name,
                         .set = common,
                         .tier = own_tier,
                         .parameters = parameters,
                         .stops = stops};
        try {
            const Scope scope = with_parameters(constants, parameters);
            run.name = expand(name, parameters, scope);
            for (const std::string& text : set) {
                run.set.push_back(expand(text, parameters, scope));
            }
        } catch (const FormulaError& fault) {
            section.error("", fault.what());
            return;
        }
        const auto same = [&](const BenchmarkRun& other) { return other.name == run.name; };
        if (std::any_of(runs.begin(), runs.end(), same)) {
            section.error("name", fmt::format("the run \"{}\" is defined twice", run.name),
                          axes.empty() ? "" : "include every parameter of the grid in the name");
            return;
        }
        if (!is_folder_name(run.name)) {
            section.error("name",
                          fmt::format("the run name \"{}\" is not a valid folder name", run.name),
                          "leave `/`, `\\` and control characters out");
            return;
        }
        runs.push_back(std::move(run));
    }
}

bool fits(std::string_view pattern, std::string_view name)
{
    const std::size_t star = pattern.find('*');
    if (star == std::string_view::npos) {
        return pattern == name;
    }
    if (name.substr(0, star) != pattern.substr(0, star)) {
        return false;
    }
    const std::string_view rest = pattern.substr(star + 1);
    for (std::size_t skip = star; skip <= name.size(); ++skip) {
        if (fits(rest, name.substr(skip))) {
            return true;
        }
    }
    return false;
}

} // namespace

std::optional<RunParameter> read_parameter(BenchmarkFile& file, const TomlNode& node,
                                           const std::string& key)
{
    if (auto text = value_in<std::string>(node)) {
        return std::move(*text);
    }
    if (const auto number = value_in<double>(node)) {
        return *number;
    }
    file.error(node.place, key, fmt::format("expected a number or a text, found {}", found(node)));
    return std::nullopt;
}

std::vector<std::vector<int>> grid_of(const std::vector<int>& counts)
{
    std::vector<std::vector<int>> all(1);
    for (const int count : counts) {
        std::vector<std::vector<int>> longer;
        for (const std::vector<int>& begun : all) {
            for (int k = 0; k < count; ++k) {
                longer.push_back(begun);
                longer.back().push_back(k);
            }
        }
        all = std::move(longer);
    }
    return all;
}

std::vector<BenchmarkRun> read_runs(Section& root, const Definitions& definitions, Tier tier)
{
    const std::vector<std::string> common = root.texts("set");
    std::vector<BenchmarkRun> runs;
    for (Section& section : root.tables("run")) {
        append_run(section, definitions.constants, tier, common, runs);
    }
    for (const BenchmarkRun& run : runs) {
        if (run.name.empty() || run.name.front() == '.' ||
            run.name.find_first_of("/\\*,;\"\n") != std::string::npos) {
            root.error("run", fmt::format("\"{}\" is not the name of a run", run.name),
                       "the name is used for a folder: use letters, digits, `_`, `-`, `=` and `.`");
        }
    }
    if (!root.has("run")) {
        runs.push_back({.name = "run", .set = common, .tier = tier, .parameters = {}});
    }
    return runs;
}

std::vector<std::string> read_patterns(Section& section, std::string_view key,
                                       const std::vector<BenchmarkRun>& runs)
{
    std::vector<std::string> patterns = section.texts(key);
    if (!section.has(key)) {
        return {"*"};
    }
    for (const std::string& pattern : patterns) {
        const auto is_fit = [&](const BenchmarkRun& run) { return fits(pattern, run.name); };
        // Without a run, the mistake there has been reported already.
        if (!runs.empty() && std::none_of(runs.begin(), runs.end(), is_fit)) {
            std::vector<std::string_view> names;
            for (const BenchmarkRun& run : runs) {
                names.push_back(run.name);
            }
            const std::string near = did_you_mean(pattern, names);
            section.error(key, fmt::format("no run is named \"{}\"", pattern),
                          near.empty() ? "the first run is " + quoted_list({names.data(), 1})
                                       : near);
        }
    }
    return patterns;
}

bool matches(const std::vector<std::string>& patterns, const std::string& name)
{
    return std::any_of(patterns.begin(), patterns.end(),
                       [&](const std::string& pattern) { return fits(pattern, name); });
}

bool are_draws(const Check& check, const BenchmarkRun& a, const BenchmarkRun& b)
{
    if (!matches(check.runs, a.name) || !matches(check.runs, b.name) ||
        a.parameters.size() != b.parameters.size()) {
        return false;
    }
    bool has = false;
    for (std::size_t k = 0; k < a.parameters.size(); ++k) {
        const bool over = a.parameters[k].first == check.mean_over;
        has = has || over;
        if (a.parameters[k].first != b.parameters[k].first ||
            (!over && a.parameters[k].second != b.parameters[k].second)) {
            return false;
        }
    }
    return has;
}

const BenchmarkRun* find_run(const Benchmark& benchmark, const std::string& name)
{
    const auto at = std::ranges::find(benchmark.runs, name, &BenchmarkRun::name);
    return at == benchmark.runs.end() ? nullptr : &*at;
}

std::string cell(const RunParameter& value)
{
    const auto* number = std::get_if<double>(&value);
    return number != nullptr ? cell(*number) : std::get<std::string>(value);
}

Scope scope_of(const Definitions& definitions, const BenchmarkRun& run)
{
    Scope scope = with_parameters(definitions.constants, run.parameters);
    scope.columns = definitions.columns;
    return scope;
}

std::string expanded(const std::string& text, const BenchmarkRun& run, const Scope& scope)
{
    return expand(text, run.parameters, scope);
}

Series expanded(Series series, const BenchmarkRun& run, const Scope& scope)
{
    series.file = expand(series.file, run.parameters, scope);
    for (auto& [column, wanted] : series.where) {
        wanted = expand(wanted, run.parameters, scope);
    }
    return series;
}

} // namespace hyoryu
