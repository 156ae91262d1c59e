// SPDX-License-Identifier: MIT
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/svg.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace hyoryu {

namespace {

/// "momentum [kg m/s]" with the power of ten that the labels leave out.
std::string axis_title(const std::string& title, int exponent)
{
    return exponent == 0 ? title : fmt::format("{}, in 10^{}", title, exponent);
}

std::string x_ticks(const PlotArea& area, const Scale& x)
{
    const double step = tick_step(x.from, 7);
    const int exponent = axis_exponent(x.from);
    std::string text;
    for (const double value : ticks(x.from, step)) {
        text += fmt::format("<path class=\"g\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/>"
                            "<text x=\"{0:.1f}\" y=\"{3:.1f}\" text-anchor=\"middle\">{4}</text>\n",
                            x(value), area.top, area.bottom, area.bottom + 14,
                            tick_label(value, step, exponent));
    }
    return text;
}

std::string y_ticks(const PlotArea& area, const Scale& y)
{
    const double step = tick_step(y.from, 6);
    const int exponent = axis_exponent(y.from);
    std::string text;
    for (const double value : ticks(y.from, step)) {
        text += fmt::format("<path class=\"g\" d=\"M{1:.1f} {0:.1f}H{2:.1f}\"/>"
                            "<text x=\"{3:.1f}\" y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
                            y(value), area.left, area.right, area.left - 5, y(value) + 4,
                            tick_label(value, step, exponent));
    }
    return text;
}

std::string path_of(const ChartLine& line, const Scale& x, const Scale& y, std::size_t k)
{
    const auto bins = static_cast<std::size_t>(x.at_high - x.at_low);
    std::string d;
    char next = 'M';
    for (const std::size_t row : rows_to_draw(line.x, line.y, x.from, bins)) {
        if (!std::isfinite(line.x[row]) || !std::isfinite(line.y[row])) {
            next = 'M';
            continue;
        }
        d += fmt::format("{}{:.1f} {:.1f}", next, x(line.x[row]), y(line.y[row]));
        next = 'L';
    }
    return d.empty() ? std::string()
                     : fmt::format("<path class=\"l\" {} d=\"{}\"/>\n", svg_stroke(k), d);
}

/// One entry a line above the area, as many abreast as fit.
constexpr double entry_width = 115;
constexpr double entry_height = 16;

std::size_t entries_abreast(const Chart& chart)
{
    return std::max<std::size_t>(1, static_cast<std::size_t>((chart.width - 70) / entry_width));
}

std::size_t legend_rows(const Chart& chart)
{
    std::size_t entries = 0;
    for (const ChartLine& line : chart.lines) {
        entries += line.label.empty() ? 0 : 1;
    }
    return (entries + entries_abreast(chart) - 1) / entries_abreast(chart);
}

std::string legend(const Chart& chart, const PlotArea& area)
{
    std::string text;
    std::size_t entry = 0;
    for (std::size_t k = 0; k < chart.lines.size(); ++k) {
        if (chart.lines[k].label.empty()) {
            continue;
        }
        const double x =
            area.left + entry_width * static_cast<double>(entry % entries_abreast(chart));
        const double y = 28 + entry_height * static_cast<double>(entry / entries_abreast(chart));
        text += fmt::format("<path class=\"l\" {} d=\"M{:.1f} {:.1f}h22\"/>"
                            "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                            svg_stroke(k), x, y, x + 27, y + 4, escaped(chart.lines[k].label));
        ++entry;
    }
    return text;
}

} // namespace

std::string svg_stroke(std::size_t k)
{
    // Okabe and Ito (2008): told apart with every common colour vision.
    constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                 "#e69f00", "#56b4e9", "#000000"};
    constexpr std::array dashes{"", "7 3", "2 2", "9 3 2 3"};
    const std::string_view dash = dashes[k % dashes.size()];
    return dash.empty() ? fmt::format("stroke=\"{}\"", colours[k % colours.size()])
                        : fmt::format("stroke=\"{}\" stroke-dasharray=\"{}\"",
                                      colours[k % colours.size()], dash);
}

std::string svg_axes(const PlotArea& area, const Scale& x, const Scale& y,
                     const std::string& x_title, const std::string& y_title)
{
    const double middle = 0.5 * (area.top + area.bottom);
    const double title_left = area.left - 48;
    return x_ticks(area, x) + y_ticks(area, y) +
           fmt::format("<rect class=\"f\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                       "height=\"{:.1f}\"/>\n",
                       area.left, area.top, area.right - area.left, area.bottom - area.top) +
           fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                       0.5 * (area.left + area.right), area.bottom + 31,
                       escaped(axis_title(x_title, axis_exponent(x.from)))) +
           fmt::format("<text transform=\"translate({:.1f} {:.1f}) rotate(-90)\" "
                       "text-anchor=\"middle\">{}</text>\n",
                       title_left, middle, escaped(axis_title(y_title, axis_exponent(y.from))));
}

std::string svg_chart(const Chart& chart)
{
    std::vector<const std::vector<double>*> xs, ys;
    for (const ChartLine& line : chart.lines) {
        xs.push_back(&line.x);
        ys.push_back(&line.y);
    }
    const PlotArea area{.left = 64,
                        .right = chart.width - 12,
                        .top = 22 + entry_height * static_cast<double>(legend_rows(chart)),
                        .bottom = chart.height - 38};
    const Scale x{range_of(xs), area.left, area.right};
    const Scale y{padded(range_of(ys), 0.05), area.bottom, area.top};
    std::string text =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                    "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" aria-label=\"{2}\">\n"
                    "<text class=\"t\" x=\"{3:.1f}\" y=\"14\">{2}</text>\n",
                    chart.width, chart.height, escaped(chart.title), area.left);
    text += svg_axes(area, x, y, chart.x_axis, chart.y_axis);
    for (std::size_t k = 0; k < chart.lines.size(); ++k) {
        text += path_of(chart.lines[k], x, y, k);
    }
    return text + legend(chart, area) + "</svg>\n";
}

} // namespace hyoryu
