// SPDX-License-Identifier: MIT
#include "stop_request.hpp"

#include <csignal>
#include <initializer_list>

namespace hyoryu {

namespace {

// A signal handler may set a variable of this type only.
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

std::filesystem::path stop_file(const std::filesystem::path& folder)
{
    return folder / "stop";
}

void forget_stop_request(const std::filesystem::path& folder)
{
    std::error_code fault;
    std::filesystem::remove(stop_file(folder), fault);
}

bool StopFile::requested()
{
    constexpr auto interval = std::chrono::seconds(1);
    const auto now = std::chrono::steady_clock::now();
    if (!seen_ && now - looked_ >= interval) {
        looked_ = now;
        std::error_code fault;
        seen_ = std::filesystem::remove(file_, fault);
    }
    return seen_;
}

} // namespace hyoryu
