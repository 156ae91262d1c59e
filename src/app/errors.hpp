// SPDX-License-Identifier: MIT
// From an exception to a message and the exit code of the program.
#pragma once

#include <exception>
#include <string>

namespace hyoryu {

inline constexpr const char* out_of_memory =
    "error: out of memory; `hyoryu check` prints the memory that a case needs";

/// The message of an exception for a user, and the exit code for it.
struct Meaning {
    std::string message;
    int code = 0;
};
Meaning meaning_of(const std::exception_ptr& error);

/// Prints the message of an exception, behind `who`, and returns its exit code, even if the message
/// cannot be printed.
int tell_error(const std::exception_ptr& error, const std::string& who = "");

} // namespace hyoryu
