// SPDX-License-Identifier: MIT
// Classes of errors by cause: mistakes in the input (CaseError), a failed computation
// (NumericalError), a failed file operation (IoError) and programming mistakes (expects). Each maps
// to one exit code of the program.
#pragma once

#include "hyoryu/core/types.hpp"

#include <source_location>
#include <stdexcept>
#include <string>
#include <vector>

namespace hyoryu {

/// One thing that is wrong in, or worth knowing about, a user's file.
struct Diagnostic {
    enum class Severity { error, warning };
    Severity severity = Severity::error;
    std::string file;   // as the user named it; empty for the command line
    int line = 0;       // from 1; 0 when no place can be named
    int column = 0;     // from 1
    int length = 1;     // columns that the caret underlines
    std::string key;    // full path, for instance "fluid.density" or "body[2].size"
    std::string what;   // what is wrong and what was expected
    std::string hint;   // how to mend it; may be empty
    std::string source; // the text of the line, for the caret; may be empty
};

/// `file:line:column: error: key: what`, the source line with a caret, and the hint.
std::string to_string(const Diagnostic& diagnostic);

/// A mistake in the user's input. Holds all mistakes found, sorted by place. Exit code 2.
class CaseError : public std::runtime_error {
public:
    explicit CaseError(std::vector<Diagnostic> diagnostics);
    /// A single mistake without a place in a file.
    explicit CaseError(std::string what, std::string hint = {});
    const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

private:
    std::vector<Diagnostic> diagnostics_;
};

/// The computation failed numerically. Exit code 3; the last good state has been written to disk.
struct NumericalError : std::runtime_error {
    struct Where {
        std::int64_t step = 0;
        double time = 0;   // [s]
        std::string who;   // "fluid particle 4711", "body timber.3"
        std::string field; // "density"
        std::string cause; // the probable cause, in words a user can act on
    };
    explicit NumericalError(const Where& where);
    Where where;

protected:
    NumericalError(const Where& where, const std::string& text);
};

/// More fluid came in than a run may hold. The state on disk and the exit code are as of a
/// NumericalError, but nothing is wrong with the numbers.
struct RoomError : NumericalError {
    RoomError(std::int64_t step, double time, std::int64_t held, std::int64_t most);
};

/// Reading or writing failed. Exit code 4.
struct IoError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

#ifndef NDEBUG
inline constexpr bool debug_build = true;
[[noreturn]] void fail_expectation(const std::source_location& place);
#else
inline constexpr bool debug_build = false;
#endif

/// A precondition that only a programming mistake can break: aborts with the place in debug builds,
/// costs nothing in release builds. Never used for input.
inline void expects([[maybe_unused]] bool condition,
                    [[maybe_unused]] std::source_location place = std::source_location::current())
{
#ifndef NDEBUG
    if (!condition) {
        fail_expectation(place);
    }
#endif
}

} // namespace hyoryu
