// SPDX-License-Identifier: MIT
// fork and exec, because posix_spawn cannot tie the life of a child to that of its parent. Between
// the two the child makes only calls that are safe while other threads of the parent hold locks.
#include "hyoryu/core/child_process.hpp"

#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hyoryu {

namespace {

constexpr mode_t everyone_reads = 0666;

bool put_in_place(const char* file, int flags, std::initializer_list<int> streams)
{
    const int opened = ::open(file, flags | O_CLOEXEC, everyone_reads);
    bool done = opened >= 0;
    for (const int stream : streams) {
        done = done && ::dup2(opened, stream) == stream;
    }
    return done;
}

bool prepare_child(const ChildSettings& settings, pid_t parent)
{
    // The parent may have ended before the system was asked to watch it.
    const bool tied = ::prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && ::getppid() == parent;
    const bool dropped = settings.messages.empty();
    const char* const messages = dropped ? "/dev/null" : settings.messages.c_str();
    const int flags = dropped ? O_WRONLY : O_WRONLY | O_CREAT | O_APPEND;
    return tied && put_in_place("/dev/null", O_RDONLY, {STDIN_FILENO}) &&
           put_in_place(messages, flags, {STDOUT_FILENO, STDERR_FILENO}) &&
           (settings.folder.empty() || ::chdir(settings.folder.c_str()) == 0);
}

[[noreturn]] void become(char* const* words, const ChildSettings& settings, pid_t parent,
                         int report)
{
    if (prepare_child(settings, parent)) {
        ::execvp(words[0], words);
    }
    const int reason = errno;
    [[maybe_unused]] const ssize_t told = ::write(report, &reason, sizeof reason);
    constexpr int not_started = 127;
    ::_exit(not_started);
}

// The reason why the child could not start, or 0: its end of the pipe closes when it has.
int reason_of(int pipe)
{
    int reason = 0;
    ssize_t got = 0;
    do {
        got = ::read(pipe, &reason, sizeof reason);
    } while (got < 0 && errno == EINTR);
    return got == sizeof reason ? reason : 0;
}

} // namespace

pid_t start_child(std::vector<std::string> words, const ChildSettings& settings)
{
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0) {
        return -1;
    }
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child == 0) {
        become(arguments.data(), settings, parent, pipe[1]);
    }
    int reason = errno;
    ::close(pipe[1]);
    if (child > 0) {
        reason = reason_of(pipe[0]);
        if (reason != 0) {
            ::waitpid(child, nullptr, 0);
        }
    }
    ::close(pipe[0]);
    errno = reason;
    return child > 0 && reason == 0 ? child : -1;
}

} // namespace hyoryu
