// SPDX-License-Identifier: MIT
// Ctrl-C, SIGTERM and SIGUSR1 ask a run to stop after the step it is in.
#pragma once

namespace hyoryu {

/// From now on the first SIGINT, SIGTERM or SIGHUP is taken as a request, and the second one ends
/// the process at once. A pipe without a reader (SIGPIPE) loses the progress output, not the run.
/// SIGUSR1, which schedulers of clusters send before they end a job, is always a request, however
/// often it arrives.
void watch_for_stop();
/// The part of this for SIGUSR1: while a case is read and filled, the other signals end the process
/// at once, for nothing is written yet.
void watch_for_batch_signal();
bool stop_requested();

} // namespace hyoryu
