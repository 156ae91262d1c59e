// SPDX-License-Identifier: MIT
// bench_contact: cost and accuracy of rigid contact, Hyoryu beside the engines that are present.
#include "report.hpp"

#include "hyoryu/core/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

namespace {

using namespace hyoryu::bench;

constexpr const char* usage =
    "usage: bench_contact [--full] [--scenes NAME,...] [--engines NAME,...] [--budget SECONDS]\n"
    "                     [--json FILE] [--list]\n"
    "  --full     stacks watched for longer, and a heap of 1,000 boxes\n"
    "  --budget   CPU time after which a run is stopped (default 60 s)\n"
    "  --list     names the scenes and engines\n";

struct Options {
    Plan plan;
    std::vector<std::string> scenes;
    std::vector<std::string> engines;
    std::string json;
    bool list = false;
};

std::vector<std::string> split(const std::string& text)
{
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == ',') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

std::optional<Options> parse(const std::vector<std::string>& words)
{
    Options options;
    for (std::size_t k = 0; k < words.size(); ++k) {
        const bool more = k + 1 < words.size();
        if (words[k] == "--full") {
            options.plan.extent = Extent::full;
        } else if (words[k] == "--list") {
            options.list = true;
        } else if (words[k] == "--scenes" && more) {
            options.scenes = split(words[++k]);
        } else if (words[k] == "--engines" && more) {
            options.engines = split(words[++k]);
        } else if (words[k] == "--json" && more) {
            options.json = words[++k];
        } else if (words[k] == "--budget" && more) {
            char* end = nullptr;
            options.plan.budget = std::strtod(words[++k].c_str(), &end);
            if (*end != '\0' || !(options.plan.budget > 0)) {
                return std::nullopt;
            }
        } else {
            return std::nullopt;
        }
    }
    return options;
}

// The items whose names were asked for, or all; nothing if a name is unknown.
template <class T>
std::optional<std::vector<T>> choose(const std::vector<T>& all,
                                     const std::vector<std::string>& names)
{
    std::vector<T> chosen;
    for (const std::string& name : names) {
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&name](const T& item) { return item.name == name; });
        if (found == all.end()) {
            fmt::print(stderr, "bench_contact: no '{}'; --list names what there is\n", name);
            return std::nullopt;
        }
        chosen.push_back(*found);
    }
    return names.empty() ? all : chosen;
}

void print_list()
{
    fmt::print("scenes\n");
    for (const Scene& scene : all_scenes(Extent::full)) {
        fmt::print("  {:<14} {}\n", scene.name, scene.what);
    }
    fmt::print("engines\n");
    for (const Engine& engine : engines()) {
        fmt::print("  {:<16} {}\n", engine.name, engine.settings);
    }
}

int measure_all(const Options& options)
{
    auto scenes = choose(all_scenes(options.plan.extent), options.scenes);
    const auto chosen = choose(engines(), options.engines);
    if (!scenes || !chosen) {
        return 2;
    }
    if (options.scenes.empty()) {
        std::erase_if(*scenes,
                      [&options](const Scene& s) { return s.least > options.plan.extent; });
    }
    std::vector<Row> rows;
    for (const Scene& scene : *scenes) {
        rows.push_back({scene, measure(scene, *chosen, options.plan)});
        fmt::print("{}\n", table(rows.back()));
        std::fflush(stdout);
    }
    if (!options.json.empty()) {
        std::ofstream file(options.json);
        file << to_json(rows, *chosen, options.plan).dump(1) << '\n';
        if (!file.flush()) {
            fmt::print(stderr, "bench_contact: cannot write '{}'\n", options.json);
            return 1;
        }
    }
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    const auto options = parse({argv + 1, argv + argc});
    if (!options) {
        fmt::print(stderr, "{}", usage);
        return 2;
    }
    hyoryu::set_threads(1); // as the other engines run
    if (options->list) {
        print_list();
        return 0;
    }
    return measure_all(*options);
}
