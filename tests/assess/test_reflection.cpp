// SPDX-License-Identifier: MIT
// Waves that were put together from a part that comes and a part that goes back.
#include "hyoryu/assess/reflection.hpp"

#include "dice.hpp"
#include "io/results_fixture.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hyoryu::test_reflection {
namespace {

constexpr double turn = 2 * std::numbers::pi;

struct Flume {
    double period = 2, wavelength = 4.5;
    double coming = 0.05, going = 0.01; // amplitudes
    double phase = 0;                   // of what comes back, at x = 0
    double second = 0;                  // amplitude of a second harmonic that comes
    double level = 0.66, from = 16, until = 26, every = 0.02;

    double elevation(double x, double t) const
    {
        const double k = turn / wavelength;
        const double w = turn / period;
        return level + coming * std::cos(k * x - w * t) + going * std::cos(k * x + w * t - phase) +
               second * std::cos(2 * (k * x - w * t));
    }

    Measured measured(const std::vector<double>& gauges) const
    {
        std::vector<WaveRecord> records;
        for (const double x : gauges) {
            WaveRecord record{x, {}};
            for (double t = from; t <= until; t += every) {
                record.elevation.t.push_back(t);
                record.elevation.values.push_back(elevation(x, t));
            }
            records.push_back(record);
        }
        return reflection(records, period, turn / wavelength);
    }
};

TEST(Reflection, IsThatOfTheTwoWaves)
{
    Dice dice(11);
    for (int draw = 0; draw < 200; ++draw) {
        Flume flume;
        flume.period = dice.between(0.5, 9);
        flume.wavelength = dice.between(1, 40);
        flume.coming = dice.between(0.01, 2);
        flume.going = flume.coming * dice.between(0, 1);
        flume.phase = dice.between(0, turn);
        flume.level = dice.between(-3, 3);
        flume.from = dice.between(-10, 100);
        flume.until = flume.from + flume.period * dice.between(1.5, 12);
        flume.every = flume.period * dice.between(0.005, 0.2);
        const double first = dice.between(-50, 50);
        const double l = flume.wavelength;
        const std::vector<double> gauges{first, first + l * dice.between(0.08, 0.16),
                                         first + l * dice.between(0.2, 0.4)};
        const Measured got = flume.measured(gauges);
        EXPECT_EQ(got.why, "") << draw;
        EXPECT_NEAR(got.value, flume.going / flume.coming, 1e-9) << draw; // round-off of the fits
    }
}

TEST(Reflection, IsNotThatOfASecondHarmonic)
{
    Flume flume{.second = 0.02};
    // Whole periods: the harmonics are orthogonal up to the last row.
    EXPECT_NEAR(flume.measured({0, 0.45, 1.13}).value, 0.2, 1e-3);
}

TEST(Reflection, NeedsGaugesThatTellTheWavesApart)
{
    const Flume flume;
    for (const std::vector<double>& gauges :
         {std::vector<double>{0, 2.25, 4.5}, {1, 1, 1}, {0, 0.05, 2.3}}) {
        EXPECT_NE(flume.measured(gauges).why.find("multiples of half a wavelength"),
                  std::string::npos);
    }
}

TEST(Reflection, NeedsAPeriodAndAWave)
{
    EXPECT_NE(Flume{.until = 17.9}.measured({0, 0.45, 1.13}).why.find("period"), std::string::npos);
    EXPECT_NE(Flume{.from = 27}.measured({0, 0.45, 1.13}).why.find("period"), std::string::npos);
    EXPECT_NE(Flume({.coming = 0, .going = 0}).measured({0, 0.45, 1.13}).why, "");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(Flume{.level = nan}.measured({0, 0.45, 1.13}).why, "");
    for (const auto& [period, wavenumber] : {std::pair(-2.0, 1.4), {2.0, -1.4}, {0, 1.4}}) {
        EXPECT_NE(reflection({}, period, wavenumber).why.find("above 0"), std::string::npos);
    }
}

class ReflectionOfAFile : public test_help::ResultsTest {};

TEST_F(ReflectionOfAFile, TakesTheRowsAndGaugesThatItIsGiven)
{
    const Flume flume;
    std::string text = "time,a,b,c\n";
    for (int k = 0; k < 800; ++k) {
        const double t = 0.02 * k;
        const double start = t < 4 ? 1e3 : 0; // of no steady waves
        text += fmt::format("{},{},{},{}\n", t, start + flume.elevation(3, t),
                            flume.elevation(3.45, t), flume.elevation(4.13, t));
    }
    test_help::put_text_into(folder / "gauges.csv", text);
    RunFiles files(folder, folder);
    const Scope scope{.numbers = {{"T", 2}, {"k", turn / 4.5}}};
    const Quantity quantity{.series = {.file = "gauges", .value = "a"},
                            .waves = WaveGauges{{"b", "c"}, {0.45, 1.13}, "T", "k"},
                            .measure = Measure::reflection,
                            .from = "4"};
    EXPECT_NEAR(reflection(quantity, scope, files).value, 0.2, 1e-6); // digits of the file
}

} // namespace
} // namespace hyoryu::test_reflection
