// SPDX-License-Identifier: MIT
// Rows and columns of the files of a run.
#include "hyoryu/assess/measure.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/core/input_file.hpp"
#include "hyoryu/io/csv_table.hpp"
#include "hyoryu/io/results.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace hyoryu {

namespace {

namespace fs = std::filesystem;

void append_numbers(const nlohmann::json& value, const std::string& name, CsvTable& table)
{
    if (value.is_object()) {
        for (const auto& [key, inner] : value.items()) {
            append_numbers(inner, name.empty() ? key : fmt::format("{}.{}", name, key), table);
        }
    } else if (value.is_number()) {
        table.columns.push_back({name, {value.get<double>()}, {}});
    }
}

CsvTable read_summary(const fs::path& file)
{
    const auto json = nlohmann::json::parse(bytes_of_file(file), nullptr, false);
    if (json.is_discarded()) {
        throw IoError(fmt::format("cannot read `{}`", file.string()));
    }
    CsvTable table;
    table.rows = 1;
    append_numbers(json, "", table);
    return table;
}

/// The rows that hold the wanted cells.
std::vector<std::size_t> rows_where(const CsvTable& table,
                                    const std::map<std::string, std::string>& where)
{
    std::vector<std::size_t> rows(table.rows);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    for (const auto& [name, wanted] : where) {
        const CsvTable::Column* column = table.find(name);
        if (column == nullptr) {
            throw FormulaError(fmt::format("`where`: there is no column \"{}\"", name));
        }
        std::erase_if(rows, [&, &text = wanted](std::size_t row) {
            return text !=
                   (column->texts.empty() ? cell(column->numbers[row]) : column->texts[row]);
        });
    }
    return rows;
}

/// Every `stride`-th number from the `first`-th on.
CsvTable::Column part(const std::string& name, const std::vector<float>& numbers, std::size_t first,
                      std::size_t stride)
{
    CsvTable::Column column{name, {}, {}};
    for (std::size_t k = first; k < numbers.size(); k += stride) {
        column.numbers.push_back(static_cast<double>(numbers[k]));
    }
    return column;
}

CsvTable table_of(const Cloud& cloud)
{
    CsvTable table;
    table.rows = cloud.points.size() / 3;
    table.columns.push_back({"time", std::vector<double>(table.rows, cloud.time), {}});
    constexpr std::array axes{"x", "y", "z"};
    for (std::size_t k = 0; k < axes.size(); ++k) {
        table.columns.push_back(part(axes[k], cloud.points, k, 3));
    }
    for (const Column& column : cloud.columns) {
        const auto* numbers = std::get_if<std::vector<float>>(&column.values);
        if (numbers != nullptr && column.name == "Velocity") {
            for (std::size_t k = 0; k < axes.size(); ++k) {
                table.columns.push_back(part(std::string("v") + axes[k], *numbers, k, 3));
            }
        } else if (numbers != nullptr && (column.name == "Pressure" || column.name == "Density")) {
            table.columns.push_back(part(column.name == "Pressure" ? "p" : "rho", *numbers, 0, 1));
        }
    }
    return table;
}

} // namespace

RunFiles::RunFiles(fs::path results, fs::path benchmark)
    : results_(std::move(results)), benchmark_(std::move(benchmark))
{
}

const CsvTable& RunFiles::table(const std::string& file)
{
    const auto at = tables_.find(file);
    if (at != tables_.end()) {
        return at->second;
    }
    CsvTable table = file == "summary"        ? read_summary(results_ / "summary.json")
                     : file.ends_with(".csv") ? read_csv(benchmark_ / file)
                                              : read_csv(results_ / (file + ".csv"));
    return tables_.emplace(file, std::move(table)).first->second;
}

const CsvTable& RunFiles::frame(double time)
{
    const std::vector<SeriesEntry> series = read_series(results_ / "fluid.hdf.series");
    if (series.empty()) {
        throw IoError("the run wrote no frame of the fluid");
    }
    const SeriesEntry& found =
        std::isnan(time) ? series.back() : series[nearest_in_time(series, time)];
    if (!std::isnan(time) && std::abs(found.time - time) > 1e-6 * std::max(1.0, time)) {
        throw IoError(
            fmt::format("there is no frame at t = {} s; the nearest is at {} s", time, found.time));
    }
    const fs::path file = results_ / found.file;
    const auto at = frames_.find(file.string());
    return at != frames_.end()
               ? at->second
               : frames_.emplace(file.string(), table_of(read_frame(file))).first->second;
}

Samples samples(const Series& series, const Scope& scope, RunFiles& files)
{
    const auto of_frame = [&]() -> const CsvTable& {
        return files.frame(series.frame.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                : evaluate(series.frame, scope));
    };
    const CsvTable& table = series.file == "fluid" ? of_frame() : files.table(series.file);
    std::vector<std::size_t> rows = rows_where(table, series.where);
    if (!series.filter.empty()) {
        const std::vector<double> keep = evaluate(series.filter, scope, table, rows);
        std::vector<std::size_t> kept;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if (keep[k] != 0) {
                kept.push_back(rows[k]);
            }
        }
        rows = std::move(kept);
    }
    return {table.find("time") != nullptr ? evaluate("t", scope, table, rows)
                                          : std::vector<double>(rows.size(), 0.0),
            evaluate(series.value, scope, table, rows)};
}

} // namespace hyoryu
