// SPDX-License-Identifier: MIT
// Histories: CSV files that grow by whole rows and can be taken up again after a kill.
#include "atomic_file.hpp"
#include "csv.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fcntl.h>
#include <span>
#include <unistd.h>
#include <utility>

namespace hyoryu {

namespace {

constexpr std::size_t buffer_limit = std::size_t{1} << 16; // bytes handed over at once

std::filesystem::path history_file(const std::filesystem::path& folder, const Table& table)
{
    return folder / (table.name + ".csv");
}

bool is_kept(std::string_view line, std::size_t cells, double keep_until)
{
    std::size_t count = 0;
    bool early = false;
    for_each_csv_cell(line, [&](std::size_t k, std::string_view cell_text) {
        const std::optional<double> time = k == 0 ? csv_number(cell_text) : std::nullopt;
        early = early || (time && *time <= keep_until);
        ++count;
    });
    return early && count == cells;
}

/// The header and the rows of the file that stay.
struct Kept {
    std::string text;
    std::int64_t rows = 0;
};

Kept kept_of(const std::filesystem::path& file, const Table& table, double keep_until,
             std::int64_t keep_rows)
{
    std::string kept = csv_header(table);
    if (!std::filesystem::exists(file)) {
        return {kept};
    }
    std::int64_t rows = 0;
    const std::string text = file_text(file);
    if (!text.starts_with(kept) && !kept.starts_with(text)) { // the latter: torn within the header
        throw IoError(fmt::format(
            "cannot go on with `{}`: it has other columns than this run writes", file.string()));
    }
    const std::size_t header = std::min(kept.size(), text.size());
    for (const std::string_view line : whole_lines(std::string_view(text).substr(header))) {
        if (rows < keep_rows && is_kept(line, table.heads.size(), keep_until)) {
            kept.append(line);
            kept += '\n';
            ++rows;
        }
    }
    return {kept, rows};
}

} // namespace

struct History::State {
    std::filesystem::path file;
    std::size_t cells = 0;
    std::int64_t rows = 0;
    std::string buffer;
    int descriptor = -1;

    State(const std::filesystem::path& folder, const Table& table, const Kept& begin)
        : file(history_file(folder, table)), cells(table.heads.size()), rows(begin.rows)
    {
        write_text(file, begin.text);
        descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor < 0) {
            throw_system_error("append to", file);
        }
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() { ::close(descriptor); }

    /// Emptied first: after an error the rows are lost, not written twice.
    void flush()
    {
        const std::string text = std::exchange(buffer, {});
        write_all(descriptor, std::as_bytes(std::span(text)), file);
    }
};

History::History(const std::filesystem::path& folder, Table table)
    : state_(std::make_unique<State>(folder, table, Kept{csv_header(table)}))
{
}

History::History(const std::filesystem::path& folder, Table table, double keep_until,
                 std::int64_t keep_rows)
    : state_(std::make_unique<State>(
          folder, table, kept_of(history_file(folder, table), table, keep_until, keep_rows)))
{
}

/// A destructor cannot tell of a full disk: whoever cares calls flush() before.
History::~History()
{
    if (state_) {
        try {
            state_->flush();
        } catch (const IoError&) {
            return;
        }
    }
}

History::History(History&&) noexcept = default;
History& History::operator=(History&&) noexcept = default;

void History::append(std::span<const std::string> cells)
{
    expects(cells.size() == state_->cells);
    state_->buffer += csv_line(cells);
    ++state_->rows;
    if (state_->buffer.size() > buffer_limit) {
        state_->flush();
    }
}

std::int64_t History::rows() const
{
    return state_->rows;
}

void History::flush()
{
    state_->flush();
    // EINVAL: not a file that can be synchronised, for instance a pipe.
    if (::fsync(state_->descriptor) != 0 && errno != EINVAL) {
        throw_system_error("write", state_->file);
    }
}

} // namespace hyoryu
