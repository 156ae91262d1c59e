// SPDX-License-Identifier: MIT
// Runs ffmpeg, if there is one, without a shell: names of folders may hold any letter.
#include "animation.hpp"

#include "hyoryu/core/child_process.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <sys/wait.h>
#include <vector>

namespace hyoryu {

namespace {

/// Starts the program in `folder` without input and output, and waits. Returns its exit code, or -1
/// and the reason in `errno` if it could not be started.
int run_silently(std::vector<std::string> words, const std::filesystem::path& folder)
{
    const pid_t child = start_child(std::move(words), {.folder = folder});
    if (child < 0) {
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
                                   "frame_[0-9][0-9][0-9][0-9][0-9][0-9]*.png",
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
        return reason ? reason.message() : "";
    }
    std::filesystem::remove(unfinished, reason);
    return code < 0 ? fmt::format("ffmpeg cannot be started ({})", std::strerror(errno))
                    : fmt::format("ffmpeg failed with exit code {}", code);
}

} // namespace hyoryu
