// SPDX-License-Identifier: MIT
// A run that several processes share, as `mpirun` starts them.
#pragma once

#include "hyoryu/ranks/counted.hpp"
#include "hyoryu/ranks/reduction.hpp"
#include "hyoryu/scene/fill.hpp"

#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hyoryu {

/// The connection of this process with those that share its run, if it is one of several by what
/// its environment says. Throws IoError if the module for that is missing.
class Ranks {
public:
    Ranks();
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    /// Null for a process that is alone.
    CountedComm* comm() { return comm_ ? &*comm_ : nullptr; }
    /// Calls f, which may fail on any process. If it fails on some, the first of them reports the
    /// error, and all processes end.
    void together(const std::function<void()>& f);
    /// Reports an error, once for all processes, and ends them with its exit code.
    [[noreturn]] void end(const std::exception_ptr& error);

private:
    [[noreturn]] void tell(const std::exception_ptr& error);

    std::optional<CountedComm> comm_;
    void* module_ = nullptr;
};

/// Whether this process prints messages for all before the processes are connected: it is alone, or
/// rank 0 according to its environment.
bool is_first();

/// The name of this machine.
std::string host_name();

/// The processes that fill a case together, with the part of them that is on this machine.
Fillers fillers_of(Comm* comm);

/// Whether this process is the one that writes: alone, or rank 0.
bool writes(const Comm* comm);

/// A text that must be the same on all processes that share a run.
struct Common {
    std::string what; // "case", for the message
    std::string text; // that must be the same
};
/// Throws CaseError, on all processes, if one of the texts differs: the processes would wait for
/// each other for ever, or compute a mixture of the cases.
void expect_common(Comm* comm, const std::vector<Common>& things);

/// Makes decisions that depend on a clock or a signal common to all processes: for each wish,
/// returns whether any process has it.
template <std::size_t n>
std::array<bool, n> any_wishes(Comm* comm, std::array<bool, n> wishes)
{
    if (comm == nullptr) {
        return wishes;
    }
    std::array<double, n> numbers{};
    for (std::size_t k = 0; k < n; ++k) {
        numbers[k] = wishes[k] ? 1 : 0;
    }
    largest_of_all(comm, numbers);
    for (std::size_t k = 0; k < n; ++k) {
        wishes[k] = numbers[k] > 0;
    }
    return wishes;
}

} // namespace hyoryu
