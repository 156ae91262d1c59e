// SPDX-License-Identifier: MIT
// The table of all commands and options: the source of the parser, of `--help`, of the manual pages
// and of the shell completions.
#pragma once

#include "commands.hpp"

#include <string>

namespace CLI {
class App;
}

namespace hyoryu {

/// The values that the command line fills in, one struct a command.
struct CommandOptions {
    RunOptions run;
    CheckOptions check;
    DescribeOptions describe;
    NewOptions new_case;
    InfoOptions info;
    StopOptions stop;
    RenderOptions render;
    ReportOptions report;
    ConvertOptions convert;
    VerifyOptions verify;
    StudyOptions study;
    BenchOptions bench;
    std::string shell;  // of `completions`
    std::string manual; // of `man`: a command, or empty
};

/// Adds every command with its options and their texts; parsing fills in `options`.
void add_commands(CLI::App& app, CommandOptions& options);

} // namespace hyoryu
