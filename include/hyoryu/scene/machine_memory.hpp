// SPDX-License-Identifier: MIT
// What this machine can hold: a case that asks for more is refused, before the system would kill
// it.
#pragma once

namespace hyoryu {

/// Memory that this process may use [bytes]: the least of the machine's, the control group's
/// (Linux, version 2) and the user's own limit (`ulimit -v`). Infinity if none is known.
double machine_memory();

} // namespace hyoryu
