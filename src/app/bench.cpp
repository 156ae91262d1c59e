// SPDX-License-Identifier: MIT
// `hyoryu bench`: the limits of the machine and the rates of the solver.
#include "build_info.hpp"
#include "commands.hpp"
#include "options.hpp"

#include "hyoryu/bench/bench.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace hyoryu {

namespace {

bench::Extent extent_of(const BenchOptions& options)
{
    if (options.quick) {
        return bench::quick();
    }
    return options.full ? bench::full() : bench::standard();
}

} // namespace

int run_bench(const BenchOptions& options)
{
    if (!options.json.empty()) {
        expect_own_file(options.json, {.command = "bench --json",
                                       .start = "{\n  \"build\"",
                                       .within = "\"instruction_set\""});
    }
    set_threads(options.threads);
    bench::Setting setting{
        .extent = extent_of(options),
        .threads = thread_count(),
        .state = options.state,
        .tell = [](const std::string& what) { std::fputs((what + " ...\n").c_str(), stderr); }};
    if (!options.sizes.empty()) {
        setting.extent.sizes = options.sizes;
    }
    const std::string build =
        fmt::format("{} ({}), {}, {}, for {} instructions", build_info::version, build_info::commit,
                    build_info::type, build_info::compiler,
                    build_info::native == "ON" ? "this machine's" : "any machine's");
    const bench::Results results = bench::measure(setting);
    if (!options.json.empty()) {
        write_text(options.json, bench::to_json(results, build));
    }
    fmt::print("hyoryu {}\n{} packs, {} threads\n\n{}", build, name(results.set), results.threads,
               bench::table(results));
    return exit_code::done;
}

} // namespace hyoryu
