// SPDX-License-Identifier: MIT
// The program: options to a command, errors to exit codes.
#include "options.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/core/name.hpp"
#include "hyoryu/scene/formula.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <system_error>

#include <malloc.h>

namespace {

constexpr const char* out_of_memory =
    "error: out of memory; `hyoryu check` prints the memory that a case needs";

// The exit code must come out even where the message cannot: fmt::print would throw.
int fail(const std::string& message, int code)
{
    std::fputs((hyoryu::printable(message) + "\n").c_str(), stderr);
    return code;
}

// An exception in a thread of a loop cannot be caught outside of it. Of those only the one for
// memory is not a fault of this program; files on disk stay readable.
[[noreturn]] void end_without_memory()
{
    try {
        if (std::current_exception()) {
            std::rethrow_exception(std::current_exception());
        }
    } catch (const std::bad_alloc&) {
        std::fputs(out_of_memory, stderr);
        std::fputs("\n", stderr);
        std::_Exit(hyoryu::exit_code::io);
    } catch (...) {
        std::abort();
    }
    std::abort();
}

// Large columns come and go: each is a mapping of its own, which goes back to the system when it is
// freed. By itself the library stops that after the first large one, and a run keeps a tenth more.
void return_large_memory()
{
    constexpr int large = 512 << 10; // [B]
    mallopt(M_MMAP_THRESHOLD, large);
}

} // namespace

int main(int argc, char** argv)
{
    using namespace hyoryu;
    std::set_terminate(end_without_memory);
    return_large_memory();
    try {
        const int code = run_command_line(argc, argv);
        if (std::fflush(stdout) != 0) {
            return fail(fmt::format("error: cannot write to the output: {}", std::strerror(errno)),
                        exit_code::io);
        }
        return code;
    } catch (const CaseError& error) {
        return fail(error.what(), exit_code::input);
    } catch (const RoomError& error) {
        return fail(fmt::format("error: {}", error.what()), exit_code::numbers);
    } catch (const NumericalError& error) {
        return fail(fmt::format("error: the simulation became unstable: {}", error.what()),
                    exit_code::numbers);
    } catch (const IoError& error) {
        return fail(fmt::format("error: {}", error.what()), exit_code::io);
    } catch (const std::system_error& error) {
        if (error.code() == std::errc::resource_unavailable_try_again) {
            return fail("error: a thread cannot be started: the limit on memory or processes is "
                        "reached",
                        exit_code::io);
        } // else files and streams of the standard library
        return fail(fmt::format("error: {}", error.what()), exit_code::io);
    } catch (const std::bad_alloc&) {
        return fail(out_of_memory, exit_code::io);
    } catch (const FormulaError& error) {
        return fail(fmt::format("error: {}", error.what()), exit_code::input);
    }
}
