// SPDX-License-Identifier: MIT
// Series of levels and velocities of open sides: their course in time and along the window, and
// their files.
#include "hyoryu/scene/open_settings.hpp"

#include "../../src/scene/case/series.hpp"
#include "dice.hpp"
#include "own_folder.hpp"
#include "test_case_file_support.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_open_series {
namespace {

// Bilinear between times and stations, held outside, against the formula of the plane through the
// corners.
TEST(OpenSettings, SeriesAreLinearInTimeAndAlongTheWindow)
{
    Dice dice(3);
    for (int n = 0; n < 50; ++n) {
        const double a = dice.between(-1, 1);
        const double b = dice.between(-1, 1);
        OpenSettings open;
        for (const double at : {1.0, 4.0}) {
            OpenSeries series{.at = at};
            for (double t = 0; t < 6; t += dice.between(0.2, 2)) {
                series.times.push_back(t);
                series.levels.push_back(2 + a * at + b * t);
            }
            open.series.push_back(series);
        }
        const double last = std::min(open.series[0].times.back(), open.series[1].times.back());
        const double y = dice.between(0, 5);
        const double t = dice.between(-1, last);
        const AskedFlow asked = asked_at(open, y, t, {}, 3);
        const double expected = 2 + a * std::clamp(y, 1.0, 4.0) + b * std::max(t, 0.0);
        EXPECT_NEAR(asked.level.value(), expected, 1e-12);
        EXPECT_FALSE(asked.velocity || asked.discharge || asked.free);
    }
}

class SeriesFiles : public testing::Test {
protected:
    SeriesSource source(const std::string& text) const
    {
        return {.file = folder_.put("series.txt", text)};
    }

    OwnFolder folder_;
};

// hu and hv of a gauge, turned to the direction of the window: by the direction of the current and
// the angle between the two, as a compass tells them.
TEST_F(SeriesFiles, GaugesOfGeoClawAreTurnedToTheWindow)
{
    Dice dice(8);
    for (int n = 0; n < 40; ++n) {
        const double speed = dice.between(0, 3);
        const double course = dice.between(0, 360); // of the current, clockwise from north
        const double window = dice.between(0, 360);
        const double h = dice.between(0.1, 4);
        const double rad = std::numbers::pi / 180;
        SeriesSource from = source(fmt::format(
            "# gauge_id= 7\n# columns: level time h hu hv eta\n 1 {} {} {} {} {}\n 1 {} 0 0 0 0\n",
            100.0, h, h * speed * std::sin(course * rad), h * speed * std::cos(course * rad), 0.4,
            101.5));
        from.format = SeriesFormat::geoclaw;
        from.azimuth = window * rad;
        from.datum = 0.25;
        from.time_offset = 99;
        from.scale = 2;
        std::vector<std::string> faults;
        const OpenSeries series = read_series(from, faults);
        ASSERT_TRUE(faults.empty()) << faults.front();
        EXPECT_EQ(series.times, (std::vector<double>{1, 2.5}));
        EXPECT_NEAR(series.levels[0], 0.25 + 2 * 0.4, 1e-12);
        EXPECT_NEAR(series.velocities[0], 2 * speed * std::cos((course - window) * rad), 1e-9);
        EXPECT_EQ(series.velocities[1], 0) << "dry";
    }
}

TEST_F(SeriesFiles, TablesTellTheirColumnsByHeaderOrKey)
{
    std::vector<std::string> faults;
    SeriesSource from = source("time [s], level [m], velocity [m/s]\n0, 1, 2\n1, 1.5, 2.5\n");
    OpenSeries series = read_series(from, faults);
    EXPECT_EQ(series.levels, (std::vector<double>{1, 1.5}));
    EXPECT_EQ(series.velocities, (std::vector<double>{2, 2.5}));
    from = source("7;0;3\n7;1;4\n");
    from.columns = {"-", "time", "discharge"};
    series = read_series(from, faults);
    EXPECT_EQ(series.times, (std::vector<double>{0, 1}));
    EXPECT_EQ(series.discharges, (std::vector<double>{3, 4}));
    EXPECT_TRUE(series.levels.empty() && series.velocities.empty());
    EXPECT_TRUE(faults.empty());
}

// A spreadsheet begins a CSV file with a byte order mark.
TEST_F(SeriesFiles, AByteOrderMarkIsPassedOver)
{
    for (const std::string text : {"time,level\n0,1\n2,3\n", "0,1\n2,3\n", "# me\n0 1\n2 3\n"}) {
        std::vector<std::string> faults;
        const OpenSeries series = read_series(source("\xef\xbb\xbf" + text), faults);
        EXPECT_TRUE(faults.empty()) << faults.front();
        EXPECT_EQ(series.levels, (std::vector<double>{1, 3})) << text;
    }
}

TEST_F(SeriesFiles, FaultsNameTheLine)
{
    const std::vector<std::pair<std::string, std::string>> files{
        {"0 1 2\n1 1 2\n1 1 2\n", ":3: time 1 is not later than 1"},
        {"0 1 2\n1 one 2\n", ":2: expected a number, found \"one\""},
        {"0 1 2\n1 2\n", ":2: expected 3 numbers, found 2"},
        {"time,height\n0,1\n", ":1: the header has an unknown column \"height\""},
        {"time [min],level\n0,1\n", ":1: the header gives the unit \"min\""},
        {"level,velocity\n0,1\n", ":1: has no time column"},
        {"# nothing\n", "has no row of numbers"},
        {"0;1,0\n4;1,5\n", ":1: commas and semicolons in one line"},
    };
    for (const auto& [text, words] : files) {
        std::vector<std::string> faults;
        read_series(source(text), faults);
        ASSERT_FALSE(faults.empty()) << text;
        EXPECT_NE(faults.front().find(words), std::string::npos) << faults.front();
    }
}

} // namespace
} // namespace hyoryu::test_open_series
