// SPDX-License-Identifier: MIT
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hyoryu {

namespace {

using Style = ChartLine::Style;

// Okabe and Ito (2008), before its black two of the muted scheme of Tol (2021): distinguishable
// with every common colour vision. Nine, since a number that shares no divisor with that of the
// dashes of `svg_stroke` gives the most pairs of both.
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                             "#56b4e9", "#882255", "#999933", "#000000"};

/// "momentum [kg m/s]" with the power of ten that the labels leave out.
std::string axis_title(const std::string& title, const Scale& scale)
{
    const int exponent = scale.kind == Scale::Kind::logarithmic ? 0 : axis_exponent(scale.from);
    return exponent == 0 ? title : fmt::format("{}, in 10^{}", title, exponent);
}

std::string x_ticks(const PlotArea& area, const Scale& x)
{
    std::string text;
    for (const Tick& tick : ticks_of(x, 7)) {
        text += fmt::format("<path class=\"g\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/>"
                            "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4}</text>\n",
                            x(tick.value), area.top, area.bottom, area.bottom + 14, tick.label);
    }
    return text;
}

std::string y_ticks(const PlotArea& area, const Scale& y)
{
    std::string text;
    for (const Tick& tick : ticks_of(y, 6)) {
        text += fmt::format("<path class=\"g\" d=\"M{1:.1f} {0:.1f}H{2:.1f}\"/>"
                            "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
                            y(tick.value), area.left, area.right, area.left - 5, y(tick.value) + 4,
                            tick.label);
    }
    return text;
}

struct Point {
    double x = 0, y = 0; // [pixels]
    bool is_there() const { return std::isfinite(x) && std::isfinite(y); }
};

/// The places of a line, with a place that is not there at each gap.
std::vector<Point> places_of(const ChartLine& line, const Scale& x, const Scale& y)
{
    const bool linear = x.kind == Scale::Kind::linear;
    const std::size_t rows = std::min(line.x.size(), line.y.size());
    const auto bins = linear ? static_cast<std::size_t>(x.at_high - x.at_low) : rows + 1;
    std::vector<Point> places;
    for (const std::size_t row : rows_to_draw(line.x, line.y, x.from, bins)) {
        const Point place{x(line.x[row]), y(line.y[row])};
        if (linear || place.is_there()) {
            places.push_back(place);
        }
    }
    return places;
}

/// The part of the way from `a` to `b` that lies within the area, as shares of the way; the second
/// is less than the first where there is none. Source: Liang and Barsky (1984), A new concept and
/// method for line clipping, ACM Trans. Graph. 3(1), 1-22.
std::array<double, 2> part_within(const PlotArea& area, const Point& a, const Point& b)
{
    constexpr double slack = 0.1; // of round-off at the edges [pixels]
    std::array<double, 2> part{0, 1};
    const auto cut = [&](double start, double way, double low, double high) {
        if (way == 0) {
            part[1] = start < low - slack || start > high + slack ? -1 : part[1];
            return;
        }
        const double enters = (way > 0 ? low - slack - start : high + slack - start) / way;
        const double leaves = (way > 0 ? high + slack - start : low - slack - start) / way;
        part = {std::max(part[0], enters), std::min(part[1], leaves)};
    };
    cut(a.x, b.x - a.x, area.left, area.right);
    cut(a.y, b.y - a.y, area.top, area.bottom);
    return part;
}

std::string path_of(const std::vector<Point>& places, const PlotArea& area)
{
    std::string d;
    bool joined = false; // the pen stands at the begin of the stretch
    for (std::size_t k = 1; k < places.size(); ++k) {
        const Point &a = places[k - 1], &b = places[k];
        const auto [first, last] =
            a.is_there() && b.is_there() ? part_within(area, a, b) : std::array{1.0, 0.0};
        const auto at = [&](char pen, double share) {
            d += fmt::format("{}{:.1f} {:.1f}", pen, a.x + share * (b.x - a.x),
                             a.y + share * (b.y - a.y));
        };
        if (first <= last && (!joined || first > 0)) {
            at('M', first);
        }
        if (first <= last) {
            at('L', last);
        }
        joined = first <= last && last == 1;
    }
    return d;
}

/// A dot is a line of no length with round ends.
std::string dots_of(const std::vector<Point>& places, const PlotArea& area)
{
    std::string d;
    for (const Point& place : places) {
        if (place.is_there() && part_within(area, place, place)[1] > 0) {
            d += fmt::format("M{:.1f} {:.1f}h0", place.x, place.y);
        }
    }
    return d;
}

/// Colour and dashes; `k`: how many lines with a colour come before.
std::string stroke_of(const ChartLine& line, std::size_t k)
{
    if (line.style == Style::varied) {
        return svg_stroke(k);
    }
    return fmt::format("stroke=\"{}\"{}",
                       line.style == Style::theory ? colours.back() : colours[k % colours.size()],
                       line.style == Style::dashed ? " stroke-dasharray=\"7 3\"" : "");
}

/// A line, its dots, or both, by its style.
std::string drawn(const ChartLine& line, std::size_t k, const std::string& path,
                  const std::string& dots)
{
    const auto element = [&](char kind, const std::string& d) {
        return d.empty()
                   ? d
                   : fmt::format("<path class=\"{}\" {} d=\"{}\"/>\n", kind, stroke_of(line, k), d);
    };
    const bool dotted = line.style == Style::points || line.style == Style::marked;
    return (line.style == Style::points ? std::string() : element('l', path)) +
           (dotted ? element('p', dots) : std::string());
}

/// The entries of the legend stand above the area, as many abreast as fit.
struct Legend {
    double entry_width = 115; // [pixels]
    std::size_t abreast = 1, rows = 0;
};
constexpr double entry_height = 16; // [pixels]

Legend legend_of(const Chart& chart)
{
    constexpr double letter = 6; // [pixels]
    Legend legend;
    std::size_t entries = 0;
    for (const ChartLine& line : chart.lines) {
        entries += line.label.empty() ? 0 : 1;
        legend.entry_width =
            std::max(legend.entry_width, 40 + letter * static_cast<double>(line.label.size()));
    }
    legend.abreast =
        std::max<std::size_t>(1, static_cast<std::size_t>((chart.width - 70) / legend.entry_width));
    legend.rows = (entries + legend.abreast - 1) / legend.abreast;
    return legend;
}

/// The range of the numbers that can be drawn, with a margin at both ends.
Range shown_range(const Chart& chart, std::vector<double> ChartLine::*values, double margin)
{
    std::vector<std::vector<double>> drawn;
    for (const ChartLine& line : chart.lines) {
        drawn.push_back(line.*values);
        if (chart.axes == Scale::Kind::logarithmic) {
            std::erase_if(drawn.back(), [](double value) { return !(value > 0); });
        }
    }
    std::vector<const std::vector<double>*> columns;
    for (const std::vector<double>& column : drawn) {
        columns.push_back(&column);
    }
    const Range range = range_of(columns);
    constexpr double wider = 1.5;
    return chart.axes == Scale::Kind::linear ? padded(range, margin)
           : range.low > 0                   ? Range{range.low / wider, range.high * wider}
                                             : Range{0.1, 1};
}

/// Title, axes, lines and legend, without the element around them.
std::string chart_body(const Chart& chart)
{
    const Legend legend = legend_of(chart);
    const PlotArea area{.left = 64,
                        .right = chart.width - 12,
                        .top = 22 + entry_height * static_cast<double>(legend.rows),
                        .bottom = chart.height - 38};
    const Scale x{chart.x_range.value_or(shown_range(chart, &ChartLine::x, 0)), area.left,
                  area.right, chart.axes};
    const Scale y{chart.y_range.value_or(shown_range(chart, &ChartLine::y, 0.05)), area.bottom,
                  area.top, chart.axes};
    std::string text = fmt::format("<text class=\"t\" x=\"{:.1f}\" y=\"14\">{}</text>\n", area.left,
                                   escaped(chart.title)) +
                       svg_axes(area, x, y, chart.x_axis, chart.y_axis);
    std::string entries;
    std::size_t entry = 0, coloured = 0;
    for (const ChartLine& line : chart.lines) {
        const std::vector<Point> places = places_of(line, x, y);
        text += drawn(line, coloured, path_of(places, area), dots_of(places, area));
        if (!line.label.empty()) {
            const double left =
                area.left + legend.entry_width * static_cast<double>(entry % legend.abreast);
            const std::size_t row = entry / legend.abreast;
            const double middle = 28 + entry_height * static_cast<double>(row);
            entries += drawn(line, coloured, fmt::format("M{:.1f} {:.1f}h22", left, middle),
                             fmt::format("M{:.1f} {:.1f}h0", left + 11, middle)) +
                       fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left + 27,
                                   middle + 4, escaped(line.label));
            ++entry;
        }
        coloured += line.style == Style::theory ? 0 : 1;
    }
    return text + entries;
}

} // namespace

const std::string_view chart_style = R"(svg { font: 11px system-ui, sans-serif; }
svg .t { font-size: 12px; font-weight: 600; }
svg .l { fill: none; stroke-width: 1.4; stroke-linejoin: round; }
svg .p { fill: none; stroke-width: 5; stroke-linecap: round; }
svg .r { stroke-dasharray: none; }
svg .g { stroke: #e4e4e4; fill: none; } svg .f { stroke: #555; fill: none; }
svg .w { stroke: #999; stroke-width: 1.4; fill: none; }
)";

std::string svg_stroke(std::size_t k)
{
    constexpr std::array dashes{"", "7 3", "2 2", "9 3 2 3"};
    const std::string_view dash = dashes[k % dashes.size()];
    return dash.empty() ? fmt::format("stroke=\"{}\"", colours[k % colours.size()])
                        : fmt::format("stroke=\"{}\" stroke-dasharray=\"{}\"",
                                      colours[k % colours.size()], dash);
}

std::string svg_head(double width, double height, const std::string& label)
{
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                       "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" aria-label=\"{2}\">\n",
                       width, height, escaped(label));
}

std::string svg_axes(const PlotArea& area, const Scale& x, const Scale& y,
                     const std::string& x_title, const std::string& y_title)
{
    return x_ticks(area, x) + y_ticks(area, y) +
           fmt::format("<rect class=\"f\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                       "height=\"{:.1f}\"/>\n",
                       area.left, area.top, area.right - area.left, area.bottom - area.top) +
           fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       0.5 * (area.left + area.right), area.bottom + 31,
                       escaped(axis_title(x_title, x))) +
           fmt::format("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" "
                       "text-anchor=\"middle\">{}</text>\n",
                       area.left - 48, 0.5 * (area.top + area.bottom),
                       escaped(axis_title(y_title, y)));
}

std::string svg_chart(const Chart& chart)
{
    return svg_head(chart.width, chart.height, chart.title) + chart_body(chart) + "</svg>\n";
}

std::string svg_figure(const std::string& title, const std::vector<Chart>& charts)
{
    constexpr double title_height = 24; // [pixels]
    double width = 0, height = 0;
    std::string body;
    for (const Chart& chart : charts) {
        body += fmt::format("<g transform=\"translate({:.0f} {:.0f})\">\n", width, title_height) +
                chart_body(chart) + "</g>\n";
        width += chart.width;
        height = std::max(height, chart.height + title_height);
    }
    return svg_head(width, height, title) +
           fmt::format("<style>{}</style>\n<rect width=\"{:.0f}\" height=\"{:.0f}\" "
                       "fill=\"#fff\"/>\n<text class=\"t\" x=\"{:.1f}\" y=\"17\" "
                       "text-anchor=\"middle\">{}</text>\n",
                       chart_style, width, height, 0.5 * width, escaped(title)) +
           body + "</svg>\n";
}

} // namespace hyoryu
