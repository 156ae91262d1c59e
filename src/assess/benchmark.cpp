// SPDX-License-Identifier: MIT
// Finding, reading and selecting benchmarks.
#include "hyoryu/assess/benchmark.hpp"

#include "hyoryu/core/input_file.hpp"
#include "hyoryu/scene/reader_hint.hpp"
#include "reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "verify.toml";

Benchmark read_root(Section& root)
{
    Benchmark benchmark;
    for (const char* key : {"title", "group", "source"}) {
        root.require(key);
    }
    benchmark.title = root.label("title");
    benchmark.group = root.label("group");
    benchmark.also = root.texts("also");
    benchmark.source = root.text("source");
    benchmark.uncertainty = root.text("uncertainty");
    const Tier tier = read_tier(root, Tier::quick);
    benchmark.definitions = read_definitions(root);
    benchmark.runs = read_runs(root, benchmark.definitions, tier);
    benchmark.checks = read_checks(root, benchmark);
    benchmark.figures = read_figures(root, benchmark.runs);
    benchmark.tables = read_summary_tables(root, benchmark);
    root.finish();
    return benchmark;
}

/// Why a name selects nothing.
[[noreturn]] void refuse_name(const std::string& name, const std::vector<Benchmark>& benchmarks)
{
    std::set<std::string> known;
    for (const Benchmark& benchmark : benchmarks) {
        known.insert({benchmark.name, benchmark.group});
        known.insert(benchmark.also.begin(), benchmark.also.end());
    }
    const std::vector<std::string_view> names(known.begin(), known.end());
    const std::string near = did_you_mean(name, names);
    throw CaseError(fmt::format("no benchmark and no group is named \"{}\"", name),
                    near.empty() ? "known: " + quoted_list(names) : near);
}

bool is_named(const Benchmark& benchmark, const std::string& name)
{
    return benchmark.name == name || benchmark.group == name ||
           std::ranges::find(benchmark.also, name) != benchmark.also.end();
}

void keep_runs_of(Tier tier, Benchmark& benchmark)
{
    std::erase_if(benchmark.runs, [tier](const BenchmarkRun& run) { return run.tier > tier; });
}

} // namespace

OpenedFile open_toml(const fs::path& file)
{
    OpenedFile opened{{.file = file, .lines = {}, .mistakes = {}}, {}};
    const std::string why = why_unreadable(file, largest_text);
    if (!why.empty()) {
        opened.file.error({}, "", "the file " + why, "expected the path of a .toml file");
        opened.file.expect_no_mistakes();
    }
    const std::string whole = bytes_of_file(file);
    opened.file.lines = lines_to_show(whole);
    try {
        opened.document = parse_toml(whole);
    } catch (const TomlFault& fault) {
        opened.file.error(fault.place, "", fault.what, fault.hint);
        opened.file.expect_no_mistakes();
    }
    return opened;
}

Definitions read_definitions(Section& root)
{
    Definitions definitions;
    Scope scope;
    for (const TomlEntry* entry : root.entries("constants")) {
        const std::string key = "constants." + entry->key;
        const std::string text = checked_expression(root.file(), entry->node, key);
        try {
            scope.numbers[entry->key] = evaluate(text, scope);
        } catch (const FormulaError& fault) {
            root.file().error(entry->node.place, key, fault.what());
        }
        definitions.constants.emplace_back(entry->key, text);
    }
    for (const TomlEntry* entry : root.entries("columns")) {
        definitions.columns[entry->key] =
            checked_expression(root.file(), entry->node, "columns." + entry->key);
    }
    return definitions;
}

std::string to_string(Tier tier)
{
    return std::string(tier_names[static_cast<std::size_t>(tier)]);
}

std::optional<Tier> tier_of(const std::string& name)
{
    const auto* at = std::ranges::find(tier_names, name);
    return at == tier_names.end() ? std::nullopt
                                  : std::optional(static_cast<Tier>(at - tier_names.begin()));
}

Tier read_tier(Section& section, Tier fallback)
{
    const auto tier = section.choice("tier", tier_names);
    return tier ? static_cast<Tier>(*tier) : fallback;
}

Benchmark read_benchmark(const fs::path& folder)
{
    OpenedFile opened = open_toml(folder / file_name);
    BenchmarkFile& file = opened.file;
    Section root(file, opened.document, "");
    Benchmark benchmark = read_root(root);
    if (benchmark.runs.empty() && file.mistakes.empty()) {
        root.error("run", "defines no run", "omit it to run the case unchanged");
    }
    file.expect_no_mistakes();
    benchmark.folder = folder;
    benchmark.name = fs::absolute(folder).lexically_normal().filename().string();
    return benchmark;
}

std::set<fs::path> benchmark_folders(const fs::path& cases)
{
    std::set<fs::path> folders;
    std::error_code fault;
    for (const auto& entry : fs::directory_iterator(cases, fault)) {
        if (fs::exists(entry.path() / file_name)) {
            folders.insert(entry.path());
        }
    }
    return folders;
}

std::vector<Benchmark> read_benchmarks(const fs::path& cases)
{
    std::vector<Benchmark> benchmarks;
    std::vector<Diagnostic> mistakes;
    for (const fs::path& folder : benchmark_folders(cases)) {
        try {
            benchmarks.push_back(read_benchmark(folder));
        } catch (const CaseError& error) { // mistakes of all files are reported together
            mistakes.insert(mistakes.end(), error.diagnostics().begin(), error.diagnostics().end());
        }
    }
    if (!mistakes.empty()) {
        throw CaseError(mistakes);
    }
    return benchmarks;
}

std::vector<Benchmark> select(std::vector<Benchmark> benchmarks,
                              const std::vector<std::string>& names, Tier tier)
{
    for (const std::string& name : names) {
        Tier lowest = Tier::release;
        bool found = false;
        for (const Benchmark& benchmark : benchmarks) {
            for (const BenchmarkRun& run : benchmark.runs) {
                if (is_named(benchmark, name)) {
                    lowest = std::min(lowest, run.tier);
                    found = true;
                }
            }
        }
        if (!found) {
            refuse_name(name, benchmarks);
        }
        if (lowest > tier) {
            throw CaseError(
                fmt::format("\"{}\" has no run in the tier \"{}\"", name, to_string(tier)),
                fmt::format("add --tier {}", to_string(lowest)));
        }
    }
    std::erase_if(benchmarks, [&](Benchmark& benchmark) {
        keep_runs_of(tier, benchmark);
        const auto fits = [&](const std::string& name) { return is_named(benchmark, name); };
        return benchmark.runs.empty() ||
               (!names.empty() && std::none_of(names.begin(), names.end(), fits));
    });
    return benchmarks;
}

} // namespace hyoryu
