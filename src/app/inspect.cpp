// SPDX-License-Identifier: MIT
// Commands that compute nothing: check, describe, info, render, version.
#include "build_info.hpp"
#include "commands.hpp"
#include "forecast.hpp"
#include "options.hpp"
#include "plan_report.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/parameter.hpp"
#include "hyoryu/study/accuracy.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Of `check --time`.
constexpr int timed_steps = 60;

// What the look at the flow as it develops may take, of the run, and within what [s].
constexpr double part_for_development = 0.1;
constexpr double least_for_development = 2;
constexpr double most_for_development = 60;

json read_json(const fs::path& file)
{
    if (!fs::exists(file)) {
        return json::object();
    }
    json value = json::parse(bytes_of_file(file), nullptr, false);
    if (!value.is_object()) {
        throw IoError(fmt::format("`{}` is damaged: it is not a JSON object", file.string()));
    }
    return value;
}

std::string series_line(const fs::path& folder, const std::string& name)
{
    const fs::path file = folder / (name + ".hdf.series");
    if (!fs::exists(file)) {
        return fmt::format("{:<12} none\n", name);
    }
    const auto entries = read_series(file);
    if (entries.empty()) {
        return fmt::format("{:<12} no frames\n", name);
    }
    return fmt::format("{:<12} {} frames, t = {} .. {} s ({})\n", name, entries.size(),
                       entries.front().time, entries.back().time, file.filename().string());
}

std::string histories_line(const fs::path& folder)
{
    std::string names;
    for (const char* name : {"bodies.csv", "contacts.csv", "energy.csv", "gauges.csv"}) {
        if (fs::exists(folder / name)) {
            names += (names.empty() ? "" : ", ") + std::string(name);
        }
    }
    return fmt::format("{:<12} {}\n", "histories", names);
}

} // namespace

std::string version_text()
{
    return fmt::format("hyoryu {} (commit {}, {}, {}, native {}, VTK {}, {} instructions)",
                       build_info::version, build_info::commit, build_info::compiler,
                       build_info::type, build_info::native, build_info::vtk,
                       name(widest_instruction_set()));
}

int check_case(const CheckOptions& options)
{
    set_threads(0);
    const Scene scene = read_case(options.case_file, options.overrides);
    const Filling filling = fill(scene);
    const Plan plan = make_plan(scene, filling);
    std::optional<StepCost> timed;
    if (options.time) {
        timed = time_case({options.case_file, options.overrides}, scene, plan, filling,
                          {.steps = timed_steps,
                           .part = part_for_development,
                           .least = least_for_development,
                           .most = most_for_development});
    }
    if (options.json) {
        fmt::print("{}", plan_json(scene, plan, timed));
        return exit_code::done;
    }
    fmt::print("{}", plan_text(scene, plan, timed));
    if (options.accuracy) {
        fmt::print("\n{}", expected_errors_text(expected_errors(scene, filling, plan)));
    }
    for (const Diagnostic& warning : plan.warnings) {
        fmt::print(stderr, "{}\n", to_string(warning));
    }
    return exit_code::done;
}

int describe_keys(const DescribeOptions& options)
{
    fmt::print("{}", options.json_schema ? json_schema() : describe(options.key));
    return exit_code::done;
}

int show_info(const InfoOptions& options)
{
    const fs::path& folder = options.folder;
    if (!fs::exists(folder / "plan.json")) {
        throw CaseError(
            fmt::format("{} is not a results folder: it has no plan.json", folder.string()),
            "give the folder that `hyoryu run` wrote");
    }
    const json plan = read_json(folder / "plan.json");
    const json summary = read_json(folder / "summary.json");
    const json counts = plan.value("counts", json::object());
    fmt::print("{:<12} {}\n", "title", plan.value("title", ""));
    fmt::print("{:<12} {} fluid, {} wall, {} body particles; {} bodies; {}-D\n", "size",
               counts.value("fluid", 0), counts.value("wall", 0), counts.value("body", 0),
               counts.value("bodies", 0), plan.value("dimensions", 3));
    if (summary.empty()) {
        fmt::print("{:<12} running, or ended without a summary\n", "state");
    } else {
        fmt::print("{:<12} {}: {} steps to t = {} s in {} on {} threads\n", "state",
                   summary.value("exit_reason", ""), summary.value("steps", 0),
                   summary.value("simulated_seconds", 0.0),
                   readable_seconds(summary.value("wall_seconds", 0.0)),
                   summary.value("threads", 0));
        fmt::print("{:<12} {} lost, density error at most {:.2g}\n", "particles",
                   summary.value("particles_lost", 0), summary.value("worst_density_error", 0.0));
    }
    fmt::print("{}{}{}{}", series_line(folder, "fluid"), series_line(folder, "bodies"),
               series_line(folder, "surfaces"), histories_line(folder));
    fmt::print("{:<12} {}\n", "checkpoint", fs::exists(folder / "checkpoint.h5") ? "yes" : "none");
    return exit_code::done;
}

int render_results(const RenderOptions& options)
{
    const RenderResult result = render(options.folder, options.settings);
    fmt::print("{} pictures in {}\n", result.pictures.size(),
               (options.folder / "pictures").string());
    if (result.animation) {
        fmt::print("animation: {}\n", result.animation->string());
    } else if (!result.note.empty()) {
        fmt::print("no animation: {}\n", result.note);
    }
    return exit_code::done;
}

} // namespace hyoryu
