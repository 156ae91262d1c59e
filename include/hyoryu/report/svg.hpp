// SPDX-License-Identifier: MIT
// Charts as SVG: inline on a page, or side by side in a file of their own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyoryu {

struct Range {
    double low = 0;
    double high = 0;
    double width() const { return high - low; }
};

/// The range of all finite numbers, widened where they are all one so that it has a width.
/// Without a finite number: 0 to 1.
Range range_of(std::span<const std::vector<double>* const> columns);
/// The range with `share` of its width more at both ends.
Range padded(const Range& range, double share);

/// The smallest of 1, 2, 5 x 10^n that puts at most `at_most` (>= 2) ticks into the range.
double tick_step(const Range& range, int at_most);
/// The multiples of the step within the range, round-off at its ends allowed for.
std::vector<double> ticks(const Range& range, double step);
/// The value in units of 10^exponent, with as many decimals as the step needs.
std::string tick_label(double value, double step, int exponent);
/// The power of ten, a multiple of three, that an axis writes once instead of at every tick; 0 for
/// numbers that read well as they are, from a thousandth to 100 000.
int axis_exponent(const Range& range);

/// From numbers to places in the picture; `at_low` may be above `at_high`, as pixels count
/// downward. Numbers <= 0 have no finite place on a logarithmic scale.
struct Scale {
    enum class Kind { linear, logarithmic };
    Range from;        // positive for a logarithmic scale
    double at_low = 0; // [pixels]
    double at_high = 0;
    Kind kind = Kind::linear;
    double operator()(double value) const;
};

/// The marks of an axis.
struct Tick {
    double value = 0;
    std::string label;
};
/// At most `at_most` (>= 4) round numbers; of a logarithmic scale powers of ten, with round numbers
/// between them where there is room.
std::vector<Tick> ticks_of(const Scale& scale, int at_most);

/// The rows that draw the same picture as all rows: first, lowest, highest and last of each of
/// `bins` equal parts of the abscissa, so that no peak is lost; all rows if they are few. Rows
/// without a number are kept once a part, as gaps.
std::vector<std::size_t> rows_to_draw(const std::vector<double>& x, const std::vector<double>& y,
                                      const Range& range, std::size_t bins);

/// The rectangle that the axes enclose [pixels].
struct PlotArea {
    double left = 0, right = 0, top = 0, bottom = 0;
};
/// Box, grid, tick labels and axis titles.
std::string svg_axes(const PlotArea& area, const Scale& x, const Scale& y,
                     const std::string& x_title, const std::string& y_title);

/// Colour and dashes of the k-th line: they differ in print without colour as well.
std::string svg_stroke(std::size_t k);

/// The begin of a picture of that size [pixels]; `label` is for readers who cannot see it.
std::string svg_head(double width, double height, const std::string& label);
/// The style sheet of the pictures of a page.
extern const std::string_view chart_style;

struct ChartLine {
    enum class Style {
        varied, // dashes tell the lines apart, colours as well
        line,
        dashed,
        points,
        marked, // a line with a point at each value
        theory  // black; no colour is used up
    };
    std::string label; // in the legend; empty: not there
    std::vector<double> x, y;
    Style style = Style::varied;
};

struct Chart {
    std::string title, x_axis, y_axis; // axes with their unit: "time [s]"
    std::vector<ChartLine> lines;
    double width = 420; // [pixels]
    double height = 260;
    Scale::Kind axes = Scale::Kind::linear;          // of both
    std::optional<Range> x_range = {}, y_range = {}; // none: those of the lines
};

/// Lines on axes, cut off at the edges of the ranges. NaN is a gap; logarithmic axes leave out what
/// is not positive.
std::string svg_chart(const Chart& chart);

/// A file with a picture, which needs no other file.
struct SvgFile {
    std::string name;
    std::string text;
};
/// Charts side by side below a title, on white.
std::string svg_figure(const std::string& title, const std::vector<Chart>& charts);

} // namespace hyoryu
