// SPDX-License-Identifier: MIT
// The results folder: frames, histories, the master file and the checkpoint. Every file appears whole
// (written to a temporary name, then renamed) or, for histories, grows by whole rows.
#pragma once

#include "hyoryu/core/snapshot.hpp"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hyoryu {

enum class Existing { refuse, replace, extend };

/// Makes the folder ready. refuse: throws CaseError if it exists and is not empty; replace: removes
/// what an earlier run wrote there (and only if the folder is one of ours); extend: keeps everything.
/// Throws IoError if it cannot be written.
void prepare_results(const std::filesystem::path& folder, Existing existing);

/// Writes `text` to `file` so that a reader sees the old or the new text, never a part.
void write_text(const std::filesystem::path& file, const std::string& text);

/// Writes frames in a thread of its own while the solver goes on; at most two frames wait.
/// Every frame is a complete VTKHDF 1.0 UnstructuredGrid under `frames/`; the series file
/// `<name>.hdf.series` and the external links in `results.h5` follow after the rename.
/// An error in the thread is thrown (IoError) by the next call on the solver's side.
class FrameWriter {
public:
    /// `times`: frames that an earlier run left and that the series files go on to name.
    explicit FrameWriter(std::filesystem::path folder);
    ~FrameWriter();
    void write(Cloud cloud);
    void write(Surface surface);
    /// A cloud that never changes: `<name>.hdf` in the folder itself.
    void write_static(Cloud cloud);
    /// Removes from the series every frame later than `time`: a resumed run writes them again.
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
    /// Opens `folder/<table.name>.csv`; with `extend`, keeps the rows up to and including `time`.
    History(const std::filesystem::path& folder, Table table);
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

/// Writes `results.h5`: metadata, the case text, the time table of frames, the CSV histories as
/// tables, and external links `/frames/000000/fluid` to the frame files.
void write_master(const std::filesystem::path& folder, const std::string& case_text,
                  const std::string& version);

/// Writes / reads `checkpoint.h5`. Reading throws IoError if the file is missing, damaged (checksum)
/// or of another format version.
void write_checkpoint(const std::filesystem::path& folder, const Snapshot& snapshot);
Snapshot read_checkpoint(const std::filesystem::path& folder);

/// One frame read back (VTKHDF file): for `render`, `info` and tests. Throws IoError.
Cloud read_frame(const std::filesystem::path& file);

/// Names and times of the frames of a series file. Throws IoError.
struct SeriesEntry {
    std::filesystem::path file;
    double time = 0;
};
std::vector<SeriesEntry> read_series(const std::filesystem::path& series);

} // namespace hyoryu
