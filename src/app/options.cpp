// SPDX-License-Identifier: MIT
#include "options.hpp"

#include "commands.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A name that a shell made of a variable that is not set.
const CLI::Validator a_name(
    [](std::string& text) {
        return text.empty() ? std::string("is empty, expected a name") : std::string();
    },
    "");

// CLI takes "nan" and "inf" for numbers.
const CLI::Validator finite(
    [](std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value);
        return number && std::isfinite(value) ? std::string()
                                              : fmt::format("\"{}\" is no finite number", text);
    },
    "");

void add_run(CLI::App& app, RunOptions& options)
{
    auto* run = app.add_subcommand("run", "run a case");
    run->add_option("CASE", options.case_file, "case file (TOML)")->required()->check(a_name);
    run->add_option("-o,--output", options.folder,
                    "results folder (default: the case's name + -results, here)")
        ->check(a_name);
    run->add_option("--set", options.overrides,
                    "change a key of the case: key.path=VALUE; repeatable")
        ->allow_extra_args(false);
    run->add_option("--threads", options.threads,
                    "threads to use (default: OMP_NUM_THREADS, else all)")
        ->check(CLI::Range(1, 4096));
    run->add_option("--until", options.until, "stop at this time [s] and write a checkpoint")
        ->check(finite & CLI::NonNegativeNumber);
    run->add_flag("--resume", options.resume, "go on from the checkpoint in the results folder");
    run->add_flag("--force", options.force, "replace an existing results folder");
    run->add_flag("--quiet", options.quiet, "no progress");
}

void add_check(CLI::App& app, CheckOptions& options)
{
    auto* check = app.add_subcommand("check", "find every mistake of a case and show its plan");
    check->add_option("CASE", options.case_file, "case file (TOML)")->required()->check(a_name);
    check
        ->add_option("--set", options.overrides,
                     "change a key of the case: key.path=VALUE; repeatable")
        ->allow_extra_args(false);
    auto* json = check->add_flag("--json", options.json, "print the plan as JSON");
    check
        ->add_flag("--accuracy", options.accuracy,
                   "also the error to expect, from the standing studies")
        ->excludes(json);
    check->add_flag("--time", options.time,
                    "time some steps of the case for the forecast, and what each effect takes");
}

void add_describe(CLI::App& app, DescribeOptions& options)
{
    auto* describe_ = app.add_subcommand("describe", "explain the keys of the case file");
    describe_->add_option("KEY", options.key, "one key or table (default: all)");
    describe_->add_flag("--json-schema", options.json_schema, "print a JSON Schema for editors");
}

void add_render(CLI::App& app, RenderOptions& options)
{
    auto* render_ = app.add_subcommand("render", "pictures and an animation of a run, off-screen");
    render_->add_option("RESULTS", options.folder, "results folder")->required()->check(a_name);
    render_
        ->add_option("--times", options.settings.times,
                     "only the frames nearest to these times [s]")
        ->delimiter(',')
        ->check(finite);
    render_->add_option("--width", options.settings.width, "pixels")->check(CLI::Range(64, 7680));
    render_->add_option("--height", options.settings.height, "pixels")->check(CLI::Range(64, 4320));
    render_->add_option("--azimuth", options.settings.azimuth_deg, "camera direction [deg]")
        ->check(finite);
    render_->add_option("--elevation", options.settings.elevation_deg, "camera height [deg]")
        ->check(finite);
    render_->add_option("--fps", options.settings.fps, "frames a second of the animation")
        ->check(CLI::Range(1, 120));
}

void add_report(CLI::App& app, ReportOptions& options)
{
    auto* report = app.add_subcommand("report", "one self-contained HTML page about a run");
    report->add_option("RESULTS", options.folder, "results folder")->required()->check(a_name);
    report->add_option("-o,--output", options.file, "the page (default: RESULTS/report.html)")
        ->check(a_name);
    report
        ->add_option("--stiffness", options.stiffness,
                     "contact stiffness k [N/m] of every impact, for peak forces u sqrt(k m) "
                     "(default: as the case declares for pairs of materials)")
        ->check(finite & CLI::PositiveNumber);
}

void add_verify(CLI::App& app, VerifyOptions& options)
{
    auto* verify_ = app.add_subcommand("verify", "run benchmarks against their references");
    verify_->add_option("NAME", options.names, "benchmarks or groups of them (default: all)");
    verify_->add_option("--tier", options.tier, "quick (default), nightly or release");
    verify_->add_option("--cases", options.cases, "folder of the benchmark folders")->check(a_name);
    verify_
        ->add_option("-o,--output", options.folder,
                     "folder for results, tables and figures (default: verify-results)")
        ->check(a_name);
    verify_->add_option("--json", options.json, "write verify.json to this file as well")
        ->check(a_name);
    verify_
        ->add_option("--threads", options.threads,
                     "threads to use (default: OMP_NUM_THREADS, else all)")
        ->check(CLI::Range(1, 4096));
    verify_->add_flag("--list", options.list, "only list the benchmarks");
    verify_->add_flag("--force", options.force, "replace the results of an earlier verify");
}

void add_study(CLI::App& app, StudyOptions& options)
{
    auto* study = app.add_subcommand("study", "accuracy against cost over values of case keys");
    study->add_option("STUDY", options.file, "study file (TOML)")->required()->check(a_name);
    study
        ->add_option("-o,--output", options.folder,
                     "results folder (default: the study's name + -results, here)")
        ->check(a_name);
    study->add_option("--threads", options.threads, "threads of each run (default: 1)")
        ->check(CLI::Range(1, 4096));
    study
        ->add_option("--jobs", options.jobs,
                     "runs side by side, where memory allows; disturbs wall times (default: 1)")
        ->check(CLI::Range(1, 4096));
    study->add_flag("--force", options.force, "run again what an earlier call has done");
}

void add_bench(CLI::App& app, BenchOptions& options)
{
    auto* bench = app.add_subcommand(
        "bench", "measure the limits of this machine and how near the solver comes to them");
    auto* quick = bench->add_flag("--quick", options.quick, "small scenes: that it works");
    bench->add_flag("--full", options.full, "up to 10 million fluid particles (ten minutes, 9 GB)")
        ->excludes(quick);
    bench
        ->add_option("--sizes", options.sizes,
                     "numbers of fluid particles for the cost against size")
        ->delimiter(',')
        ->check(CLI::Range(1e2, 1e8));
    bench
        ->add_option("--threads", options.threads,
                     "threads to use (default: OMP_NUM_THREADS, else all)")
        ->check(CLI::Range(1, 4096));
    bench->add_option("--json", options.json, "write the results to this file as well")
        ->check(a_name);
    bench
        ->add_option("--state", options.state,
                     "keep the developed flow in this folder, and take it from there")
        ->check(a_name);
}

// The names of options, or of commands, that a word may have meant.
std::string nearest(const std::string& word, const std::vector<std::string>& known)
{
    const std::vector<std::string_view> views(known.begin(), known.end());
    const std::string hint = did_you_mean(word, views);
    return hint.empty() ? "there are: " + fmt::format("{}", fmt::join(known, ", ")) : hint;
}

std::vector<std::string> commands_of(const CLI::App& app)
{
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
        names.push_back(command->get_name());
    }
    return names;
}

std::vector<std::string> options_of(const CLI::App& command)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) {
            names.push_back("--" + name);
        }
    }
    return names;
}

// A word that no command knows, and the one that was meant.
void refuse_unknown_command(const CLI::App& app, int argc, const char* const* argv)
{
    const std::vector<std::string> known = commands_of(app);
    const std::string word = argc > 1 ? argv[1] : "";
    if (!word.starts_with('-') && argc > 1 && std::ranges::find(known, word) == known.end()) {
        throw CaseError(fmt::format("there is no command \"{}\"", word), nearest(word, known));
    }
}

CaseError mistake_of(const CLI::App& app, const CLI::ParseError& error, int argc,
                     const char* const* argv)
{
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    const CLI::App& command = chosen.empty() ? app : *chosen.front();
    const std::vector<std::string> known = options_of(command);
    for (int k = 1; k < argc; ++k) {
        std::string word = argv[k];
        word.resize(std::min(word.find('='), word.size()));
        if (word.starts_with("--") && word.size() > 2 &&
            std::ranges::find(known, word) == known.end()) {
            return CaseError(fmt::format("`hyoryu {}` has no option {}", command.get_name(), word),
                             nearest(word, known));
        }
    }
    return CaseError(
        error.what(),
        fmt::format("see `{} --help`", chosen.empty() ? "hyoryu" : "hyoryu " + command.get_name()));
}

} // namespace

int run_command_line(int argc, const char* const* argv)
{
    CLI::App app("Hyoryu: floods that carry debris. A particle fluid coupled both ways to rigid "
                 "bodies that meet walls and each other through impulses.",
                 "hyoryu");
    app.set_version_flag("--version", version_text());
    app.require_subcommand(1);
    RunOptions run;
    CheckOptions check;
    DescribeOptions describe_;
    InfoOptions info;
    RenderOptions render_;
    ReportOptions report;
    VerifyOptions verify_;
    StudyOptions study;
    BenchOptions bench;
    add_run(app, run);
    add_check(app, check);
    add_describe(app, describe_);
    add_render(app, render_);
    add_report(app, report);
    add_verify(app, verify_);
    add_study(app, study);
    add_bench(app, bench);
    app.add_subcommand("info", "what a results folder holds")
        ->add_option("RESULTS", info.folder, "results folder")
        ->required()
        ->check(a_name);

    refuse_unknown_command(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // Help and version are no mistakes; everything else is the user's input.
        if (error.get_exit_code() == 0) {
            app.exit(error);
            return exit_code::done;
        }
        throw mistake_of(app, error, argc, argv);
    }
    if (app.got_subcommand("run")) {
        run.program = argv[0];
        return run_case(run);
    }
    if (app.got_subcommand("check")) {
        return check_case(check);
    }
    if (app.got_subcommand("describe")) {
        return describe_keys(describe_);
    }
    if (app.got_subcommand("info")) {
        return show_info(info);
    }
    if (app.got_subcommand("report")) {
        return write_report(report);
    }
    if (app.got_subcommand("verify")) {
        return verify(verify_);
    }
    if (app.got_subcommand("study")) {
        return run_study(study);
    }
    if (app.got_subcommand("bench")) {
        return run_bench(bench);
    }
    return render_results(render_);
}

} // namespace hyoryu
