// SPDX-License-Identifier: MIT
#include "series.hpp"

#include "hyoryu/core/input_file.hpp"
#include "table_lines.hpp"
#include "units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

namespace hyoryu {

namespace {

constexpr std::array<std::string_view, 5> quantities{"time", "level", "velocity", "discharge", "-"};
constexpr std::array<std::string_view, 5> short_names{"t", "eta", "u", "q", "-"};
constexpr std::array<std::string_view, 5> units{"s", "m", "m/s", "m3/s", ""};
constexpr std::size_t time_column = 0;
constexpr std::size_t none = 4;
constexpr std::size_t most_faults_of_series = 5;
constexpr double least_depth = 1e-3; // below which a cell of GeoClaw is dry [m]

class SeriesReader {
public:
    SeriesReader(const SeriesSource& source, std::vector<std::string>& faults)
        : source_(source), faults_(faults), before_(faults.size())
    {
    }

    OpenSeries read()
    {
        const std::vector<TableLine> lines = lines_of();
        if (!sound()) {
            return {};
        }
        if (source_.format == SeriesFormat::geoclaw) {
            read_geoclaw(lines);
        } else {
            read_csv(lines);
        }
        if (sound() && series_.times.empty()) {
            faults_.push_back(fmt::format("{}: has no row of numbers", source_.file.string()));
        }
        return std::move(series_);
    }

private:
    bool sound() const { return faults_.size() == before_; }

    void fault(int line, const std::string& what)
    {
        if (faults_.size() < before_ + most_faults_of_series) {
            faults_.push_back(fmt::format("{}:{}: {}", source_.file.string(), line, what));
        }
    }

    std::vector<TableLine> lines_of()
    {
        const std::string why = why_unreadable(source_.file, largest_text);
        if (!why.empty()) {
            faults_.push_back(fmt::format("{}: {}", source_.file.string(), why));
            return {};
        }
        std::vector<TableLine> lines = table_lines(source_.file);
        for (const TableLine& line : lines) {
            if (line.mixed) {
                fault(line.number, std::string(mixed_separators));
            }
        }
        return lines;
    }

    // The numbers of a line; none, and a fault, where one is mistaken.
    std::optional<std::vector<double>> numbers_of(const TableLine& line)
    {
        std::vector<double> numbers;
        for (const std::string& word : line.words) {
            const auto value = table_number(word);
            if (!value) {
                fault(line.number, fmt::format("expected a number, found \"{}\"", word));
                return std::nullopt;
            }
            numbers.push_back(*value);
        }
        return numbers;
    }

    // The quantity of each column by the words of a header; units may be words of their own.
    std::vector<std::size_t> header_columns(const TableLine& line)
    {
        std::vector<std::size_t> columns;
        for (std::string word : line.words) {
            std::erase_if(word, [](char c) { return c == '"' || c == '\''; });
            std::ranges::transform(word, word.begin(), [](unsigned char c) {
                return static_cast<char>(std::tolower(c));
            });
            const auto bracket = word.find_first_of("[(");
            const std::string name = word.substr(0, bracket);
            if (!name.empty()) {
                auto at = std::ranges::find(quantities, name) - quantities.begin();
                at = at < 4 ? at : std::ranges::find(short_names, name) - short_names.begin();
                if (at > static_cast<std::ptrdiff_t>(none)) {
                    fault(line.number,
                          fmt::format("the header has an unknown column \"{}\", expected time, "
                                      "level, velocity or discharge; use `columns` for other names",
                                      name));
                    return {};
                }
                columns.push_back(static_cast<std::size_t>(at));
            }
            if (bracket != std::string::npos && !columns.empty()) {
                check_unit(line, word.substr(bracket + 1, word.size() - bracket - 2),
                           columns.back());
            }
        }
        return columns;
    }

    void check_unit(const TableLine& line, const std::string& unit, std::size_t quantity)
    {
        const bool flat = quantity == 3 && unit == "m2/s";
        if (quantity != none && unit != units[quantity] && !flat) {
            fault(line.number, fmt::format("the header gives the unit \"{}\" of {}, expected {}",
                                           unit, quantities[quantity], units[quantity]));
        }
    }

    std::vector<std::size_t> columns_of(const std::vector<TableLine>& lines, bool header)
    {
        std::vector<std::size_t> columns;
        for (const std::string& name : source_.columns) {
            columns.push_back(at(std::ranges::find(quantities, name) - quantities.begin()));
        }
        if (!columns.empty() || lines.empty()) {
            return columns;
        }
        if (header) {
            return header_columns(lines.front());
        }
        const std::size_t count = lines.front().words.size();
        if (count != 2 && count != 3) {
            fault(lines.front().number,
                  fmt::format("has {} columns without a header, expected time, level and velocity; "
                              "use `columns` for other names",
                              count));
            return {};
        }
        columns = {0, 1, 2};
        columns.resize(count);
        return columns;
    }

    void read_csv(const std::vector<TableLine>& lines)
    {
        const bool header = !lines.empty() && !table_number(lines.front().words.front());
        const std::vector<std::size_t> columns = columns_of(lines, header);
        if (sound() && !lines.empty() && std::ranges::find(columns, time_column) == columns.end()) {
            fault(lines.front().number, "has no time column");
        }
        for (std::size_t k = header ? 1 : 0; k < lines.size() && !columns.empty(); ++k) {
            if (lines[k].words.size() != columns.size()) {
                fault(lines[k].number, fmt::format("expected {} numbers, found {}", columns.size(),
                                                   lines[k].words.size()));
                continue;
            }
            const auto numbers = numbers_of(lines[k]);
            for (std::size_t c = 0; numbers && c < columns.size(); ++c) {
                take(lines[k], columns[c], (*numbers)[c]);
            }
        }
    }

    void read_geoclaw(const std::vector<TableLine>& lines)
    {
        constexpr std::size_t least = 6; // level, time, h, hu, hv, eta
        for (const TableLine& line : lines) {
            if (line.words.size() < least) {
                fault(line.number, fmt::format("expected level, time, h, hu, hv and eta, found {} "
                                               "numbers",
                                               line.words.size()));
                continue;
            }
            const auto numbers = numbers_of(line);
            if (!numbers) {
                continue;
            }
            const double h = (*numbers)[2];
            const double along = (*numbers)[3] * std::sin(source_.azimuth) +
                                 (*numbers)[4] * std::cos(source_.azimuth);
            take(line, 0, (*numbers)[1]);
            take(line, 1, (*numbers)[5]);
            take(line, 2, h > least_depth ? along / h : 0);
        }
    }

    void take(const TableLine& line, std::size_t quantity, double value)
    {
        if (quantity == none) {
            return;
        }
        if (std::abs(value) > largest_value(units[quantity])) {
            fault(line.number, fmt::format("{} {} is out of range, expected at most {}", value,
                                           units[quantity], largest_value(units[quantity])));
            return;
        }
        if (quantity == time_column) {
            const double time = value - source_.time_offset;
            if (!series_.times.empty() && !(time > series_.times.back())) {
                fault(line.number, fmt::format("time {} is not later than {}", value, last_time_));
            }
            last_time_ = value;
            series_.times.push_back(time);
        } else if (quantity == 1) {
            series_.levels.push_back(source_.datum + source_.scale * value);
        } else if (quantity == 2) {
            series_.velocities.push_back(source_.scale * value);
        } else {
            series_.discharges.push_back(source_.scale * value);
        }
    }

    const SeriesSource& source_;
    std::vector<std::string>& faults_;
    std::size_t before_;
    double last_time_ = 0;
    OpenSeries series_;
};

} // namespace

OpenSeries read_series(const SeriesSource& source, std::vector<std::string>& faults)
{
    return SeriesReader(source, faults).read();
}

} // namespace hyoryu
