// SPDX-License-Identifier: MIT
// Memory available on this machine: a case that needs more is refused, before the system would kill
// it.
#pragma once

namespace hyoryu {

/// Memory that this process may use [bytes]: the least of the machine's, the control group's
/// (Linux, version 2) and the user's own limit (`ulimit -v`). Infinity if none is known.
double machine_memory();

} // namespace hyoryu
