// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM ask a run to stop after the step it is in.
#pragma once

namespace hyoryu {

/// From now on the first SIGINT, SIGTERM or SIGHUP is taken as a request, and the second one ends
/// the process at once. A pipe that nobody reads any more (SIGPIPE) loses the progress, not the
/// run.
void watch_for_stop();
bool stop_requested();

} // namespace hyoryu
