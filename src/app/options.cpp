// SPDX-License-Identifier: MIT
#include "command_table.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cmath>

namespace hyoryu {

namespace {

// A name that a shell made of a variable that is not set.
const CLI::Validator a_name(
    [](std::string& text) {
        return text.empty() ? std::string("is empty, expected a name") : std::string();
    },
    "");

// CLI takes "nan" and "inf" for numbers, and writes the largest one in 309 digits.
CLI::Validator number_that(bool (*fits)(double), const std::string& expected)
{
    return {[fits, expected](const std::string& text) {
                double value = 0;
                const bool good =
                    CLI::detail::lexical_cast(text, value) && std::isfinite(value) && fits(value);
                return good ? std::string() : fmt::format("\"{}\" is not {}", text, expected);
            },
            ""};
}

const CLI::Validator finite = number_that([](double) { return true; }, "a finite number");

// A name of a file, folder or template; `value`: as help calls it.
CLI::Option* add_name(CLI::App& command, const char* option, auto& member, const char* value,
                      const char* text)
{
    return command.add_option(option, member, text)->type_name(value)->check(a_name);
}

// A whole number from `lowest` to `highest`.
void add_count(CLI::App& command, const char* option, auto& member, const std::string& text,
               int lowest, int highest, const char* value = "N")
{
    command.add_option(option, member, text)->type_name(value)->check(CLI::Range(lowest, highest));
}

void add_results(CLI::App& command, std::filesystem::path& results)
{
    add_name(command, "RESULTS", results, "FOLDER", "results folder")->required();
}

void add_case(CLI::App& command, std::filesystem::path& file, std::vector<std::string>& overrides)
{
    add_name(command, "CASE", file, "FILE.toml", "case file (TOML)")->required();
    command.add_option("--set", overrides, "change a key of the case: key.path=VALUE; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

void add_times(CLI::App& command, std::vector<double>& times)
{
    command.add_option("--times", times, "only the frames nearest to these times [s]")
        ->type_name("T,T...")
        ->delimiter(',')
        ->check(finite);
}

void add_run(CLI::App& app, RunOptions& options)
{
    auto* run = app.add_subcommand("run", "run a case");
    add_name(*run, "-o,--output", options.folder, "FOLDER",
             "results folder (default: name of the case + -results, in the current folder)");
    add_case(*run, options.case_file, options.overrides);
    add_count(*run, "--threads", options.threads,
              "number of threads (default: OMP_NUM_THREADS, else all)", 1, 4096);
    add_count(*run, "--rebalance", options.rebalance,
              "with several processes: number of steps between checks of the load balance; "
              "0: never (default: 50)",
              0, 1000000, "STEPS");
    add_count(*run, "--parts", options.parts,
              "with several processes: maximum number of files for the particles of a frame "
              "or a checkpoint (default: one per process, at most 64)",
              1, 9999);
    run->add_option("--until", options.until, "stop at this time [s] and write a checkpoint")
        ->type_name("SECONDS")
        ->check(number_that([](double x) { return x >= 0; }, "a finite number of at least 0"));
    run->add_flag("--resume", options.resume, "continue from the checkpoint in the results folder");
    run->add_flag("--force", options.force, "replace an existing results folder");
    run->add_flag("--quiet", options.quiet, "no progress output");
}

void add_check(CLI::App& app, CheckOptions& options)
{
    auto* check = app.add_subcommand("check", "report all errors of a case and show its plan");
    add_case(*check, options.case_file, options.overrides);
    auto* json = check->add_flag("--json", options.json, "print the plan as JSON");
    check
        ->add_flag("--accuracy", options.accuracy,
                   "also print the expected error, from the accuracy studies")
        ->excludes(json);
    add_name(*check, "--plan", options.plan, "FILE.png",
             "also draw the scene in plan view, as a picture");
    check->add_flag(
        "--time", options.time,
        "measure some time steps of the case for the forecast, and the cost of each effect");
}

void add_describe(CLI::App& app, DescribeOptions& options)
{
    auto* describe_ = app.add_subcommand("describe", "explain the keys of the case file");
    describe_->add_option("KEY", options.key, "one key or table (default: all)")->type_name("KEY");
    describe_->add_flag("--json-schema", options.json_schema, "print a JSON Schema for editors");
}

void add_render(CLI::App& app, RenderOptions& options)
{
    auto* render_ =
        app.add_subcommand("render", "render pictures and an animation of a run, off-screen");
    add_results(*render_, options.folder);
    add_times(*render_, options.settings.times);
    add_count(*render_, "--width", options.settings.width,
              fmt::format("width of the pictures in pixels (default: {})", options.settings.width),
              64, 7680);
    add_count(
        *render_, "--height", options.settings.height,
        fmt::format("height of the pictures in pixels (default: {})", options.settings.height), 64,
        4320);
    render_
        ->add_option("--azimuth", options.settings.azimuth_deg,
                     "from the scene to the camera, counter-clockwise from +x [deg]")
        ->type_name("DEGREES")
        ->check(finite);
    render_
        ->add_option("--elevation", options.settings.elevation_deg,
                     "height of the camera above the horizon [deg]")
        ->type_name("DEGREES")
        ->check(finite);
    add_count(*render_, "--fps", options.settings.fps,
              fmt::format("frames per second of the animation (default: {})", options.settings.fps),
              1, 120);
}

void add_report(CLI::App& app, ReportOptions& options)
{
    auto* report = app.add_subcommand("report", "write one self-contained HTML page about a run");
    add_results(*report, options.folder);
    add_name(*report, "-o,--output", options.file, "FILE",
             "file of the page (default: RESULTS/report.html)");
    report
        ->add_option("--stiffness", options.stiffness,
                     "contact stiffness k [N/m] of all impacts, for peak forces u sqrt(k m) "
                     "(default: the values of the pairs of materials in the case)")
        ->type_name("N/m")
        ->check(number_that([](double x) { return x > 0; }, "a positive finite number"));
}

void add_verify(CLI::App& app, VerifyOptions& options)
{
    auto* verify_ =
        app.add_subcommand("verify", "run benchmarks and compare them with their references");
    verify_->add_option("NAME", options.names, "benchmarks or groups of benchmarks (default: all)")
        ->type_name("NAME");
    verify_->add_option("--tier", options.tier, "quick (default), nightly or release")
        ->type_name("quick|nightly|release");
    add_name(*verify_, "--cases", options.cases, "FOLDER",
             "folder that contains the folders of the benchmarks");
    add_name(*verify_, "-o,--output", options.folder, "FOLDER",
             "folder for results, tables and figures (default: verify-results)");
    add_name(*verify_, "--json", options.json, "FILE", "write verify.json to this file as well");
    add_count(*verify_, "--threads", options.threads,
              "number of threads of each run (default: OMP_NUM_THREADS, else all, divided by "
              "the number of parallel runs)",
              1, 4096);
    add_count(*verify_, "--jobs", options.jobs,
              "number of parallel runs, limited by the memory; affects wall times (default: 1)", 1,
              4096);
    verify_->add_flag("--list", options.list, "only list the benchmarks");
    verify_->add_flag("--force", options.force, "replace the results of an earlier verify");
}

void add_study(CLI::App& app, StudyOptions& options)
{
    auto* study =
        app.add_subcommand("study", "measure accuracy against cost over values of case keys");
    add_name(*study, "STUDY", options.file, "FILE.toml", "study file (TOML)")->required();
    add_name(*study, "-o,--output", options.folder, "FOLDER",
             "results folder (default: name of the study + -results, in the current folder)");
    add_count(*study, "--threads", options.threads, "number of threads of each run (default: 1)", 1,
              4096);
    add_count(*study, "--jobs", options.jobs,
              "number of parallel runs, limited by the memory; affects wall times (default: 1)", 1,
              4096);
    study->add_flag("--force", options.force, "repeat finished runs");
}

void add_bench(CLI::App& app, BenchOptions& options)
{
    auto* bench = app.add_subcommand(
        "bench", "measure the limits of this machine and the rates of the solver");
    auto* quick = bench->add_flag("--quick", options.quick, "small scenes, as a quick test");
    bench->add_flag("--full", options.full, "up to 10 million fluid particles (ten minutes, 9 GB)")
        ->excludes(quick);
    bench
        ->add_option("--sizes", options.sizes,
                     "numbers of fluid particles for the measurement of cost against size")
        ->type_name("N,N...")
        ->delimiter(',')
        ->check(CLI::Range(1e2, 1e8));
    add_count(*bench, "--threads", options.threads,
              "number of threads (default: OMP_NUM_THREADS, else all)", 1, 4096);
    add_name(*bench, "--json", options.json, "FILE", "write the results to this file as well");
    add_name(*bench, "--state", options.state, "FOLDER",
             "folder in which the developed flow is kept for later calls");
}

void add_info(CLI::App& app, InfoOptions& options)
{
    auto* info = app.add_subcommand("info", "list the contents of a results folder");
    add_results(*info, options.folder);
    info->add_flag("--json", options.json, "print the contents as JSON, for programs");
}

void add_stop(CLI::App& app, StopOptions& options)
{
    auto* stop = app.add_subcommand("stop", "end a run with a checkpoint");
    add_results(*stop, options.folder);
}

void add_new(CLI::App& app, NewOptions& options)
{
    auto* new_ = app.add_subcommand("new", "write a commented case to start from");
    add_name(*new_, "TEMPLATE", options.name, "TEMPLATE", "name of the template, see below")
        ->required();
    add_name(*new_, "FILE", options.file, "FILE",
             "the case file, or the folder for a case.toml (default: TEMPLATE.toml, in the "
             "current folder)");
    new_->footer("Templates:\n"
                 "  tank                   still water: hydrostatic pressure\n"
                 "  dam_break              a column of water collapses and hits a wall\n"
                 "  floating_body          a box comes to rest at its draft\n"
                 "  bore_with_debris       a bore throws timbers and a container at a house\n"
                 "  street_with_buildings  a flood between buildings carries cars along\n"
                 "  contact_alone          bodies without water fall on a ramp\n"
                 "\n"
                 "An existing file is never replaced.");
}

void add_convert(CLI::App& app, ConvertOptions& options)
{
    auto* convert = app.add_subcommand("convert", "write the frames of a run in another format");
    add_results(*convert, options.folder);
    convert->add_option("--to", options.format, "the format, see below")
        ->type_name("vtp|csv|vtkhdf")
        ->required();
    add_name(*convert, "-o,--output", options.output, "FILE",
             "folder of the files, or the file of vtkhdf (default: within RESULTS)");
    convert
        ->add_option("--only", options.only,
                     "only these series: fluid, bodies, walls, surfaces, structures")
        ->type_name("NAME,NAME...")
        ->delimiter(',');
    add_times(*convert, options.times);
    convert->add_flag("--force", options.force, "replace an earlier conversion");
    convert->footer(
        "Formats:\n"
        "  vtp     RESULTS/vtp: one .vtp file per frame (VTK PolyData, inline base64), and a .pvd "
        "file\n"
        "          with the times for each of fluid, bodies, walls, surfaces, structures\n"
        "  csv     RESULTS/csv: one table per frame of fluid, bodies and walls, one row per\n"
        "          particle, and a table of their times\n"
        "  vtkhdf  RESULTS/all.vtkhdf: one temporal VTKHDF 2 file for ParaView 5.12 and later. It\n"
        "          refers to the frames of fluid, bodies and walls, which must not be moved\n"
        "\n"
        "The frames are not changed. Only files of an earlier conversion are replaced.");
}

void add_completions(CLI::App& app, std::string& shell)
{
    auto* completions =
        app.add_subcommand("completions", "print the completion script for a shell");
    completions->add_option("SHELL", shell, "bash, zsh or fish")
        ->type_name("bash|zsh|fish")
        ->required();
    completions->footer("Installation:\n"
                        "  bash  source <(hyoryu completions bash)\n"
                        "  zsh   hyoryu completions zsh > DIR/_hyoryu, DIR being in $fpath\n"
                        "  fish  hyoryu completions fish > ~/.config/fish/completions/hyoryu.fish");
}

void add_man(CLI::App& app, std::string& command)
{
    auto* man = app.add_subcommand("man", "print a manual page, for `man -l -`");
    man->add_option("COMMAND", command, "one command (default: the program)")->type_name("COMMAND");
}

} // namespace

void add_commands(CLI::App& app, CommandOptions& options)
{
    add_run(app, options.run);
    add_check(app, options.check);
    add_describe(app, options.describe);
    add_new(app, options.new_case);
    add_info(app, options.info);
    add_stop(app, options.stop);
    add_render(app, options.render);
    add_report(app, options.report);
    add_convert(app, options.convert);
    add_verify(app, options.verify);
    add_study(app, options.study);
    add_bench(app, options.bench);
    add_completions(app, options.shell);
    add_man(app, options.manual);
}

} // namespace hyoryu
