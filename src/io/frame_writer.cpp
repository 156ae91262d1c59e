// SPDX-License-Identifier: MIT
// The writer thread: takes frames from a short queue, writes them, then names them in their series.
#include "atomic_file.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/timer.hpp"
#include "hyoryu/io/results.hpp"
#include "series.hpp"
#include "vtkhdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <regex>
#include <set>
#include <thread>
#include <utility>

namespace hyoryu {

struct FrameJob {
    FrameContent content;
    FramePlace place = FramePlace::series;
    int part = -1; // none: the frame itself

    const std::string& name() const
    {
        return std::visit([](const auto& frame) -> const std::string& { return frame.name; },
                          content);
    }
    double time() const
    {
        return std::visit([](const auto& frame) { return frame.time; }, content);
    }
    std::int64_t index() const
    {
        return std::visit([](const auto& frame) { return frame.index; }, content);
    }
};

namespace {

constexpr std::size_t frames_that_wait = 2;

using Series = std::map<std::string, std::vector<SeriesEntry>>;

Series series_in(const std::filesystem::path& folder)
{
    Series series;
    for (const std::string& name : series_names(folder)) {
        series[name] = read_series(series_file(folder, name));
    }
    return series;
}

/// Puts the entry at its place in time; an older entry of the same file gives way.
void insert(std::vector<SeriesEntry>& entries, const SeriesEntry& entry)
{
    std::erase_if(entries, [&](const SeriesEntry& old) { return old.file == entry.file; });
    const auto later = [](const SeriesEntry& a, const SeriesEntry& b) { return a.time < b.time; };
    entries.insert(std::upper_bound(entries.begin(), entries.end(), entry, later), entry);
}

bool is_part(const std::filesystem::path& file)
{
    static const std::regex pattern(R"((fluid|walls)_[0-9]{6,}\.[0-9]{4}\.hdf)");
    return std::regex_match(file.filename().string(), pattern);
}

} // namespace

struct FrameWriter::State {
    std::filesystem::path folder;
    Series series; // of the thread; of the solver's side only while the queue is idle

    std::mutex mutex; // guards the members below
    std::condition_variable changed;
    std::deque<FrameJob> queue;
    bool working = false;
    bool closing = false;
    std::exception_ptr error;
    Cost cost;

    std::thread thread;

    explicit State(std::filesystem::path where)
        : folder(std::move(where)), series(series_in(folder))
    {
    }

    void run();
    void write(const FrameJob& job);
    void wait_for_parts(const std::filesystem::path& file, const FrameJob& job);
    void put(FrameJob job);
    void remove_frame(const std::filesystem::path& file) const;
    void remove_parts_of_no_frame() const;
    std::size_t waiting_frames() const;
};

/// Frames in the queue: clouds and surfaces of one index follow each other and count once.
std::size_t FrameWriter::State::waiting_frames() const
{
    std::size_t count = 0;
    for (std::size_t k = 0; k < queue.size(); ++k) {
        count += (k == 0 || queue[k].index() != queue[k - 1].index()) ? 1 : 0;
    }
    return count;
}

void FrameWriter::State::put(FrameJob job)
{
    using Clock = std::chrono::steady_clock;
    const Clock::time_point asked = Clock::now();
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] {
        const bool same_frame = !queue.empty() && queue.back().index() == job.index();
        return error || same_frame || waiting_frames() < frames_that_wait;
    });
    cost.waited_seconds += std::chrono::duration<double>(Clock::now() - asked).count();
    if (error) {
        std::rethrow_exception(error);
    }
    queue.push_back(std::move(job));
    changed.notify_all();
}

/// The main function of the thread. No exception may leave it: the first one is kept for the
/// solver's side.
void FrameWriter::State::run()
{
    std::unique_lock lock(mutex);
    while (true) {
        changed.wait(lock, [&] { return closing || !queue.empty(); });
        if (queue.empty() || error) {
            return;
        }
        const FrameJob job = std::move(queue.front());
        queue.pop_front();
        working = true;
        changed.notify_all();
        lock.unlock();
        std::exception_ptr failure;
        try {
            write(job);
        } catch (...) {
            failure = std::current_exception();
        }
        lock.lock();
        working = false;
        cost.files += 1;
        cost.thread_seconds = thread_seconds();
        error = failure;
        changed.notify_all();
        if (error) {
            return;
        }
    }
}

void FrameWriter::State::write(const FrameJob& job)
{
    const std::filesystem::path file =
        job.place == FramePlace::alone ? std::filesystem::path(job.name() + ".hdf")
                                       : std::filesystem::path("frames") /
                                             fmt::format("{}_{:06}.hdf", job.name(), job.index());
    if (job.part >= 0) {
        write_vtkhdf(folder / part_of_frame(file, job.part), std::get<Cloud>(job.content));
        return;
    }
    wait_for_parts(folder / file, job);
    std::visit([&](const auto& frame) { write_vtkhdf(folder / file, frame); }, job.content);
    if (job.place == FramePlace::series) {
        std::vector<SeriesEntry>& entries = series[job.name()];
        insert(entries, {file, job.time()});
        write_series(series_file(folder, job.name()), entries);
    }
}

/// Other processes rename their parts into place when they are complete.
void FrameWriter::State::wait_for_parts(const std::filesystem::path& file, const FrameJob& job)
{
    using Clock = std::chrono::steady_clock;
    constexpr auto patience = std::chrono::minutes(10); // a part is written in seconds
    const auto* const cloud = std::get_if<CloudOfParts>(&job.content);
    const Clock::time_point asked = Clock::now();
    for (std::size_t k = 0; cloud != nullptr && k < cloud->points.size();) {
        const std::filesystem::path part = part_of_frame(file, static_cast<int>(k));
        std::error_code fault;
        if (std::filesystem::exists(part, fault)) {
            ++k;
            continue;
        }
        std::unique_lock lock(mutex);
        changed.wait_for(lock, std::chrono::milliseconds(5), [&] { return closing; });
        if (closing || Clock::now() - asked > patience) {
            throw IoError(fmt::format("the part `{}` of a frame was not written", part.string()));
        }
    }
}

FrameWriter::Cost FrameWriter::cost() const
{
    const std::scoped_lock lock(state_->mutex);
    return state_->cost;
}

FrameWriter::FrameWriter(std::filesystem::path folder)
    : state_(std::make_unique<State>(std::move(folder)))
{
    std::error_code reason;
    std::filesystem::create_directories(state_->folder / "frames", reason);
    if (reason) {
        throw IoError(fmt::format("cannot create `{}`: {}", (state_->folder / "frames").string(),
                                  reason.message()));
    }
    state_->thread = std::thread(&State::run, state_.get());
}

FrameWriter::~FrameWriter()
{
    {
        const std::scoped_lock lock(state_->mutex);
        state_->closing = true;
    }
    state_->changed.notify_all();
    state_->thread.join();
}

void FrameWriter::write(FrameContent content, FramePlace place, int part)
{
    state_->put({std::move(content), place, part});
}

void FrameWriter::State::remove_frame(const std::filesystem::path& file) const
{
    std::error_code gone_already;
    std::filesystem::remove(folder / file, gone_already);
}

/// Parts whose frame no series names: of frames that were removed, or never finished.
void FrameWriter::State::remove_parts_of_no_frame() const
{
    std::set<std::string> named;
    for (const auto& [name, entries] : series) {
        for (const SeriesEntry& entry : entries) {
            named.insert(entry.file.stem().string());
        }
    }
    std::error_code fault;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "frames", fault)) {
        const std::filesystem::path frame = entry.path().stem(); // "fluid_000012.0003"
        if (is_part(entry.path()) && !named.contains(frame.stem().string())) {
            remove_frame(entry.path().lexically_relative(folder));
        }
    }
}

void FrameWriter::forget_after(double time)
{
    finish();
    for (auto& [name, entries] : state_->series) {
        std::vector<std::filesystem::path> forgotten;
        for (const SeriesEntry& entry : entries) {
            if (entry.time > time) {
                forgotten.push_back(entry.file);
            }
        }
        std::erase_if(entries, [&](const SeriesEntry& entry) { return entry.time > time; });
        // The series first: it must never name a file that is gone.
        write_series(series_file(state_->folder, name), entries);
        for (const std::filesystem::path& file : forgotten) {
            state_->remove_frame(file);
        }
    }
    state_->remove_parts_of_no_frame();
}

std::vector<std::filesystem::path> FrameWriter::missing()
{
    finish();
    std::vector<std::filesystem::path> gone;
    for (const auto& [name, entries] : state_->series) {
        for (const SeriesEntry& entry : entries) {
            if (!std::filesystem::exists(state_->folder / entry.file)) {
                gone.push_back(entry.file);
            }
        }
    }
    return gone;
}

void FrameWriter::finish()
{
    std::unique_lock lock(state_->mutex);
    state_->changed.wait(
        lock, [&] { return state_->error || (state_->queue.empty() && !state_->working); });
    if (state_->error) {
        std::rethrow_exception(state_->error);
    }
}

} // namespace hyoryu
