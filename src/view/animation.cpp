// SPDX-License-Identifier: MIT
// Runs ffmpeg, if there is one, without a shell: names of folders may hold any letter.
#include "animation.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace hyoryu {

namespace {

/// Starts the program in `folder` without input and output, and waits. Returns its exit code, or -1
/// and the reason in `errno` if it could not be started.
int run_silently(std::vector<std::string> words, const std::filesystem::path& folder)
{
    std::vector<char*> arguments;
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int refused =
        posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (refused != 0) {
        errno = refused;
        return -1;
    }
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    constexpr int killed = 128;
    return WIFEXITED(status) ? WEXITSTATUS(status) : killed + WTERMSIG(status);
}

} // namespace

std::string animate(const std::filesystem::path& pictures, int fps)
{
    const std::filesystem::path unfinished = pictures / "animation.mp4.tmp";
    // H.264 in the form that every player shows needs even numbers of rows and columns.
    const int code = run_silently({"ffmpeg",
                                   "-y",
                                   "-loglevel",
                                   "error",
                                   "-framerate",
                                   std::to_string(fps),
                                   "-pattern_type",
                                   "glob",
                                   "-i",
                                   "frame_*.png",
                                   "-vf",
                                   "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                   "-c:v",
                                   "libx264",
                                   "-pix_fmt",
                                   "yuv420p",
                                   "-movflags",
                                   "+faststart",
                                   "-f",
                                   "mp4",
                                   "animation.mp4.tmp"},
                                  pictures);
    std::error_code reason;
    if (code == 0) {
        std::filesystem::rename(unfinished, pictures / "animation.mp4", reason);
        return reason ? "no animation: " + reason.message() : "";
    }
    std::filesystem::remove(unfinished, reason);
    return code < 0
               ? fmt::format("no animation: ffmpeg cannot be started ({})", std::strerror(errno))
               : fmt::format("no animation: ffmpeg failed with exit code {}", code);
}

} // namespace hyoryu
