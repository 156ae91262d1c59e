// SPDX-License-Identifier: MIT
// Histories: CSV files that grow by whole rows and can be taken up again after a kill.
#include "atomic_file.hpp"
#include "csv.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <optional>
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

/// Resuming with fewer rows would leave an unnoticed gap.
void expect_rows(const std::filesystem::path& file, std::int64_t rows, std::int64_t expected)
{
    if (expected != History::all_rows && rows < expected) {
        throw IoError(fmt::format("cannot continue `{}`: it has {} rows up to the checkpoint, "
                                  "expected {}: rows are missing",
                                  file.string(), rows, expected));
    }
}

Kept kept_of(const std::filesystem::path& file, const Table& table, double keep_until,
             std::int64_t keep_rows)
{
    std::string kept = csv_header(table);
    std::int64_t rows = 0;
    if (!std::filesystem::exists(file)) {
        expect_rows(file, rows, keep_rows);
        return {kept};
    }
    const std::string text = bytes_of_file(file);
    if (!text.starts_with(kept) && !kept.starts_with(text)) { // the latter: torn within the header
        throw IoError(fmt::format("cannot continue `{}`: its columns differ from those of this run",
                                  file.string()));
    }
    const std::size_t header = std::min(kept.size(), text.size());
    for (const std::string_view line : whole_lines(std::string_view(text).substr(header))) {
        if (rows < keep_rows && is_kept(line, table.heads.size(), keep_until)) {
            kept.append(line);
            kept += '\n';
            ++rows;
        }
    }
    expect_rows(file, rows, keep_rows);
    return {kept, rows};
}

/// For each column of `table`, the index of the column of that name in `before`; none: it is new.
std::vector<std::optional<std::size_t>> origins(const std::vector<std::string>& before,
                                                const Table& table)
{
    std::vector<std::optional<std::size_t>> from;
    for (const Table::Head& head : table.heads) {
        const auto at = std::ranges::find(before, head.name);
        from.push_back(at == before.end() ? std::nullopt
                                          : std::optional<std::size_t>(at - before.begin()));
    }
    return from;
}

std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& name)
{
    for (int number = 1;; ++number) {
        auto file = folder / fmt::format("{}_{}.csv", name, number);
        if (!std::filesystem::exists(file)) {
            return file;
        }
    }
}

std::string with_columns(std::span<const std::string_view> rows,
                         const std::vector<std::optional<std::size_t>>& from)
{
    std::string text;
    std::vector<std::string> cells(from.size());
    for (const std::string_view row : rows) {
        const std::vector<std::string> before = csv_cells(row);
        for (std::size_t k = 0; k < from.size(); ++k) {
            const bool known = from[k] && *from[k] < before.size();
            cells[k] = known ? cell(std::string_view(before[*from[k]])) : "nan";
        }
        text += csv_line(cells);
    }
    return text;
}

} // namespace

void change_columns(const std::filesystem::path& folder, const Table& table)
{
    const std::filesystem::path file = history_file(folder, table);
    const std::string header = csv_header(table);
    if (!std::filesystem::exists(file)) {
        return;
    }
    const std::string text = bytes_of_file(file);
    const std::vector<std::string_view> lines = whole_lines(text);
    if (text.starts_with(header) || lines.size() < 2) {
        return;
    }
    const std::vector<std::string> before = csv_cells(lines[1]);
    const auto from = origins(before, table);
    if (before.front() != table.heads.front().name) {
        throw IoError(fmt::format("cannot continue `{}`: it is damaged", file.string()));
    }
    const auto kept = std::ranges::count_if(from, [](const auto& at) { return at.has_value(); });
    if (static_cast<std::size_t>(kept) < before.size()) {
        write_text(free_name(folder, table.name), text);
    }
    write_text(file, header + with_columns(std::span(lines).subspan(2), from));
}

void set_aside(const std::filesystem::path& folder, const std::string& name)
{
    const std::filesystem::path file = folder / (name + ".csv");
    std::error_code fault;
    if (!std::filesystem::exists(file)) {
        return;
    }
    std::filesystem::rename(file, free_name(folder, name), fault);
    if (fault) {
        throw IoError(fmt::format("cannot rename `{}`: {}", file.string(), fault.message()));
    }
}

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

History::History(const std::filesystem::path& folder, const Table& table)
    : state_(std::make_unique<State>(folder, table, Kept{csv_header(table)}))
{
}

History::History(const std::filesystem::path& folder, const Table& table, double keep_until,
                 std::int64_t keep_rows)
    : state_(std::make_unique<State>(
          folder, table, kept_of(history_file(folder, table), table, keep_until, keep_rows)))
{
}

/// A destructor cannot report a full disk: call flush() before to get the error.
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
