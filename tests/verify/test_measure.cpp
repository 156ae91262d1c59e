// SPDX-License-Identifier: MIT
// Numbers taken from tables that were written by hand.
#include "hyoryu/verify/measure.hpp"
#include "io/results_fixture.hpp"

#include <cmath>

namespace hyoryu {
namespace {

using testing::put_text_into;

class Measures : public testing::ResultsTest {
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

    Measured of_a(Measure measure_, int index = 1, const std::string& time = "") const
    {
        const Quantity quantity{.series = series("x"),
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
    EXPECT_DOUBLE_EQ(error_from(quantity, reference, {}, files).value, std::sqrt(0.0625 / 2));
}

} // namespace
} // namespace hyoryu
