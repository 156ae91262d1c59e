// SPDX-License-Identifier: MIT
#include "stop_request.hpp"

#include <csignal>
#include <initializer_list>

namespace hyoryu {

namespace {

// A signal handler can reach nothing else.
volatile std::sig_atomic_t requested = 0;

void request(int)
{
    requested = 1;
}

} // namespace

void watch_for_stop()
{
    struct sigaction action = {};
    action.sa_handler = request;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        sigaction(signal, &action, nullptr);
    }
    std::signal(SIGPIPE, SIG_IGN);
    watch_for_batch_signal();
}

void watch_for_batch_signal()
{
    struct sigaction action = {};
    action.sa_handler = request;
    action.sa_flags = SA_RESTART; // a scheduler may send it more than once
    sigaction(SIGUSR1, &action, nullptr);
}

bool stop_requested()
{
    return requested != 0;
}

} // namespace hyoryu
