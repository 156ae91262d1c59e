// SPDX-License-Identifier: MIT
// The command line.
#pragma once

namespace hyoryu {

/// Exit codes of the program.
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int failed = 1;  // a verification failed
inline constexpr int input = 2;   // the user's input is wrong
inline constexpr int numbers = 3; // the simulation became unstable
inline constexpr int io = 4;      // reading or writing failed
inline constexpr int interrupted = 130;
} // namespace exit_code

/// Parses the command line and runs the command; returns the exit code.
int run_command_line(int argc, const char* const* argv);

} // namespace hyoryu
