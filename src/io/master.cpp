// SPDX-License-Identifier: MIT
// results.h5: one file through which h5py reaches everything of a run.
#include "atomic_file.hpp"
#include "csv.hpp"
#include "hdf5.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/convert.hpp"
#include "packed_array.hpp"
#include "series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

/// The title as the resolved case writes it: `title = "..."` on a line of its own.
std::string title_of(std::string_view case_text)
{
    constexpr std::string_view key = "title = \"";
    for (const std::string_view line : whole_lines(case_text)) {
        if (line.starts_with(key)) {
            return std::string(line.substr(key.size(), line.rfind('"') - key.size()));
        }
    }
    return {};
}

void link_to_grid(hid_t parent, const std::string& name, const fs::path& file)
{
    hdf5::check(H5Lcreate_external(file.generic_string().c_str(), "/VTKHDF", parent, name.c_str(),
                                   H5P_DEFAULT, H5P_DEFAULT),
                fmt::format("link `{}`", file.string()));
}

/// The frame of a number: its time and the file of each series.
struct Frame {
    double time = 0;
    std::map<std::string, fs::path> files;
};

std::map<std::string, Frame> frames_in(const fs::path& folder)
{
    std::map<std::string, Frame> frames;
    for (const std::string& name : series_names(folder)) {
        for (const SeriesEntry& entry : read_series(series_file(folder, name))) {
            Frame& frame = frames[frame_number(entry)];
            frame.time = entry.time;
            frame.files[name] = entry.file;
        }
    }
    return frames;
}

void put_frames(hid_t file, const fs::path& folder)
{
    std::vector<double> times;
    std::vector<std::int64_t> indices;
    const hdf5::Handle group = hdf5::create_group(file, "frames");
    for (const auto& [number, frame] : frames_in(folder)) {
        const hdf5::Handle one = hdf5::create_group(group, number);
        hdf5::put_attribute(one, "time", frame.time);
        for (const auto& [name, target] : frame.files) {
            link_to_grid(one, name, target);
        }
        times.push_back(frame.time);
        indices.push_back(std::stoll(number));
    }
    put_array(file, "times", packed(view_of(std::span<const double>(times), 1)), "s");
    put_array(file, "indices", packed(view_of(std::span<const std::int64_t>(indices), 1)), "");
    for (const std::string name : {"walls", "structures"}) {
        if (fs::exists(folder / (name + ".hdf"))) {
            link_to_grid(file, name, name + ".hdf");
        }
    }
}

/// One column of a history: numbers if every cell is one, else texts.
struct HistoryColumn {
    std::string name;
    std::string unit;
    bool of_texts = false;
    std::vector<double> numbers;
    std::vector<std::string> texts;
};

std::vector<HistoryColumn> empty_columns(std::string_view units_line, std::string_view names_line)
{
    const std::vector<std::string> units = csv_cells(units_line.substr(2));
    std::vector<HistoryColumn> columns;
    for (std::string& name : csv_cells(names_line)) {
        columns.push_back({std::move(name), units.at(std::min(columns.size(), units.size() - 1))});
    }
    return columns;
}

/// A table of contacts may have millions of rows: only columns that hold no numbers keep texts, and
/// those are read a second time.
std::vector<HistoryColumn> history_columns(std::string_view text)
{
    const std::vector<std::string_view> lines = whole_lines(text);
    if (lines.size() < 2 || !lines[0].starts_with("# ")) {
        return {};
    }
    std::vector<HistoryColumn> columns = empty_columns(lines[0], lines[1]);
    const auto for_each_cell = [&](const auto& visit) {
        for (const std::string_view line : std::span(lines).subspan(2)) {
            for_each_csv_cell(line, [&](std::size_t k, std::string_view cell_text) {
                if (k < columns.size()) {
                    visit(columns[k], cell_text);
                }
            });
        }
    };
    for_each_cell([](HistoryColumn& column, std::string_view cell_text) {
        const auto number = column.of_texts ? std::nullopt : csv_number(cell_text);
        if (number) {
            column.numbers.push_back(*number);
        } else {
            column.of_texts = true;
            column.numbers = {};
        }
    });
    if (std::ranges::any_of(columns, &HistoryColumn::of_texts)) {
        for_each_cell([](HistoryColumn& column, std::string_view cell_text) {
            if (column.of_texts) {
                column.texts.emplace_back(cell_text);
            }
        });
    }
    return columns;
}

/// Texts of one length, padded with zeros, which h5py reads as an array of bytes.
void put_texts(hid_t parent, const std::string& name, const std::vector<std::string>& texts)
{
    std::size_t length = 1;
    for (const std::string& text : texts) {
        length = std::max(length, text.size());
    }
    std::string joined;
    for (const std::string& text : texts) {
        joined += text;
        joined.append(length - text.size(), '\0');
    }
    const std::string action = fmt::format("write the column `{}`", name);
    const hsize_t count = texts.size();
    const hdf5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, action);
    hdf5::check(H5Tset_size(type, length), action);
    hdf5::check(H5Tset_strpad(type, H5T_STR_NULLPAD), action);
    hdf5::check(H5Tset_cset(type, H5T_CSET_UTF8), action);
    const hdf5::Handle space(H5Screate_simple(1, &count, nullptr), H5Sclose, action);
    const hdf5::Handle dataset(
        H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose, action);
    hdf5::check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, joined.data()), action);
}

void put_history(hid_t parent, const std::string& name, std::string_view text)
{
    const hdf5::Handle group = hdf5::create_group(parent, name);
    for (const HistoryColumn& column : history_columns(text)) {
        if (column.of_texts) {
            put_texts(group, column.name, column.texts);
        } else {
            const auto view = view_of(std::span<const double>(column.numbers), 1);
            put_array(group, column.name, packed(view), column.unit);
        }
    }
}

std::vector<fs::path> tables_in(const fs::path& folder)
{
    std::vector<fs::path> tables;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".csv") {
            tables.push_back(entry.path());
        }
    }
    std::sort(tables.begin(), tables.end());
    return tables;
}

/// Size of the tables as text, an upper bound of their size as numbers [B].
std::size_t bytes_of_tables(const fs::path& folder)
{
    std::size_t total = 0;
    for (const fs::path& table : tables_in(folder)) {
        total += fs::file_size(table);
    }
    return total;
}

void put_histories(hid_t file, const fs::path& folder)
{
    const hdf5::Handle group = hdf5::create_group(file, "histories");
    for (const fs::path& table : tables_in(folder)) {
        put_history(group, table.stem().string(), bytes_of_file(table));
    }
}

} // namespace

void write_master(const std::filesystem::path& folder, const std::string& case_text,
                  const std::string& version)
{
    AtomicFile atomic(folder / "results.h5");
    const hdf5::Session session;
    hdf5::FileImage image(bytes_of_tables(folder));
    hdf5::put_attribute(image, "program", std::string("hyoryu"));
    hdf5::put_attribute(image, "version", version);
    hdf5::put_attribute(image, "title", title_of(case_text));
    hdf5::put_text(image, "case", case_text);
    for (const std::string name : {"plan", "summary"}) {
        if (const fs::path file = folder / (name + ".json"); fs::exists(file)) {
            hdf5::put_text(image, name, bytes_of_file(file));
        }
    }
    put_frames(image, folder);
    put_histories(image, folder);
    atomic.write(image.bytes());
    atomic.commit();
}

} // namespace hyoryu
