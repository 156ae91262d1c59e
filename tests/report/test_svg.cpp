// SPDX-License-Identifier: MIT
// Scales and ticks against numbers worked out by hand, and what must survive thinning.
#include "dice.hpp"
#include "hyoryu/report/html.hpp"
#include "hyoryu/report/plan_view.hpp"
#include "hyoryu/report/svg.hpp"
#include "hyoryu/report/table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hyoryu::test_svg {
namespace {

constexpr double nan_ = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

TEST(Ticks, AreTheFewestRoundNumbersThatFit)
{
    EXPECT_DOUBLE_EQ(tick_step({0, 2.6}, 6), 0.5);
    EXPECT_DOUBLE_EQ(tick_step({0, 1}, 6), 0.2);
    EXPECT_DOUBLE_EQ(tick_step({0, 1}, 11), 0.1);
    EXPECT_DOUBLE_EQ(tick_step({-0.007, 0.003}, 6), 0.002);
    EXPECT_DOUBLE_EQ(tick_step({0, 9e5}, 3), 5e5);
}

TEST(Ticks, StandOnMultiplesWithinTheRange)
{
    const std::vector<double> found = ticks({-0.3, 0.45}, 0.2);
    ASSERT_EQ(found.size(), 4U);
    EXPECT_DOUBLE_EQ(found[0], -0.2);
    EXPECT_EQ(found[1], 0.0);
    EXPECT_FALSE(std::signbit(found[1]));
    EXPECT_DOUBLE_EQ(found[3], 0.4);
    // 0.3 is not three times 0.1 in binary numbers, and still has its tick.
    EXPECT_EQ(ticks({0, 0.3}, 0.1).size(), 4U);
}

TEST(Ticks, AreLabelledWithTheDecimalsOfTheStep)
{
    EXPECT_EQ(tick_label(0.6, 0.2, 0), "0.6");
    EXPECT_EQ(tick_label(3, 1, 0), "3");
    EXPECT_EQ(tick_label(0.05, 0.01, 0), "0.05");
    EXPECT_EQ(tick_label(2.5e6, 5e5, 6), "2.5");
    EXPECT_EQ(tick_label(-2e-16, 1e-16, -18), "-200");
}

TEST(Ticks, AnAxisWritesItsPowerOfTenOnce)
{
    EXPECT_EQ(axis_exponent({0, 2.6}), 0);
    EXPECT_EQ(axis_exponent({-99999, 5}), 0);
    EXPECT_EQ(axis_exponent({0, 1e5}), 3);
    EXPECT_EQ(axis_exponent({0, 2.5e6}), 6);
    EXPECT_EQ(axis_exponent({-5e-4, 0}), -6);
}

TEST(Scales, MapLinearlyAlsoUpsideDown)
{
    const Scale y{{-1, 3}, 220, 20};
    EXPECT_DOUBLE_EQ(y(-1), 220);
    EXPECT_DOUBLE_EQ(y(3), 20);
    EXPECT_DOUBLE_EQ(y(0), 170);
}

TEST(Scales, RangesLeaveOutWhatIsNoNumberAndAlwaysHaveAWidth)
{
    const std::vector<double> some{nan_, 2, -1}, one{7}, none{nan_}, zero{0, 0};
    const std::vector<double> noise{1, 1 + 1e-15};
    const auto range = [](const std::vector<double>& values) {
        const std::vector<double>* columns[] = {&values};
        const Range found = range_of(columns);
        return std::array{found.low, found.high};
    };
    EXPECT_EQ(range(some), (std::array{-1.0, 2.0}));
    EXPECT_EQ(range(one), (std::array{3.5, 10.5}));
    EXPECT_EQ(range(none), (std::array{0.0, 1.0}));
    EXPECT_EQ(range(zero), (std::array{-1.0, 1.0}));
    EXPECT_NEAR(range(noise)[0], 0.5, 1e-12); // treated as one number
}

TEST(RowsToDraw, KeepFirstLastAndBothExtremesOfEachPart)
{
    std::vector<double> x, y;
    for (int k = 0; k < 1000; ++k) {
        x.push_back(k);
        y.push_back(0);
    }
    y[333] = 5;
    y[777] = -5;
    const std::vector<std::size_t> rows = rows_to_draw(x, y, {0, 999}, 10);
    EXPECT_LE(rows.size(), 44U); // 10 parts and the end of the range, four rows each
    EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
    for (const std::size_t kept : {0, 333, 777, 999}) {
        EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), kept)) << kept;
    }
}

TEST(RowsToDraw, KeepAllOfAFewAndTheGaps)
{
    const std::vector<double> x{0, 1, 2, 3}, y{1, nan_, 2, 1};
    EXPECT_EQ(rows_to_draw(x, y, {0, 3}, 100), (std::vector<std::size_t>{0, 1, 2, 3}));
    EXPECT_TRUE(rows_to_draw({}, {}, {0, 1}, 10).empty());
    // Within one part a gap is kept beside the numbers around it.
    const std::vector<std::size_t> rows = rows_to_draw(x, y, {0, 300}, 1);
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 1U));
}

TEST(Charts, DrawALineAtTheRightPlaces)
{
    const Chart chart{.title = "a<b",
                      .x_axis = "time [s]",
                      .y_axis = "z [m]",
                      .lines = {{"", {0, 1, 2}, {0, 10, 5}}},
                      .width = 276,
                      .height = 260};
    const std::string svg = svg_chart(chart);
    // The area is 64..264 by 22..222; y runs from -0.5 to 10.5.
    EXPECT_NE(svg.find("d=\"M64.0 212.9L164.0 31.1L264.0 122.0\""), std::string::npos) << svg;
    EXPECT_NE(svg.find("a&lt;b"), std::string::npos);
    EXPECT_EQ(svg.find("a<b"), std::string::npos);
}

TEST(Charts, BreakTheLineWhereThereIsNoNumber)
{
    const Chart chart{.lines = {{"", {0, 1, 2, 3, 4}, {1, 2, nan_, 2, 1}}}};
    const std::string svg = svg_chart(chart);
    const std::string d = svg.substr(svg.rfind(" d=\"M"));
    EXPECT_EQ(count(d, "M"), 2U) << d;
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

/// The numbers of all paths of a class, two a place; "h0" of a dot is none.
std::vector<std::array<double, 2>> places_in(const std::string& svg, const std::string& kind)
{
    std::vector<std::array<double, 2>> places;
    const std::string head = "class=\"" + kind + "\"";
    for (auto at = svg.find(head); at != std::string::npos; at = svg.find(head, at + 1)) {
        const std::size_t begin = svg.find(" d=\"", at) + 4;
        const std::string d = svg.substr(begin, svg.find('"', begin) - begin);
        for (auto pen = d.find_first_of("ML"); pen != std::string::npos;
             pen = d.find_first_of("ML", pen + 1)) {
            std::array<double, 2> place{};
            EXPECT_EQ(std::sscanf(d.c_str() + pen + 1, "%lf %lf", &place[0], &place[1]), 2);
            places.push_back(place);
        }
    }
    return places;
}

/// The area of this chart is 64..364 by 22..222.
Chart framed(ChartLine line, const Range& x, const Range& y)
{
    return {.lines = {std::move(line)}, .width = 376, .height = 260, .x_range = x, .y_range = y};
}

TEST(Charts, CutLinesAtTheEdgesOfTheirRanges)
{
    Dice dice(7);
    for (int chart = 0; chart < 100; ++chart) {
        ChartLine line;
        for (int k = 0; k < 20; ++k) {
            line.x.push_back(k);
            line.y.push_back(dice.between(-30, 30));
        }
        const double low = dice.between(-20, 0), left = dice.between(0, 9);
        const Range x{left, left + 7}, y{low, low + 20};
        for (const auto& [u, v] : places_in(svg_chart(framed(line, x, y)), "l")) {
            EXPECT_GE(u, 63.8);
            EXPECT_LE(u, 364.2);
            EXPECT_GE(v, 21.8);
            EXPECT_LE(v, 222.2);
        }
        // A straight line from beyond one edge to beyond the other goes from edge to edge.
        const double slope = dice.between(-1, 1);
        const ChartLine across{
            "", {x.low - 5, x.high + 9}, {y.low + 10 - 5 * slope, y.low + 10 + 16 * slope}};
        const auto ends = places_in(svg_chart(framed(across, x, y)), "l");
        ASSERT_EQ(ends.size(), 2U);
        EXPECT_NEAR(ends[0][0], 64, 0.2);
        EXPECT_NEAR(ends[1][0], 364, 0.2);
        EXPECT_NEAR(ends[0][1], 122, 0.2);
        EXPECT_NEAR(ends[1][1], 122 - 10 * 7 * slope, 0.2);
        const ChartLine above{"", {x.low, x.high}, {y.high + 1, y.high + 2}};
        EXPECT_TRUE(places_in(svg_chart(framed(above, x, y)), "l").empty());
    }
}

TEST(Charts, LogarithmicAxesShowPowersAsStraightLinesAndLeaveOutTheRest)
{
    Dice dice(8);
    for (int chart_ = 0; chart_ < 50; ++chart_) {
        const double power = dice.between(-3, 3);
        ChartLine line{.label = "", .x = {}, .y = {}, .style = ChartLine::Style::marked};
        for (int k = 0; k < 6; ++k) {
            line.x.push_back(std::pow(10, k * dice.between(0.7, 1.0)));
            line.y.push_back(7 * std::pow(line.x.back(), power));
            line.x.push_back(k % 2 == 0 ? -1.0 : 5.0);
            line.y.push_back(k % 2 == 0 ? 5.0 : nan_);
        }
        const Chart chart{.lines = {line}, .axes = Scale::Kind::logarithmic};
        const std::string svg = svg_chart(chart);
        const auto places = places_in(svg, "p");
        ASSERT_EQ(places.size(), 6U);
        const double slope = (places[5][1] - places[0][1]) / (places[5][0] - places[0][0]);
        for (const auto& [u, v] : places) {
            EXPECT_NEAR(v, places[0][1] + slope * (u - places[0][0]), 0.2);
        }
        const auto path = places_in(svg, "l");
        EXPECT_EQ(path, places) << "one line through all that have a logarithm";
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
    }
    const Chart nothing{.lines = {{"", {-1, 0}, {-1, 0}}}, .axes = Scale::Kind::logarithmic};
    EXPECT_TRUE(places_in(svg_chart(nothing), "l").empty());
}

TEST(Ticks, OfALogarithmicScaleLieWithinItAndAreAtMostAFew)
{
    Dice dice(9);
    for (int axis = 0; axis < 200; ++axis) {
        const double low = std::pow(10, dice.between(-9, 9));
        const Scale scale{
            {low, low * std::pow(10, dice.between(0.05, 8))}, 0, 300, Scale::Kind::logarithmic};
        const std::vector<Tick> marks = ticks_of(scale, 6);
        EXPECT_GE(marks.size(), 2U) << scale.from.low << " to " << scale.from.high;
        EXPECT_LE(marks.size(), 6U);
        for (const Tick& tick : marks) {
            EXPECT_GE(scale(tick.value), -1e-6);
            EXPECT_LE(scale(tick.value), 300 + 1e-6);
            EXPECT_NEAR(std::stod(tick.label), tick.value, 1e-5 * tick.value);
        }
    }
}

TEST(Charts, StylesAreLinesDotsOrBoth)
{
    using Style = ChartLine::Style;
    const auto drawn = [](Style style, const char* kind) {
        const ChartLine line{"", {0, 1, 2}, {1, 2, 1}, style};
        return places_in(svg_chart({.lines = {line}}), kind).size();
    };
    for (const Style style : {Style::varied, Style::line, Style::dashed, Style::theory}) {
        EXPECT_EQ(drawn(style, "l"), 3U);
        EXPECT_EQ(drawn(style, "p"), 0U);
    }
    EXPECT_EQ(drawn(Style::points, "l"), 0U);
    EXPECT_EQ(drawn(Style::points, "p"), 3U);
    EXPECT_EQ(drawn(Style::marked, "l"), 3U);
    EXPECT_EQ(drawn(Style::marked, "p"), 3U);
    // Theory is black and takes no colour from the line after it.
    const ChartLine theory{"", {0, 1}, {1, 2}, Style::theory},
        line{"", {0, 1}, {1, 2}, Style::line};
    const std::string svg = svg_chart({.lines = {theory, line}});
    EXPECT_EQ(count(svg, "stroke=\"#000000\""), 1U);
    EXPECT_EQ(count(svg, "stroke=\"#0072b2\""), 1U);
}

TEST(Charts, EightLinesHaveColoursOfTheirOwn)
{
    const std::string theory = "#000000";
    for (std::size_t lines = 2; lines <= 8; ++lines) {
        const std::vector<ChartLine> all(lines, {"", {0, 1}, {1, 2}, ChartLine::Style::line});
        const std::string svg = svg_chart({.lines = all});
        std::set<std::string> colours;
        const std::string before = "class=\"l\" stroke=\"";
        for (std::size_t at = svg.find(before); at != std::string::npos;
             at = svg.find(before, at + 1)) {
            colours.insert(svg.substr(at + before.size(), theory.size()));
        }
        EXPECT_EQ(colours.size(), lines);
        EXPECT_FALSE(colours.contains(theory));
    }
}

TEST(Charts, StandSideBySideInAFigure)
{
    const Chart chart{.title = "left & right", .lines = {{"", {0, 1}, {0, 1}}}, .width = 300};
    const std::string svg = svg_figure("three <charts>", {chart, chart, chart});
    EXPECT_NE(svg.find("viewBox=\"0 0 900 284\""), std::string::npos);
    EXPECT_EQ(count(svg, "left &amp; right"), 3U);
    EXPECT_EQ(count(svg, "three &lt;charts&gt;"), 2U); // to be seen, and to be read out
    for (const char* place : {"translate(0 24)", "translate(300 24)", "translate(600 24)"}) {
        EXPECT_EQ(count(svg, place), 1U);
    }
    EXPECT_EQ(count(svg, "<svg"), 1U);
}

TEST(Html, TextIsEscaped)
{
    EXPECT_EQ(escaped("<a href=\"x\">'&'</a>"),
              "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
    EXPECT_EQ(escaped("漂流"), "漂流");
    EXPECT_EQ(escaped(std::string("a\x01z\n")), "a\xEF\xBF\xBDz\n");
    const TextTable table{.heads = {{"<h>"}}, .rows = {{"a&b"}}};
    EXPECT_NE(html_table(table).find("<th>&lt;h&gt;</th>"), std::string::npos);
    EXPECT_NE(html_table(table).find("<td>a&amp;b</td>"), std::string::npos);
}

TEST(Tables, HoldEveryCellOnceInEachForm)
{
    using Align = TextTable::Align;
    Dice dice(3);
    for (int trial = 0; trial < 50; ++trial) {
        TextTable table{{{"name"}, {"a | b", Align::right}}, {}};
        for (int row = dice.below(5); row >= 0; --row) {
            table.rows.push_back({std::string(static_cast<std::size_t>(dice.below(20)), 'x'),
                                  dice.chance(0.5) ? "1 | 2" : "<3>\n4"});
        }
        const std::size_t rows = table.rows.size();
        const std::string html = html_table(table), markdown = markdown_table(table),
                          terminal = terminal_table(table);
        EXPECT_EQ(count(html, "<tr>"), rows + 1);
        EXPECT_EQ(count(html, " class=\"n\""), rows + 1);
        EXPECT_EQ(html.find("<3>"), std::string::npos);
        EXPECT_EQ(count(markdown, "\n"), rows + 2);
        EXPECT_EQ(count(markdown, "|") - count(markdown, "\\|"), 3 * (rows + 2));
        EXPECT_TRUE(markdown.starts_with("| name | a \\| b |\n| --- | ---: |\n"));
        std::size_t widest = 4;
        for (const auto& row : table.rows) {
            widest = std::max(widest, row[0].size());
        }
        EXPECT_EQ(terminal.find("a | b"), widest + 2);
    }
}

/// The box [0, 2] x [0, 1] x [0, 3] with outward triangles.
Surface box()
{
    Surface surface;
    for (int k = 0; k < 8; ++k) {
        for (const float value : {k & 1 ? 2.F : 0.F, k & 2 ? 1.F : 0.F, k & 4 ? 3.F : 0.F}) {
            surface.points.push_back(value);
        }
    }
    surface.triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return surface;
}

TEST(PlanView, ABoxShowsItsRectangleAndNoDiagonal)
{
    const std::vector<Segment> above{{0, 0, 0, 1}, {0, 0, 2, 0}, {0, 1, 2, 1}, {2, 0, 2, 1}};
    const std::vector<Segment> aside{{0, 0, 0, 3}, {0, 0, 2, 0}, {0, 3, 2, 3}, {2, 0, 2, 3}};
    EXPECT_EQ(outline(box(), View::xy), above);
    EXPECT_EQ(outline(box(), View::xz), aside);
}

// E12: the patches of points on a lattice are the cells that hold any of them, each once.
TEST(PlanView, E12WaterCoversTheCellsOfItsParticles)
{
    Dice dice(12);
    for (int scene = 0; scene < 50; ++scene) {
        const double dp = dice.between(0.01, 0.1);
        const View view = dice.chance(0.5) ? View::xy : View::xz;
        std::vector<float> points;
        std::set<std::pair<int, int>> cells{{0, 0}};
        const auto add = [&](int i, int j) {
            const double up = dp * (j + dice.between(0.001, 0.4)), other = dice.between(0, 1);
            points.push_back(static_cast<float>(dp * (i + dice.between(0.001, 0.4))));
            points.push_back(static_cast<float>(view == View::xy ? up : other));
            points.push_back(static_cast<float>(view == View::xy ? other : up));
        };
        points = {0, 0, 0}; // the corner that the cells are counted from
        for (int k = 0; k < 200; ++k) {
            const int i = dice.below(60), j = dice.below(40);
            cells.insert({i, j});
            add(i, j);
        }
        double area = 0;
        for (const WaterPatch& patch : water_patches(points, dp, view, {0, 1})) {
            area += patch.width * patch.height;
            EXPECT_GE(patch.shade, 0);
            EXPECT_LE(patch.shade, 1);
        }
        EXPECT_NEAR(area, static_cast<double>(cells.size()) * dp * dp, 1e-9 * area);
    }
    EXPECT_TRUE(water_patches({}, 0.1, View::xy, {0, 1}).empty());
}

TEST(PlanView, BothAxesHaveOneScale)
{
    // Room for 780 pixels across: 10 m of width and 3 % at both ends leave 73.6 pixels a metre.
    const std::vector<Trajectory> trajectories{{"crate & co", {0, 10}, {0, 5}}};
    const std::string svg = svg_plan_view({}, trajectories, View::xy);
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    const std::size_t at = svg.find("d=\"M", svg.find("class=\"l\""));
    ASSERT_EQ(std::sscanf(svg.c_str() + at, "d=\"M%lf %lfL%lf %lf", &x0, &y0, &x1, &y1), 4);
    EXPECT_NEAR((x1 - x0) / 10, 780 / 10.6, 0.02); // places are written to a tenth of a pixel
    EXPECT_NEAR((y0 - y1) / 5, 780 / 10.6, 0.04);
    EXPECT_NE(svg.find("crate &amp; co"), std::string::npos);
}

} // namespace
} // namespace hyoryu::test_svg
