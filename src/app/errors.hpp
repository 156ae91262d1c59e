// SPDX-License-Identifier: MIT
// From an exception to a message and the exit code of the program.
#pragma once

#include <exception>
#include <string>

namespace hyoryu {

inline constexpr const char* out_of_memory =
    "error: out of memory; `hyoryu check` prints the memory that a case needs";

/// What an exception says to a user, and the exit code for it.
struct Meaning {
    std::string message;
    int code = 0;
};
Meaning meaning_of(const std::exception_ptr& error);

/// Prints what an exception says, behind `who`, and returns the exit code for it. The code comes
/// out even where the message cannot.
int tell_error(const std::exception_ptr& error, const std::string& who = "");

} // namespace hyoryu
