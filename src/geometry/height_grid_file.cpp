// SPDX-License-Identifier: MIT
// The reader of ESRI ASCII grids, which hands other files to theirs.
#include "grid_text.hpp"

#include "hyoryu/core/input_file.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <string_view>

namespace hyoryu {

namespace {

// The words of a text, which are separated by blanks and ends of lines.
class Words {
public:
    /// A byte order mark before the text is passed over.
    Words(const std::filesystem::path& file, const std::string& text)
        : file_(file), text_(text), place_(text.starts_with("\xef\xbb\xbf") ? 3 : 0)
    {
    }

    /// The next word, or an empty one at the end.
    std::string_view next()
    {
        const auto is_blank = [](char c) { return static_cast<unsigned char>(c) <= ' '; };
        const char* const end = text_.data() + text_.size();
        const char* const first = std::find_if_not(text_.data() + place_, end, is_blank);
        const char* const last = std::find_if(first, end, is_blank);
        start_ = static_cast<std::size_t>(first - text_.data());
        place_ = static_cast<std::size_t>(last - text_.data());
        return {first, static_cast<std::size_t>(last - first)};
    }
    /// Where the last word starts, and a return to such a place.
    std::size_t start() const { return start_; }
    void return_to(std::size_t place) { place_ = place; }

    /// Throws with the line of the last word.
    [[noreturn]] void refuse(const std::string& fault) const { refuse_at(start_, fault); }

    /// Throws with the first line from a place on that does not hold `columns` words, where most
    /// lines do: that is the one to mend. Heights may also be wrapped; then with the last word.
    [[noreturn]] void refuse_rows(std::size_t from, std::size_t columns, const std::string& fault)
    {
        const std::size_t last = start_;
        std::size_t odd = std::string::npos;
        std::size_t held = 0;
        std::ptrdiff_t whole = 0; // lines of `columns` words less the others
        for (std::size_t end = 0; from < text_.size(); from = end + 1) {
            end = std::min(text_.find('\n', from), text_.size());
            const std::size_t words = words_between(from, end);
            whole += words == columns ? 1 : words > 0 ? -1 : 0;
            if (words > 0 && words != columns && odd == std::string::npos) {
                odd = from;
                held = words;
            }
        }
        if (odd == std::string::npos || whole <= 0) {
            refuse_at(last, fault);
        }
        refuse_at(odd, fmt::format("this row holds {} heights, and `ncols` is {}; {}", held,
                                   columns, fault));
    }

private:
    [[noreturn]] void refuse_at(std::size_t place, const std::string& fault) const
    {
        const auto begin = text_.begin();
        const auto line = 1 + std::count(begin, begin + static_cast<std::ptrdiff_t>(place), '\n');
        throw IoError(fmt::format("{}:{}: {}", file_.string(), line, fault));
    }
    // Words that start between two places.
    std::size_t words_between(std::size_t from, std::size_t to)
    {
        std::size_t count = 0;
        for (return_to(from); !next().empty() && start_ < to;) {
            ++count;
        }
        return count;
    }

    const std::filesystem::path& file_;
    const std::string& text_;
    std::size_t place_;
    std::size_t start_ = 0;
};

using Header = std::map<std::string, double>;

// The name that a key of the header has here; empty if it is unknown.
std::string name_of(std::string_view word)
{
    static const std::map<std::string, std::string, std::less<>> names{
        {"ncols", "ncols"},
        {"mx", "ncols"},
        {"nrows", "nrows"},
        {"my", "nrows"},
        {"xllcorner", "xllcorner"},
        {"yllcorner", "yllcorner"},
        {"xllcenter", "xllcenter"},
        {"yllcenter", "yllcenter"},
        {"xlower", "xllcenter"},
        {"ylower", "yllcenter"},
        {"cellsize", "cellsize"},
        {"dx", "dx"},
        {"dy", "dy"},
        {"nodata_value", "nodata_value"}};
    std::string small(word);
    std::ranges::transform(small, small.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto found = names.find(small);
    return found == names.end() ? std::string() : found->second;
}

// Whether a word can only be a name: "nan" is a number.
bool is_name(std::string_view word)
{
    return !word.empty() && !number_of(word) && std::isalpha(static_cast<unsigned char>(word[0]));
}

// Pairs of a name and a number, in either order, up to the first height.
Header read_header(Words& words)
{
    Header header;
    for (;;) {
        const std::string_view first = words.next();
        const std::size_t start = words.start();
        const std::string_view second = words.next();
        if (!is_name(first) && !is_name(second)) {
            words.return_to(start);
            return header;
        }
        const std::string name = name_of(is_name(first) ? first : second);
        const std::optional<double> value = number_of(is_name(first) ? second : first);
        if (name.empty() || !value) {
            words.refuse(fmt::format("expected a key of an ESRI ASCII grid and its number, found "
                                     "\"{} {}\"",
                                     first.substr(0, 40), second.substr(0, 40)));
        }
        if (!header.emplace(name, *value).second) {
            words.refuse(fmt::format("`{}` is given twice", name));
        }
    }
}

double required_number(const Header& header, const Words& words, const std::string& name)
{
    const auto found = header.find(name);
    if (found == header.end() || !std::isfinite(found->second)) {
        words.refuse(fmt::format("the header has no `{}`", name));
    }
    return found->second;
}

// The coordinate of the first centre along one axis, 'x' or 'y'.
double first_centre(const Header& header, const Words& words, char axis, double cell)
{
    const std::string corner = fmt::format("{}llcorner", axis);
    const bool by_corner = header.contains(corner);
    const std::string name = by_corner ? corner : fmt::format("{}llcenter", axis);
    if (!by_corner && !header.contains(name)) {
        words.refuse(fmt::format("the header has neither `{}` nor `{}`", corner, name));
    }
    return required_number(header, words, name) + (by_corner ? cell / 2 : 0);
}

void place_grid(const Header& header, const Words& words, HeightGrid& grid)
{
    const double columns = required_number(header, words, "ncols");
    const double rows = required_number(header, words, "nrows");
    const auto whole = [](double n) { return n >= 2 && n == std::floor(n) && n < most_grid_cells; };
    if (!whole(columns) || !whole(rows) || columns * rows > most_grid_cells) {
        words.refuse(
            fmt::format("a grid of {} x {} cells is not supported: expected whole numbers, "
                        "at least 2 x 2 and at most {:.0e} cells",
                        columns, rows, most_grid_cells));
    }
    grid.columns = static_cast<Index>(columns);
    grid.rows = static_cast<Index>(rows);
    const bool square = header.contains("cellsize");
    grid.cell = {required_number(header, words, square ? "cellsize" : "dx"),
                 required_number(header, words, square ? "cellsize" : "dy")};
    if (!(grid.cell[0] > 0) || !(grid.cell[1] > 0)) {
        words.refuse("the size of the cells must be > 0");
    }
    grid.first = {first_centre(header, words, 'x', grid.cell[0]),
                  first_centre(header, words, 'y', grid.cell[1])};
    if (may_be_degrees(grid)) {
        words.refuse(grid_in_degrees);
    }
}

void read_heights(const Header& header, double none, Words& words, HeightGrid& grid)
{
    const auto missing = header.find("nodata_value");
    const auto columns = static_cast<std::size_t>(grid.columns);
    const auto rows = static_cast<std::size_t>(grid.rows);
    grid.height.resize(columns * rows);
    words.next();
    const std::size_t begin = words.start();
    words.return_to(begin);
    for (std::size_t line = 0; line < rows; ++line) { // from north to south
        double* const row = &grid.height[(rows - 1 - line) * columns];
        for (std::size_t k = 0; k < columns; ++k) {
            const std::string_view word = words.next();
            const std::optional<double> value = number_of(word);
            if (word.empty()) {
                words.refuse_rows(begin, columns,
                                  fmt::format("the file ends after {} of {} heights",
                                              line * columns + k, grid.height.size()));
            }
            if (!value || std::isinf(*value)) {
                words.refuse(fmt::format("expected a height, found \"{}\"", word.substr(0, 40)));
            }
            const bool is_missing =
                std::isnan(*value) || (missing != header.end() && *value == missing->second);
            row[k] = is_missing ? none : *value;
        }
    }
    if (!words.next().empty()) {
        words.refuse_rows(begin, columns,
                          fmt::format("there are more than {} heights", grid.height.size()));
    }
}

HeightGrid read_ascii_grid(const std::filesystem::path& file, const std::string& text, double none)
{
    Words words(file, text);
    const Header header = read_header(words);
    HeightGrid grid;
    place_grid(header, words, grid);
    read_heights(header, none, words, grid);
    return grid;
}

// Replaces the default mark of missing heights even if the file does not declare it. A number
// beyond all heights of the Earth is an undeclared mark: it is refused, so that it does not become
// a cliff.
void forget_missing(const std::filesystem::path& file, double none, HeightGrid& grid)
{
    constexpr double farthest = 12000; // of the ground from the sea [m]
    for (double& height : grid.height) {
        height = height == none_given ? none : height;
        if (std::abs(height) > farthest) {
            throw IoError(fmt::format("{}: the height {:.6g} m is impossible for terrain; if it "
                                      "marks missing data, declare it in the header as "
                                      "`NODATA_value {:.6g}`",
                                      file.string(), height, height));
        }
    }
}

} // namespace

HeightGrid read_height_grid(const std::filesystem::path& file, std::optional<double> substitute)
{
    constexpr std::uintmax_t largest = std::uintmax_t(4) << 30;
    const std::string text = bytes_of_file(file, largest);
    const double none = substitute.value_or(std::nan(""));
    HeightGrid grid;
    if (is_raster(text)) {
        grid = read_raster(file, none);
    } else if (is_point_text(text)) {
        grid = grid_of_points(file, text, none);
    } else {
        grid = read_ascii_grid(file, text, none);
    }
    forget_missing(file, none, grid);
    return grid;
}

} // namespace hyoryu
