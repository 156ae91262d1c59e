// SPDX-License-Identifier: MIT
// The program: options to a command, errors to exit codes.
#include "options.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <new>

int main(int argc, char** argv)
{
    using namespace hyoryu;
    try {
        return run_command_line(argc, argv);
    } catch (const CaseError& error) {
        fmt::print(stderr, "{}\n", error.what());
        return exit_code::input;
    } catch (const NumericalError& error) {
        fmt::print(stderr, "error: the numbers went wrong: {}\n", error.what());
        return exit_code::numbers;
    } catch (const IoError& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return exit_code::io;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "error: out of memory; `hyoryu check` tells what a case needs\n");
        return exit_code::io;
    }
}
