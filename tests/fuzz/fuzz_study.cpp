// SPDX-License-Identifier: MIT
// Any text is a study or a list of mistakes, and so it is as the checks of a benchmark; the runs of
// either can be counted out.
#include "hyoryu/assess/benchmark.hpp"
#include "hyoryu/assess/study.hpp"
#include "hyoryu/core/error.hpp"
#include "scratch.hpp"

namespace {

using namespace hyoryu;

void read_as_study(const std::filesystem::path& file)
{
    try {
        const Study study = read_study(file);
        const auto runs = runs_of(study);
        for (std::size_t sweep = 0; sweep < study.sweeps.size(); ++sweep) {
            series_of(study, runs, sweep);
        }
        for (const StudyRun& run : runs) {
            scope_of(study.definitions, run.run);
        }
    } catch (const CaseError&) {
        return;
    }
}

void read_as_benchmark(const std::filesystem::path& folder)
{
    try {
        const Benchmark benchmark = read_benchmark(folder);
        for (const BenchmarkRun& run : benchmark.runs) {
            scope_of(benchmark.definitions, run);
        }
    } catch (const CaseError&) {
        return;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const test_help::Scratch scratch;
    scratch.put("case.toml", nullptr, 0);
    const auto study = scratch.put("study.toml", data, size);
    read_as_study(study);
    scratch.put("verify.toml", data, size);
    read_as_benchmark(study.parent_path());
    return 0;
}
