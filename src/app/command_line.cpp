// SPDX-License-Identifier: MIT
// From the arguments of the command line to a command, with errors for wrong arguments.
#include "command_table.hpp"
#include "command_texts.hpp"
#include "options.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/reader_hint.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>

namespace hyoryu {

namespace {

constexpr const char* exit_code_text =
    "Exit status:\n"
    "  0    done\n"
    "  1    a verification failed\n"
    "  2    the input is wrong; nothing was written\n"
    "  3    the simulation became unstable; the last good state is on disk\n"
    "  4    reading or writing failed; all earlier frames are complete\n"
    "  130  interrupted; a checkpoint was written, --resume continues";

// A hint: the nearest known name of an option or command, or all names.
std::string nearest(const std::string& word, const std::vector<std::string>& known)
{
    const std::vector<std::string_view> views(known.begin(), known.end());
    const std::string hint = did_you_mean(word, views);
    return hint.empty() ? "known: " + fmt::format("{}", fmt::join(known, ", ")) : hint;
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

// Throws for an unknown command, with the nearest known one as a hint.
void refuse_unknown_command(const CLI::App& app, int argc, const char* const* argv)
{
    const std::vector<std::string> known = command_names(app);
    const std::string word = argc > 1 ? argv[1] : "";
    if (!word.starts_with('-') && argc > 1 && std::ranges::find(known, word) == known.end()) {
        throw CaseError(fmt::format("unknown command \"{}\"", word), nearest(word, known));
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

int print_completions(const CLI::App& app, const std::string& shell)
{
    const std::vector<std::string> known{"bash", "zsh", "fish"};
    if (std::ranges::find(known, shell) == known.end()) {
        throw CaseError(fmt::format("no completions for the shell \"{}\"", shell),
                        nearest(shell, known));
    }
    fmt::print("{}", shell == "bash"  ? bash_completion(texts_of(app))
                     : shell == "zsh" ? zsh_completion(texts_of(app))
                                      : fish_completion(texts_of(app)));
    return exit_code::done;
}

int print_manual(const CLI::App& app, const std::string& command)
{
    fmt::print("{}", manual_page(texts_of(app), command));
    return exit_code::done;
}

// Runs the command that was parsed.
int run_chosen(const CLI::App& app, const CommandOptions& options)
{
    const std::map<std::string, std::function<int()>> commands{
        {"run", [&] { return run_case(options.run); }},
        {"check", [&] { return check_case(options.check); }},
        {"describe", [&] { return describe_keys(options.describe); }},
        {"new", [&] { return write_new_case(options.new_case); }},
        {"info", [&] { return show_info(options.info); }},
        {"stop", [&] { return stop_run(options.stop); }},
        {"render", [&] { return render_results(options.render); }},
        {"report", [&] { return write_report(options.report); }},
        {"convert", [&] { return convert_results(options.convert); }},
        {"verify", [&] { return verify(options.verify); }},
        {"study", [&] { return run_study(options.study); }},
        {"bench", [&] { return run_bench(options.bench); }},
        {"completions", [&] { return print_completions(app, options.shell); }},
        {"man", [&] { return print_manual(app, options.manual); }},
    };
    return commands.at(app.get_subcommands().front()->get_name())();
}

} // namespace

int run_command_line(int argc, const char* const* argv)
{
    CLI::App app("Hyoryu simulates floods that carry debris: a particle fluid coupled in both "
                 "directions to rigid bodies with impulse contact.",
                 "hyoryu");
    app.set_version_flag("--version", version_text(), "print version, commit and build options");
    app.require_subcommand(1);
    app.footer(exit_code_text);
    CommandOptions options;
    add_commands(app, options);
    refuse_unknown_command(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        // Help and version are not errors; all other exceptions are errors of the input.
        if (error.get_exit_code() == 0) {
            app.exit(error);
            return exit_code::done;
        }
        throw mistake_of(app, error, argc, argv);
    }
    options.run.program = options.new_case.program = argv[0];
    return run_chosen(app, options);
}

} // namespace hyoryu
