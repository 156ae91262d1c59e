// SPDX-License-Identifier: MIT
// The entries of the MPI module, which the program loads when it is one of several processes.
#pragma once

#include "hyoryu/ranks/comm.hpp"

namespace hyoryu::mpi_module {

inline constexpr const char* file_name = "libhyoryu_mpi.so";

/// Begins MPI and returns the connection, which lasts until `end`.
using Begin = Comm* (*)();
inline constexpr const char* begin_name = "hyoryu_module_begin_ranks";
/// Ends MPI; all ranks call it.
using End = void (*)();
inline constexpr const char* end_name = "hyoryu_module_end_ranks";
/// Whether no other process has claimed to report the end; if so, this one has claimed it. Claims
/// at the same moment may both succeed.
using ClaimEnd = bool (*)();
inline constexpr const char* claim_end_name = "hyoryu_module_claim_end_of_ranks";
/// Ends all processes with an exit code.
using Abort = void (*)(int code);
inline constexpr const char* abort_name = "hyoryu_module_abort_ranks";

} // namespace hyoryu::mpi_module
