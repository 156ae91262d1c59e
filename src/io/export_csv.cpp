// SPDX-License-Identifier: MIT
// Clouds as tables: one row a particle, the shortest numbers that read back as the same.
#include "atomic_file.hpp"
#include "csv.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/convert.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <iterator>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

/// `Velocity` of three components makes the columns Velocity_x, Velocity_y and Velocity_z.
void append_heads(Table& table, const Column& column)
{
    constexpr std::array axes{"x", "y", "z"};
    for (int k = 0; k < column.components; ++k) {
        const std::string part = column.components == 1 ? ""
                                 : column.components == 3
                                     ? fmt::format("_{}", axes[static_cast<std::size_t>(k)])
                                     : fmt::format("_{}", k);
        table.heads.push_back({column.name + part, column.unit});
    }
}

std::string heads_of(const Cloud& cloud)
{
    Table table{cloud.name, {{"x", "m"}, {"y", "m"}, {"z", "m"}}};
    for (const Column& column : cloud.columns) {
        append_heads(table, column);
    }
    return csv_header(table);
}

using Text = fmt::memory_buffer;

template <class T>
void append_cells(Text& text, const std::vector<T>& values, std::size_t row, std::size_t width)
{
    for (std::size_t k = 0; k < width; ++k) {
        fmt::format_to(std::back_inserter(text), ",{}", values[row * width + k]);
    }
}

void append_row(Text& text, const Cloud& cloud, std::size_t row)
{
    const float* const at = &cloud.points[3 * row];
    fmt::format_to(std::back_inserter(text), "{},{},{}", at[0], at[1], at[2]);
    for (const Column& column : cloud.columns) {
        std::visit(
            [&](const auto& values) {
                append_cells(text, values, row, static_cast<std::size_t>(column.components));
            },
            column.values);
    }
    text.push_back('\n');
}

void write_table(const fs::path& file, const Cloud& cloud, double time)
{
    AtomicFile atomic(file);
    Text text;
    fmt::format_to(std::back_inserter(text), "# {} at t = {} s\n{}", cloud.name, time,
                   heads_of(cloud));
    constexpr std::size_t portion = std::size_t{1} << 20; // bytes that wait for the disk
    for (std::size_t row = 0; 3 * row < cloud.points.size(); ++row) {
        append_row(text, cloud, row);
        if (text.size() > portion) {
            atomic.write(std::string_view(text.data(), text.size()));
            text.clear();
        }
    }
    atomic.write(std::string_view(text.data(), text.size()));
    atomic.commit();
}

} // namespace

std::size_t export_csv(const fs::path& results, const FrameSet& set, const fs::path& folder)
{
    std::string index = csv_header({set.name, {{"time", "s"}, {"file", ""}}});
    for (const SeriesEntry& entry : set.frames) {
        const std::string name = fmt::format("{}_{}.csv", set.name, frame_number(entry));
        write_table(folder / name, read_frame(results / entry.file), entry.time);
        index += fmt::format("{},{}\n", entry.time, name);
    }
    write_text(folder / (set.name + ".csv"), index);
    return set.frames.size();
}

} // namespace hyoryu
