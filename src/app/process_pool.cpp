// SPDX-License-Identifier: MIT
#include "process_pool.hpp"

#include "stop_request.hpp"

#include "hyoryu/core/child_process.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/scene/machine_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// The share of the machine's memory that parallel runs may fill by their forecasts.
constexpr double usable_memory = 0.8;

// An empty temporary file for the messages of a process. It is outside the results, in which a file
// of the user could have its name.
fs::path file_for_messages()
{
    std::string name = (fs::temp_directory_path() / "hyoryu-messages-XXXXXX").string();
    const int descriptor = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor < 0) {
        throw IoError(fmt::format("cannot create `{}`: {}", name, std::strerror(errno)));
    }
    ::close(descriptor);
    return name;
}

// Why the process failed; empty if it succeeded. Its messages are removed.
std::string outcome(const fs::path& messages, int status)
{
    std::string text = why_unreadable(messages).empty() ? bytes_of_file(messages) : std::string();
    fs::remove(messages);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        return {};
    }
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    const std::string code = WIFEXITED(status) ? fmt::format("exit code {}", WEXITSTATUS(status))
                                               : fmt::format("signal {}", WTERMSIG(status));
    return text.empty() ? code : text;
}

} // namespace

std::vector<std::string> run_arguments(const RunOptions& run)
{
    std::vector<std::string> words{
        "run",       run.case_file.string(),     "-o", run.folder.string(), "--quiet", "--force",
        "--threads", std::to_string(run.threads)};
    for (const std::string& set : run.overrides) {
        words.insert(words.end(), {"--set", set});
    }
    return words;
}

void ProcessPool::start(const ProcessJob& job)
{
    while (!fits(job)) {
        wait_for_one();
    }
    if (stop_requested()) {
        return;
    }
    const fs::path messages = file_for_messages();
    std::vector<std::string> command{"/proc/self/exe"};
    command.insert(command.end(), job.arguments.begin(), job.arguments.end());
    const pid_t process = start_child(std::move(command), {.messages = messages});
    if (process < 0) {
        throw IoError(fmt::format("cannot start a run: {}", std::strerror(errno)));
    }
    running_.push_back({job.number, process, messages, job.memory});
}

void ProcessPool::wait_for_all()
{
    while (!running_.empty()) {
        wait_for_one();
    }
}

bool ProcessPool::fits(const ProcessJob& job) const
{
    double memory = job.memory;
    for (const Running& other : running_) {
        memory += other.memory;
    }
    return running_.empty() || (static_cast<int>(running_.size()) < side_by_side_ &&
                                memory <= usable_memory * machine_memory());
}

// A signal that reaches this process alone is handed on, once: a terminal sends Ctrl-C to all, and
// a run takes the first one of each kind for a request.
void ProcessPool::hand_on_a_request()
{
    for (const Running& run : running_) {
        if (stop_requested() && !handed_on_) {
            ::kill(run.process, SIGTERM);
        }
    }
    handed_on_ = handed_on_ || stop_requested();
}

void ProcessPool::wait_for_one()
{
    constexpr std::chrono::milliseconds pause(5); // a signal between look and wait is not lost
    int status = 0;
    pid_t process = 0;
    while ((process = waitpid(-1, &status, WNOHANG)) == 0) {
        hand_on_a_request();
        std::this_thread::sleep_for(pause);
    }
    const auto at = std::ranges::find(running_, process, &Running::process);
    if (at == running_.end()) {
        return;
    }
    const Running run = std::move(*at);
    running_.erase(at);
    if (stop_requested()) {
        fs::remove(run.messages);
        return;
    }
    ended_(run.number, outcome(run.messages, status));
}

} // namespace hyoryu
