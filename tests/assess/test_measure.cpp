// SPDX-License-Identifier: MIT
// Numbers taken from tables that were written by hand.
#include "hyoryu/assess/measure.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "io/results_fixture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>

namespace hyoryu::test_measure {
namespace {

using test_help::put_text_into;

class Measures : public test_help::ResultsTest {
protected:
    void SetUp() override
    {
        ResultsTest::SetUp();
        put_text_into(folder / "bodies.csv",
                      "# s,-,m\ntime,body,x\n0,a,0\n0,b,7\n1,a,3\n1,b,7\n2,a,4\n2,b,7\n"
                      "3,a,3\n3,b,7\n4,a,1\n4,b,7\n5,a,2\n5,b,9\n");
        put_text_into(folder / "summary.json", R"({"steps": 500, "contact": {"impacts": 12}})");
        put_text_into(folder / "reference.csv",
                      "time,case,x\n0.5,one,1.5\n1.5,one,3.25\n1.5,two,100\n");
    }

    Measured of_a(Measure measure_, int index = 1, const std::string& time = "",
                  const std::string& value = "x") const
    {
        const Quantity quantity{.series = series(value),
                                .measure = measure_,
                                .index = index,
                                .time = time,
                                .level = time};
        RunFiles files(folder, folder);
        return measure(quantity, {}, samples(quantity.series, {}, files));
    }

    static Series series(const std::string& value)
    {
        return {.file = "bodies", .where = {{"body", "a"}}, .filter = "", .value = value};
    }
};

TEST_F(Measures, OfWholeSeries)
{
    EXPECT_EQ(of_a(Measure::first).value, 0);
    EXPECT_EQ(of_a(Measure::last).value, 2);
    EXPECT_EQ(of_a(Measure::min).value, 0);
    EXPECT_EQ(of_a(Measure::max).value, 4);
    EXPECT_EQ(of_a(Measure::range).value, 4);
    EXPECT_EQ(of_a(Measure::drift).value, 2);
    EXPECT_EQ(of_a(Measure::count).value, 6);
    EXPECT_EQ(of_a(Measure::sum).value, 13);
    EXPECT_DOUBLE_EQ(of_a(Measure::mean).value, 13.0 / 6);
    EXPECT_EQ(of_a(Measure::gain).value, 4); // from 0 up to 4; from 1 up to 2 is less
    EXPECT_EQ(of_a(Measure::growth, 1, "", "x + 2").value, 3); // 6 over 2
}

TEST_F(Measures, AtATimeLinearBetweenRowsAndNowhereOutside)
{
    EXPECT_DOUBLE_EQ(of_a(Measure::at, 1, "0.5").value, 1.5);
    EXPECT_EQ(of_a(Measure::at, 1, "2").value, 4);
    EXPECT_TRUE(std::isnan(of_a(Measure::at, 1, "5.1").value));
    EXPECT_NE(of_a(Measure::at, 1, "5.1").why.find("0 to 5 s"), std::string::npos);
}

TEST_F(Measures, PeaksLieOnTheParabolaThroughThreeRows)
{
    // 3, 4, 3 at 1, 2, 3: the parabola 4 - (t - 2)^2.
    EXPECT_DOUBLE_EQ(of_a(Measure::peak).value, 4);
    EXPECT_DOUBLE_EQ(of_a(Measure::peak_time).value, 2);
    // 3, 1, 2 at 3, 4, 5: 1 + s^2 3/2 - s/2, lowest at s = 1/6.
    EXPECT_DOUBLE_EQ(of_a(Measure::trough).value, 1 + 1.5 / 36 - 0.5 / 6);
    EXPECT_NE(of_a(Measure::peak, 2).why.find("peak number 2"), std::string::npos);
}

TEST_F(Measures, CrossingsAndRowsAreCounted)
{
    EXPECT_DOUBLE_EQ(of_a(Measure::crossing, 1, "1.5").value, 0.5);
    EXPECT_DOUBLE_EQ(of_a(Measure::crossing, 2, "1.5").value, 3.75);
    EXPECT_EQ(of_a(Measure::row, 3).value, 4);
    EXPECT_TRUE(std::isnan(of_a(Measure::row, 7).value));
    EXPECT_TRUE(std::isnan(of_a(Measure::crossing, 1, "50").value));
}

TEST_F(Measures, RowsAreChosenByCellsByExpressionsAndByTime)
{
    RunFiles files(folder, folder);
    const Series chosen{.where = {{"body", "a"}}, .filter = "x > 2.5", .value = "x"};
    EXPECT_EQ(samples(chosen, {}, files).t, (std::vector<double>{1, 2, 3}));
    const Quantity late{
        .series = series("x"), .measure = Measure::max, .from = "2.5", .until = "4"};
    EXPECT_EQ(measure(late, {}, samples(late.series, {}, files)).value, 3);
    EXPECT_THROW(samples({.where = {{"bdy", "a"}}, .value = "x"}, {}, files), FormulaError);
}

TEST_F(Measures, TheSummaryIsATableOfOneRow)
{
    RunFiles files(folder, folder);
    const Series impacts{.file = "summary", .value = "contact.impacts/steps"};
    EXPECT_DOUBLE_EQ(samples(impacts, {}, files).values.at(0), 0.024);
}

TEST_F(Measures, ErrorsFromExpressionsAndFromReferences)
{
    RunFiles files(folder, folder);
    Quantity quantity{.series = series("x"), .measure = Measure::largest_error, .until = "3"};
    EXPECT_DOUBLE_EQ(error_from(quantity, "3", {}, files).value, 3); // at t = 0
    quantity.measure = Measure::rms_error;
    EXPECT_DOUBLE_EQ(error_from(quantity, "3", {}, files).value, std::sqrt(10.0 / 4));
    const Series reference{.file = "reference.csv", .where = {{"case", "one"}}, .value = "x"};
    // At 0.5 the run is 1.5, at 1.5 it is 3.5.
    EXPECT_DOUBLE_EQ(error_from(quantity, samples(reference, {}, files), {}, files).value,
                     std::sqrt(0.0625 / 2));
    const Samples timeless{{0, 0}, {1, 2}}; // the times of a file that has no column of them
    EXPECT_NE(error_from(quantity, timeless, {}, files).why.find("column `time`"),
              std::string::npos);
}

TEST_F(Measures, IntegralIsThatOfTheTrapezoids)
{
    EXPECT_DOUBLE_EQ(of_a(Measure::integral).value, 0 + 3 + 4 + 3 + 1 + 2.0 / 2);
}

// exp(-0.3 t) sin(2 pi t/1.7), every 10 ms.
TEST_F(Measures, PeriodAndDecayOfAnOscillation)
{
    std::string text = "time,x\n";
    for (int k = 0; k < 1000; ++k) {
        const double t = 0.01 * k;
        text += fmt::format("{},{}\n", t,
                            2 + std::exp(-0.3 * t) * std::sin(2 * 3.14159265358979 * t / 1.7));
    }
    put_text_into(folder / "wave.csv", text);
    RunFiles files(folder, folder);
    Quantity quantity{.series = {.file = "wave.csv", .value = "x"},
                      .measure = Measure::period,
                      .level = "2",
                      .from = "0.1"};
    const Samples wave = samples(quantity.series, {}, files);
    EXPECT_NEAR(measure(quantity, {}, wave).value, 1.7, 1e-5); // lines between the rows
    quantity.measure = Measure::decay;
    EXPECT_NEAR(measure(quantity, {}, wave).value, 0.3, 1e-3);
    quantity.until = "0.5";
    EXPECT_NE(measure(quantity, {}, wave).why, "");
}

// Waves with a noise of a tenth of their height: its largest values make the range 10 to 20 % too
// large, and count by the square here.
TEST_F(Measures, HeightOfRegularWaves)
{
    for (const auto& [height, steps] : {std::pair(0.05, 200), {2.0, 17}, {0.3, 1000}}) {
        Samples wave;
        std::mt19937 random(7);
        std::uniform_real_distribution<double> part(-0.05, 0.05);
        for (int k = 0; k < 4 * steps; ++k) {
            const double noise = height * part(random);
            wave.t.push_back(k);
            wave.values.push_back(
                3 + height / 2 * std::sin(2 * 3.14159265358979 * k / steps + 0.4) + noise);
        }
        const double squared = 1 + 8 * 0.01 / 12; // of the sum, by the variance of the noise
        EXPECT_NEAR(measure({.measure = Measure::height}, {}, wave).value / height,
                    std::sqrt(squared), 0.01);
        EXPECT_GT(measure({.measure = Measure::range}, {}, wave).value / height, 1.04);
    }
}

TEST_F(Measures, ShareWithinABand)
{
    put_text_into(folder / "band.csv", "time,low,high\n0.5,1,2\n1.5,3.6,4\n2.5,3,4\n3.5,1,1.9\n");
    RunFiles files(folder, folder);
    const Series lower{.file = "band.csv", .value = "low"};
    Quantity quantity{.series = series("x"), .band = Band{lower, "high"}};
    EXPECT_DOUBLE_EQ(share_within(quantity, {}, files).value, 0.5); // at 0.5 and 2.5 s
    quantity.until = "1";
    EXPECT_DOUBLE_EQ(share_within(quantity, {}, files).value, 1);
}

TEST_F(Measures, AFrameIsATableOfParticles)
{
    Cloud cloud{"fluid", 0.5, 0};
    cloud.points = {1, 0, 2, 3, 0, 4};
    cloud.columns = {{"Velocity", "m/s", 3, std::vector<float>{0.5F, 0, 0, 1.5F, 0, 0}},
                     {"Pressure", "Pa", 1, std::vector<float>{8, 16}}};
    {
        FrameWriter writer(folder);
        writer.write(cloud);
        cloud.time = 1.0;
        cloud.index = 1;
        cloud.points[2] = 10;
        writer.write(cloud);
        writer.finish();
    }
    RunFiles files(folder, folder);
    Series series{.file = "fluid", .frame = "0.5", .value = "p + vx*z"};
    EXPECT_EQ(samples(series, {}, files).values, (std::vector<double>{9, 22}));
    series.frame = "";
    EXPECT_EQ(samples(series, {}, files).values, (std::vector<double>{13, 22}));
    EXPECT_EQ(samples(series, {}, files).t, (std::vector<double>{1, 1}));
    series.frame = "0.7";
    EXPECT_THROW(samples(series, {}, files), IoError);
}

} // namespace
} // namespace hyoryu::test_measure
