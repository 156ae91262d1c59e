// SPDX-License-Identifier: MIT
// The program: options to a command, errors to exit codes.
#include "errors.hpp"
#include "options.hpp"
#include "ranks.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <thread>

#include <malloc.h>

namespace {

// An exception in a thread of a loop cannot be caught outside of it. Of those only the one for
// memory is not a fault of this program; files on disk stay readable.
[[noreturn]] void end_without_memory()
{
    try {
        if (std::current_exception()) {
            std::rethrow_exception(std::current_exception());
        }
    } catch (const std::bad_alloc&) {
        std::fputs(hyoryu::out_of_memory, stderr);
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
    std::signal(SIGXFSZ, SIG_IGN); // a file-size limit then gives an error message
    try {
        const int code = run_command_line(argc, argv);
        if (std::fflush(stdout) != 0) {
            throw IoError(fmt::format("cannot write to the output: {}", std::strerror(errno)));
        }
        return code;
    } catch (...) {
        if (!is_first()) { // the first of several processes says it; then the launcher ends all
            std::this_thread::sleep_for(std::chrono::seconds(2));
            return meaning_of(std::current_exception()).code;
        }
        return tell_error(std::current_exception());
    }
}
