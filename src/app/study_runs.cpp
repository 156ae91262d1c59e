// SPDX-License-Identifier: MIT
#include "study_runs.hpp"

#include "stop_request.hpp"

#include "hyoryu/core/child_process.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/claim.hpp"
#include "hyoryu/io/results.hpp"
#include "hyoryu/scene/machine_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>

#include <sys/wait.h>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

// The share of the machine's memory that runs side by side may fill by their forecasts.
constexpr double usable_memory = 0.8;

std::string read_all(const fs::path& file)
{
    return why_unreadable(file).empty() ? bytes_of_file(file) : std::string();
}

// Beside the folder of the run, in which a run tolerates no files but its own.
fs::path beside(const StudyJob& job, const char* what)
{
    return fmt::format("{}.{}.txt", job.folder.string(), what);
}

fs::path asked_of(const StudyJob& job)
{
    return beside(job, "asked");
}

fs::path messages_of(const StudyJob& job)
{
    return beside(job, "messages");
}

std::vector<std::string> command_of(const Study& study, const StudyRun& run, const StudyJob& job,
                                    int threads)
{
    std::vector<std::string> command{"/proc/self/exe",
                                     "run",
                                     study.case_file.string(),
                                     "-o",
                                     job.folder.string(),
                                     "--quiet",
                                     "--force",
                                     "--threads",
                                     std::to_string(run.threads > 0 ? run.threads : threads)};
    for (const std::string& set : run.run.set) {
        command.insert(command.end(), {"--set", set});
    }
    return command;
}

// Starts this program with other words; its messages go to a file beside the folder.
pid_t start(std::vector<std::string> command, const fs::path& messages)
{
    const pid_t process = start_child(std::move(command), {.messages = messages});
    if (process < 0) {
        throw IoError(fmt::format("cannot start a run: {}", std::strerror(errno)));
    }
    return process;
}

struct Running {
    std::size_t job = 0;
    pid_t process = 0;
};

// Repeats are there for their times: nothing else of them is kept, except for the plan, by which
// the next call recognises the folder as that of a run.
void keep_summary_only(const fs::path& folder)
{
    remove_results_except(folder, [](const std::string& name) {
        return name == "summary.json" || name == "plan.json";
    });
}

// Why the process ended; empty if the run came to its end.
std::string outcome(const StudyJob& job, int status)
{
    const fs::path messages = messages_of(job);
    std::string text = read_all(messages);
    fs::remove(messages);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        if (job.repeat > 1) {
            keep_summary_only(job.folder);
        }
        write_text(asked_of(job), job.asked);
        return {};
    }
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    const std::string code = WIFEXITED(status) ? fmt::format("exit code {}", WEXITSTATUS(status))
                                               : fmt::format("signal {}", WTERMSIG(status));
    return text.empty() ? code : text;
}

class Pool {
public:
    Pool(const Study& study, const std::vector<StudyRun>& runs, const std::vector<StudyJob>& jobs,
         const StudyJobSettings& settings)
        : study_(study), runs_(runs), jobs_(jobs), settings_(settings)
    {
    }

    std::vector<std::string> run()
    {
        std::vector<std::string> errors(jobs_.size());
        for (std::size_t k = 0; k < jobs_.size() && !stop_requested(); ++k) {
            if (is_done(jobs_[k])) {
                tell(k, "done before");
                continue;
            }
            while (!fits(jobs_[k])) {
                wait_for_one(errors);
            }
            if (stop_requested()) {
                break;
            }
            fs::create_directories(jobs_[k].folder.parent_path());
            fs::remove(asked_of(jobs_[k])); // the results there are about to be replaced
            running_.push_back(
                {k, start(command_of(study_, runs_[jobs_[k].run], jobs_[k], settings_.threads),
                          messages_of(jobs_[k]))});
        }
        while (!running_.empty()) {
            wait_for_one(errors);
        }
        return stop_requested() ? std::vector<std::string>{} : errors;
    }

private:
    bool fits(const StudyJob& job) const
    {
        double memory = job.memory;
        for (const Running& other : running_) {
            memory += jobs_[other.job].memory;
        }
        return running_.empty() || (static_cast<int>(running_.size()) < settings_.side_by_side &&
                                    memory <= usable_memory * machine_memory());
    }

    // A signal that reaches this process alone is handed on, once: a terminal sends Ctrl-C to all,
    // and a run takes the first one of each kind for a request.
    void hand_on_a_request()
    {
        for (const Running& run : running_) {
            if (stop_requested() && !handed_on_) {
                ::kill(run.process, SIGTERM);
            }
        }
        handed_on_ = handed_on_ || stop_requested();
    }

    void wait_for_one(std::vector<std::string>& errors)
    {
        constexpr std::chrono::milliseconds pause(5); // a signal between look and wait is not lost
        int status = 0;
        pid_t ended = 0;
        while ((ended = waitpid(-1, &status, WNOHANG)) == 0) {
            hand_on_a_request();
            std::this_thread::sleep_for(pause);
        }
        const auto at = std::ranges::find(running_, ended, &Running::process);
        if (at == running_.end()) {
            return;
        }
        const std::size_t k = at->job;
        running_.erase(at);
        if (stop_requested()) {
            fs::remove(messages_of(jobs_[k]));
            return;
        }
        errors[k] = outcome(jobs_[k], status);
        tell(k,
             errors[k].empty() ? "done" : "stopped: " + errors[k].substr(0, errors[k].find('\n')));
    }

    void tell(std::size_t k, const std::string& what) const
    {
        const StudyJob& job = jobs_[k];
        fmt::print("{:>4}/{}  {}{}: {}\n", k + 1, jobs_.size(), runs_[job.run].run.name,
                   job.repeat > 1 ? fmt::format(" (repeat {})", job.repeat) : "", what);
        std::fflush(stdout);
    }

    const Study& study_;
    const std::vector<StudyRun>& runs_;
    const std::vector<StudyJob>& jobs_;
    const StudyJobSettings& settings_;
    std::vector<Running> running_;
    bool handed_on_ = false; // the user's request to stop
};

} // namespace

bool is_done(const StudyJob& job)
{
    return fs::exists(job.folder / "summary.json") && read_all(asked_of(job)) == job.asked;
}

void forget(const StudyJob& job)
{
    std::error_code none_there;
    fs::remove(asked_of(job), none_there);
}

std::vector<std::string> run_jobs(const Study& study, const std::vector<StudyRun>& runs,
                                  const std::vector<StudyJob>& jobs,
                                  const StudyJobSettings& settings)
{
    return Pool(study, runs, jobs, settings).run();
}

} // namespace hyoryu
