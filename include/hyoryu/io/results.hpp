// SPDX-License-Identifier: MIT
// The results folder: frames, histories, the master file and the checkpoint. Each file appears
// complete (written to a temporary name, then renamed) or, for histories, grows by complete rows.
// A writer thread compresses and writes the frames, so that the solver does not wait.
#pragma once

#include "hyoryu/core/snapshot.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hyoryu {

/// Keeps other runs out of a results folder for as long as it lives. The lock is on the folder
/// itself (flock), so it adds no file, and the system releases it however the process ends. On a
/// file system without such locks the folder is unguarded.
class FolderLock {
public:
    /// Throws CaseError if another run holds the folder, IoError if it cannot be opened.
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(FolderLock&& other) noexcept;
    FolderLock& operator=(FolderLock&&) = delete;

private:
    int descriptor_ = -1;
};

/// Throws CaseError if a folder does not exist or has no plan of a run.
void expect_results(const std::filesystem::path& folder);

enum class Existing { refuse, replace, extend };

/// Makes the folder ready. refuse: throws CaseError if it exists and is not empty; replace: removes
/// the files of an earlier run; extend: keeps everything but abandoned temporary files. A folder is
/// ours if it holds `frames/` or `plan.json` (a case file alone does not make it ours: it may be
/// the only copy of the input of a user). `replace` throws CaseError, and removes nothing, if the
/// folder is not ours or holds anything that no run writes. Throws IoError if it cannot be written,
/// and CaseError, leaving everything as it is, if another run holds its lock.
FolderLock prepare_results(const std::filesystem::path& folder, Existing existing);

/// Writes `text` to `file` so that a reader sees the old or the new text, never a part.
void write_text(const std::filesystem::path& file, const std::string& text);

/// Writes `text` to a file that is not there yet. Returns false, and changes nothing, if anything
/// has that name, a link that leads nowhere included. Throws IoError, and leaves no file, if it
/// cannot be written.
bool write_new_text(const std::filesystem::path& file, std::string_view text);

/// The content of a file, and whether it is one of a series, `frames/<name>_000012.hdf`, or never
/// changes, and so stands alone: `<name>.hdf` in the folder itself.
using FrameContent = std::variant<Cloud, Surface, CloudOfParts>;
enum class FramePlace { series, alone };

/// Writes frames in a thread of its own while the solver goes on; at most two frames wait (all
/// clouds and surfaces of one index are one frame). Every file is a complete VTKHDF 1.0
/// UnstructuredGrid under `frames/`; the series file `<name>.hdf.series` follows after the rename.
/// An error in the thread is thrown (IoError) by the next call, and by every later one, on the
/// solver's side; nothing is written after it.
class FrameWriter {
public:
    /// Series files that an earlier run left in the folder are continued.
    explicit FrameWriter(std::filesystem::path folder);
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;
    /// `part`: which part of the frame a cloud is, `frames/<name>_000012.0003.hdf`; -1: it is the
    /// frame itself. One over parts is written once all of them are on disk, by whatever process;
    /// at least one of them must have been given to this writer.
    void write(FrameContent content, FramePlace place = FramePlace::series, int part = -1);
    /// Removes every frame later than `time` and its place in the series, and parts of no frame: a
    /// resumed run writes them again. Waits for frames on their way.
    void forget_after(double time);
    /// Frames that a series names and that are not there, relative to the folder: somebody removed
    /// them. Waits for frames on their way.
    std::vector<std::filesystem::path> missing();
    /// Waits until all data is on disk and throws the first error.
    void finish();

    /// Cost of the frames so far.
    struct Cost {
        std::int64_t files = 0;
        double thread_seconds = 0; // CPU time of the thread
        double waited_seconds = 0; // of the solver's side, until a place was free
    };
    Cost cost() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A CSV history: a `#` line of units, a header row, then rows with full double precision.
class History {
public:
    /// Keeps however many rows there are.
    static constexpr std::int64_t all_rows = std::numeric_limits<std::int64_t>::max();

    /// Opens a new `folder/<table.name>.csv`, replacing an existing one.
    History(const std::filesystem::path& folder, const Table& table);
    /// Goes on with the file, keeping the rows whose first cell is at most `keep_until` [s], and no
    /// more than the first `keep_rows`: a row may be written later than the time in its first cell.
    /// A last row that was torn by a kill is dropped. Throws IoError, and leaves the file as it is,
    /// if it has other columns or fewer such rows than `keep_rows`: rows that the state counts as
    /// written are gone. Starts a new file if there is none and no row is to be kept.
    History(const std::filesystem::path& folder, const Table& table, double keep_until,
            std::int64_t keep_rows = all_rows);
    ~History();
    History(History&&) noexcept;
    History& operator=(History&&) noexcept;
    /// Appends one row: texts and numbers in the order of the heads, already formatted by `cell`.
    void append(std::span<const std::string> cells);
    /// Rows of the file, those that were kept included.
    std::int64_t rows() const;
    /// Forces the rows to the disk.
    void flush();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Gives the history of a folder other columns: rows keep the cells of columns that go on and have
/// "nan" in those that are new. Where a column ends, the file so far is kept beside it as
/// `NAME_1.csv`, `NAME_2.csv` ... A history that has the columns, or that is not there, stays as it
/// is. Throws IoError.
void change_columns(const std::filesystem::path& folder, const Table& table);

/// Keeps a history that no longer grows as `NAME_1.csv`, `NAME_2.csv` ..., if it is there. Throws
/// IoError.
void set_aside(const std::filesystem::path& folder, const std::string& name);

/// The shortest text that reads back as the same double.
std::string cell(double value);
/// The text itself, quoted where CSV asks for it.
std::string cell(std::string_view text);

/// Writes `results.h5` for h5py users: attributes (version, title), `/case`, `/plan` and `/summary`
/// (texts), `/times` and `/indices` of the frames, `/histories/<name>/<column>` from the CSV files,
/// and external links `/frames/000000/fluid` to the frame files. It may be called again at any
/// time.
void write_master(const std::filesystem::path& folder, const std::string& case_text,
                  const std::string& version);

/// A file with a part of a checkpoint, which the checkpoint itself names.
struct CheckpointPart {
    std::string name;        // in the results folder
    std::uint64_t bytes = 0; // of its content
    std::uint32_t checksum = 0;
};

/// Number of a set of parts that the folder does not have yet: parts never replace each other,
/// since the checkpoint before must stay whole until the new one is. Throws IoError.
std::int64_t next_part_set(const std::filesystem::path& folder);

/// Writes `checkpoint.SET.PART.h5`.
CheckpointPart write_checkpoint_part(const std::filesystem::path& folder, std::int64_t set,
                                     int part, const StateOnDemand& state);

/// Writes `checkpoint.h5`; the one that stood there becomes `checkpoint.previous.h5`. At every
/// moment at least one of the two is whole. Arrays are made, or those of the snapshot freed, as
/// they are written. `parts`: what is in other files, all of which are on disk. Parts that neither
/// of the two names are removed.
void write_checkpoint(const std::filesystem::path& folder, StateOnDemand state,
                      const std::vector<CheckpointPart>& parts = {});
void write_checkpoint(const std::filesystem::path& folder, Snapshot snapshot,
                      const std::vector<CheckpointPart>& parts = {});

/// Reads a part. Throws IoError if it is missing, damaged, or not the one that was written.
Snapshot read_checkpoint_part(const std::filesystem::path& folder, const CheckpointPart& part);

/// Reads `checkpoint.h5`, which has no parts. Throws IoError if the file is missing, damaged
/// (checksum), of another format version or of another program.
Snapshot read_checkpoint(const std::filesystem::path& folder);

/// The newest checkpoint of a folder that can be read.
struct NewestCheckpoint {
    Snapshot snapshot;
    std::vector<CheckpointPart> parts; // that were checked, and are not read yet
    std::string passed_over;           // why `checkpoint.h5` was not it; empty if it was
};

/// The checkpoint of a folder that can be resumed, by the lengths of its files; checksums are not
/// compared.
enum class UsableCheckpoint { none, newest, previous };
UsableCheckpoint find_checkpoint(const std::filesystem::path& folder);

/// Reads `checkpoint.h5` or, if that or one of its parts cannot be read,
/// `checkpoint.previous.h5`. Throws IoError with the reasons if neither can, and if `checkpoint.h5`
/// is a folder.
NewestCheckpoint read_newest_checkpoint(const std::filesystem::path& folder);

/// Puts `checkpoint.previous.h5` in the place of a `checkpoint.h5` that cannot be read, so that the
/// next checkpoint does not push the only good one out. Throws IoError.
void take_previous_checkpoint(const std::filesystem::path& folder);

/// One frame read back (VTKHDF file): for `render`, `info` and tests. Name and index are those in
/// the file. Throws IoError.
Cloud read_frame(const std::filesystem::path& file);
Surface read_surface(const std::filesystem::path& file);

/// Names and times of the frames of a series file. Throws IoError.
struct SeriesEntry {
    std::filesystem::path file;
    double time = 0;
};
std::vector<SeriesEntry> read_series(const std::filesystem::path& series);

/// Which of the entries, of which there is one at least, is nearest to a time [s]; the first of
/// equally near ones. `entries`: of a series, or other things with a `time` [s].
std::size_t nearest_in_time(const auto& entries, double time)
{
    const auto found = std::ranges::min_element(
        entries, {}, [time](const auto& entry) { return std::abs(entry.time - time); });
    return static_cast<std::size_t>(found - entries.begin());
}

} // namespace hyoryu
