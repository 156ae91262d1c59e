// SPDX-License-Identifier: MIT
// The reader of places and heights in lines, if they lie on a grid.
#include "grid_text.hpp"

#include <algorithm>
#include <array>

namespace hyoryu {

namespace {

// Rounding of the coordinates in a file, as a part of the cells.
constexpr double off_grid = 0.05;
// Points that fill less than this part of a grid form none: scattered points have lines of their
// own.
constexpr double least_given = 0.1;

struct Point {
    double x = 0, y = 0, z = 0; // [m]
    std::size_t line = 0;
};

// The words of a line, up to four; the rest does not matter.
std::array<std::string_view, 4> words_of(std::string_view line, std::size_t& count)
{
    std::array<std::string_view, 4> words;
    count = 0;
    const auto is_blank = [](char c) {
        return static_cast<unsigned char>(c) <= ' ' || c == ',' || c == ';';
    };
    for (std::size_t k = 0; k < line.size() && count < words.size();) {
        if (is_blank(line[k])) {
            ++k;
            continue;
        }
        const std::size_t begin = k;
        while (k < line.size() && !is_blank(line[k])) {
            ++k;
        }
        words[count++] = line.substr(begin, k - begin);
    }
    return words;
}

bool is_heading(const std::array<std::string_view, 4>& words, std::size_t count)
{
    const auto is = [&](std::size_t k, char small) {
        return words[k].size() == 1 && (words[k][0] | 0x20) == small;
    };
    return count == 3 && is(0, 'x') && is(1, 'y') && is(2, 'z');
}

// Calls f(number of the line, its words, their count) for lines of content until it is false.
void over_lines(std::string_view text, const auto& f)
{
    std::size_t number = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view whole = text.substr(begin, end - begin);
        std::size_t count = 0;
        const auto words = words_of(whole.substr(0, whole.find('#')), count);
        begin = end + 1;
        ++number;
        if (count > 0 && !f(number, words, count)) {
            return;
        }
    }
}

[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line,
                         const std::string& fault)
{
    throw IoError(fmt::format("{}:{}: {}", file.string(), line, fault));
}

std::vector<Point> points_of(const std::filesystem::path& file, const std::string& text)
{
    std::vector<Point> points;
    over_lines(text, [&](std::size_t line, const auto& words, std::size_t count) {
        if (points.empty() && is_heading(words, count)) {
            return true;
        }
        const auto x = number_of(words[0]);
        const auto y = count > 1 ? number_of(words[1]) : std::nullopt;
        const auto z = count > 2 ? number_of(words[2]) : std::nullopt;
        const bool sound = x && y && z && std::isfinite(*x) && std::isfinite(*y);
        if (!sound || count > 3 || std::isinf(*z)) {
            refuse(file, line, "expected three numbers: easting, northing and height in m");
        }
        points.push_back({*x, *y, *z, line});
        return static_cast<double>(points.size()) < most_grid_cells;
    });
    return points;
}

// The lines of a grid along one axis.
struct Axis {
    double first = 0, cell = 0; // [m]
    double count = 0;
};

// The grid lines along an axis. The cell is the median distance of neighbouring values, without
// distances that are round-off.
Axis axis_of(std::vector<double> values)
{
    std::ranges::sort(values);
    const double range = values.back() - values.front();
    std::vector<double> gaps;
    for (std::size_t k = 1; k < values.size(); ++k) {
        constexpr double rounding = 1e-7; // of the range
        if (values[k] - values[k - 1] > rounding * range) {
            gaps.push_back(values[k] - values[k - 1]);
        }
    }
    if (gaps.empty()) {
        return {values.front(), 0, 1};
    }
    const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
    std::ranges::nth_element(gaps, middle);
    const double steps = std::round(range / *middle);
    return {values.front(), range / steps, steps + 1};
}

std::array<Axis, 2> axes_of(const std::filesystem::path& file, const std::vector<Point>& points)
{
    std::vector<double> x;
    std::vector<double> y;
    for (const Point& p : points) {
        x.push_back(p.x);
        y.push_back(p.y);
    }
    const std::array<Axis, 2> axes{axis_of(std::move(x)), axis_of(std::move(y))};
    const double cells = axes[0].count * axes[1].count;
    if (axes[0].count < 2 || axes[1].count < 2) {
        refuse(file, points.back().line, "the points lie on one line, expected a grid");
    }
    const bool sparse = static_cast<double>(points.size()) < least_given * cells;
    const auto off = [](const Axis& axis, double value) {
        const double place = (value - axis.first) / axis.cell;
        return std::abs(place - std::round(place)) > off_grid;
    };
    const auto lost = std::ranges::find_if(
        points, [&](const Point& p) { return off(axes[0], p.x) || off(axes[1], p.y); });
    if (sparse || lost != points.end() || cells > most_grid_cells) {
        refuse(
            file, (lost != points.end() ? *lost : points.front()).line,
            "the points are scattered, expected a regular grid; with the header x,y,z: `ogr2ogr "
            "-oo X_POSSIBLE_NAMES=x -oo Y_POSSIBLE_NAMES=y points.gpkg FILE.csv`, then `gdal_grid "
            "-a linear -zfield z -tr 1 1 points.gpkg ground.tif` grids them at 1 m");
    }
    return axes;
}

} // namespace

bool is_point_text(std::string_view text)
{
    bool found = false;
    over_lines(text, [&](std::size_t, const auto& words, std::size_t count) {
        found = is_heading(words, count) ||
                (count >= 3 && number_of(words[0]) && number_of(words[1]) && number_of(words[2]));
        return false;
    });
    return found;
}

HeightGrid grid_of_points(const std::filesystem::path& file, const std::string& text,
                          double substitute)
{
    const std::vector<Point> points = points_of(file, text);
    if (points.empty()) {
        refuse(file, 1,
               "no point follows the header, expected lines of easting, northing and height in m");
    }
    const auto [x, y] = axes_of(file, points);
    HeightGrid grid{.columns = static_cast<Index>(x.count),
                    .rows = static_cast<Index>(y.count),
                    .first = {x.first, y.first},
                    .cell = {x.cell, y.cell}};
    if (may_be_degrees(grid)) {
        refuse(file, points.front().line, grid_in_degrees);
    }
    const auto cells = static_cast<std::size_t>(grid.columns * grid.rows);
    grid.height.assign(cells, substitute);
    std::vector<bool> given(cells);
    for (const Point& p : points) {
        const auto i = static_cast<Index>(std::llround((p.x - x.first) / x.cell));
        const auto j = static_cast<Index>(std::llround((p.y - y.first) / y.cell));
        const auto k = static_cast<std::size_t>(j * grid.columns + i);
        if (given[k]) {
            refuse(file, p.line,
                   fmt::format("the point ({:.9g}, {:.9g}) is given twice", p.x, p.y));
        }
        given[k] = true;
        grid.height[k] = std::isnan(p.z) || p.z == none_given ? substitute : p.z;
    }
    return grid;
}

} // namespace hyoryu
