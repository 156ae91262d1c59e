// SPDX-License-Identifier: MIT
// The results folder: frames, histories, the master file and the checkpoint. Every file appears
// whole (written to a temporary name, then renamed) or, for histories, grows by whole rows.
#pragma once

#include "hyoryu/core/snapshot.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

enum class Existing { refuse, replace, extend };

/// Makes the folder ready. refuse: throws CaseError if it exists and is not empty; replace: removes
/// what an earlier run wrote there; extend: keeps everything but abandoned temporary files.
/// A folder is ours if it holds `frames/` or `plan.json` (a case file alone does not make it ours:
/// it may be the only copy of what a user typed). `replace` throws CaseError, and removes nothing,
/// if the folder is not ours or holds anything that no run writes. Throws IoError if it cannot be
/// written.
void prepare_results(const std::filesystem::path& folder, Existing existing);

/// Writes `text` to `file` so that a reader sees the old or the new text, never a part.
void write_text(const std::filesystem::path& file, const std::string& text);

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
    void write(Cloud cloud);
    void write(Surface surface);
    /// A cloud or surface that never changes: `<name>.hdf` in the folder itself.
    void write_static(Cloud cloud);
    void write_static(Surface surface);
    /// Removes every frame later than `time` and its place in the series: a resumed run writes them
    /// again. Waits for frames on their way.
    void forget_after(double time);
    /// Waits until everything is on disk and throws what went wrong.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// A CSV history: a `#` line of units, a header row, then rows with full double precision.
class History {
public:
    /// Opens a new `folder/<table.name>.csv`, replacing what stands there.
    History(const std::filesystem::path& folder, Table table);
    /// Goes on with the file, keeping the rows whose first cell is at most `keep_until` [s]; a last
    /// row that was torn by a kill is dropped. Starts a new file if there is none. Throws IoError
    /// if the file has other columns.
    History(const std::filesystem::path& folder, Table table, double keep_until);
    ~History();
    History(History&&) noexcept;
    History& operator=(History&&) noexcept;
    /// Appends one row: texts and numbers in the order of the heads, already formatted by `cell`.
    void append(std::span<const std::string> cells);
    /// Hands the rows to the operating system.
    void flush();

private:
    struct State;
    std::unique_ptr<State> state_;
};

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

/// Writes / reads `checkpoint.h5`. Reading throws IoError if the file is missing, damaged
/// (checksum) or of another format version.
void write_checkpoint(const std::filesystem::path& folder, const Snapshot& snapshot);
Snapshot read_checkpoint(const std::filesystem::path& folder);

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

} // namespace hyoryu
