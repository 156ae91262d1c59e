// SPDX-License-Identifier: MIT
// Commands that compute nothing: check, describe, render, version.
#include "build_info.hpp"
#include "case_files.hpp"
#include "commands.hpp"
#include "forecast.hpp"
#include "ground_report.hpp"
#include "options.hpp"
#include "plan_picture.hpp"
#include "plan_report.hpp"

#include "hyoryu/assess/accuracy.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/debris.hpp"
#include "hyoryu/scene/parameter.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace hyoryu {

namespace {

// Steps that `check --time` times.
constexpr int timed_steps = 60;

// Limits of the trial run that follows the developing flow: a share of the run, within bounds [s].
constexpr double part_for_development = 0.1;
constexpr double least_for_development = 2;
constexpr double most_for_development = 60;

void draw_plan(const CheckOptions& options, const Scene& scene, const Filling& filling)
{
    if (scene.dimensions != 3) {
        throw CaseError("--plan shows a scene from above, which needs three dimensions",
                        "leave --plan out");
    }
    expect_own_file(options.plan, {.command = "check --plan",
                                   .start = "\x89PNG",
                                   .within = std::string_view("Software\0hyoryu", 15)});
    write_png(options.plan, plan_picture(scene, filling));
}

} // namespace

std::string version_text()
{
    return fmt::format("hyoryu {} (commit {}, {}, {}, native {}, VTK {}, MPI {}, {} instructions)",
                       build_info::version, build_info::commit, build_info::compiler,
                       build_info::type, build_info::native, build_info::vtk, build_info::mpi,
                       name(widest_instruction_set()));
}

int check_case(const CheckOptions& options)
{
    set_threads(0);
    const Scene scene = read_whole_case(options.case_file, options.overrides);
    const Filling filling = fill(scene);
    const Plan plan = make_plan(scene, filling);
    if (!options.plan.empty()) {
        draw_plan(options, scene, filling);
    }
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
    fmt::print("{}{}", plan_text(scene, plan, timed), ground_text(scene));
    if (options.accuracy) {
        fmt::print("\n{}", expected_errors_text(expected_errors(scene, filling, plan)));
    }
    std::fflush(stdout); // before what goes to the same terminal or file by another way
    for (const Diagnostic& warning : plan.warnings) {
        fmt::print(stderr, "{}\n", to_string(warning));
    }
    return exit_code::done;
}

int describe_keys(const DescribeOptions& options)
{
    const std::string library = options.key == "debris" ? describe_debris_library() : "";
    fmt::print("{}", options.json_schema ? json_schema() : library + describe(options.key));
    return exit_code::done;
}

int render_results(const RenderOptions& options)
{
    expect_results(options.folder);
    const RenderResult result = render(options.folder, options.settings);
    fmt::print("{} pictures in {}\n", result.pictures.size(),
               (options.folder / "pictures").string());
    if (result.removed > 0) {
        fmt::print("they replace {} files of an earlier call\n", result.removed);
    }
    if (result.animation) {
        fmt::print("animation: {}\n", result.animation->string());
    } else if (!result.note.empty()) {
        fmt::print("no animation: {}\n", result.note);
    }
    return exit_code::done;
}

} // namespace hyoryu
