// SPDX-License-Identifier: MIT
// How walls move: paths from files, within the case, and of wave makers.
#include "test_case_file_support.hpp"

#include "hyoryu/scene/piston.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>

namespace hyoryu::test_motion {
namespace {

class WallMotion : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string with(const std::string& table)
    {
        std::ofstream(folder_ / "paddle.csv") << table;
        return short_case + "[[wall]]\nname = \"paddle\"\nshape = \"plane\"\n"
                            "normal = [1, 0, 0]\n[wall.motion]\ntable = \"paddle.csv\"\n";
    }
    Scene read(const std::string& text) { return parse_case(text, folder_ / "case.toml"); }
    std::vector<Diagnostic> wrong(const std::string& table)
    {
        try {
            read(with(table));
            return {};
        } catch (const CaseError& error) {
            return error.diagnostics();
        }
    }

    std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) / ("hyoryu_motion_" + std::to_string(getpid()));
};

TEST_F(WallMotion, FollowsTheTableFromWhereTheWallStands)
{
    const Scene scene =
        read(with("# a paddle\ntime,x,y,z\n-1,0.5,0,0\n1, 0.7, 0, 0.1\n2;0.9;0;0.2\n"));
    const Motion& motion = scene.walls[0].motion;
    ASSERT_EQ(motion.times, (std::vector<double>{-1, 1, 2}));
    EXPECT_LE(displacement(motion, 0).norm(), 1e-15);
    // half of the first piece is left at time 0; the end of the path is as far as its points
    EXPECT_LE((displacement(motion, 5) - displacement(motion, -5) - Vec3(0.4, 0, 0.2)).norm(),
              1e-15);
}

TEST_F(WallMotion, IsWrittenAsPointsThatReadBackBitByBit)
{
    const Scene scene = read(with("0 0 0 0\n0.3 0.017 0 0\n1.1 0.1 0 0.03\n"));
    const std::string written = to_toml(scene);
    const Scene again = parse_case(written, "elsewhere.toml"); // without the file
    EXPECT_EQ(again.walls[0].motion.times, scene.walls[0].motion.times);
    EXPECT_EQ(again.walls[0].motion.places, scene.walls[0].motion.places);
    EXPECT_EQ(to_toml(again), written);
}

TEST_F(WallMotion, TellsMistakesOfTheFileByLine)
{
    const auto first = [&](const std::string& table) {
        const std::vector<Diagnostic> all = wrong(table);
        return all.empty() ? std::string("nothing") : all.front().what;
    };
    const auto says = [&](const std::string& table, const std::string& words) {
        const std::string what = first(table);
        EXPECT_NE(what.find(words), std::string::npos) << what;
    };
    says("time,x,y,z\n0,0,0,0\n1,2,fast,0\n", "paddle.csv:3: expected a number, found \"fast\"");
    says("0,0,0,0\n\n1,2,0\n", "paddle.csv:3: expected 4 numbers, found 3");
    says("0,0,0,0\n1,0,0,0\n1,1,0,0\n", "paddle.csv:3: time 1 is not later than 1");
    says("0;0;0;0\n1,5;2,5\n", "paddle.csv:2: commas and semicolons in one line");
    says("0,0,0,0\n", "has 1 rows of numbers, a path needs two");
    says("0,0,0,0\n1,nan,0,0\n", "paddle.csv:2: expected a number");
    says("0,0,0,0\n1e-300,1,0,0\n", "paddle.csv: moves at 1e+300 m/s between 0 and 1e-300 s");
    EXPECT_EQ(wrong("0,0,a,0\n1,b,0,0\n").size(), 2U); // all of them at once
}

// E7: columns are taken by name, in every order, with and without units.
TEST_F(WallMotion, E7ColumnsAreTakenByTheNamesOfTheHeader)
{
    std::array<std::string, 4> names{"time", "x", "y", "z"};
    const std::map<std::string, std::array<const char*, 2>> values{
        {"time", {"0", "1"}}, {"x", {"2", "2.5"}}, {"y", {"3", "3.25"}}, {"z", {"4", "4.125"}}};
    const std::map<std::string, std::string> units{
        {"time", " [s]"}, {"x", "[m]"}, {"y", " (m)"}, {"z", " [M]"}};
    std::sort(names.begin(), names.end());
    do {
        for (const bool with_units : {false, true}) {
            std::string table;
            std::array<std::string, 2> rows;
            for (const std::string& name : names) {
                table += fmt::format("{}{},", name, with_units ? units.at(name) : "");
                for (const std::size_t row : {0u, 1u}) {
                    rows[row] += fmt::format("{},", values.at(name)[row]);
                }
            }
            table = fmt::format("{}\n{}\n{}\n", table, rows[0], rows[1]);
            SCOPED_TRACE(table);
            const Motion motion = read(with(table)).walls[0].motion;
            EXPECT_EQ(motion.times, (std::vector<double>{0, 1}));
            EXPECT_EQ(motion.places[1], Vec3(0.5, 0.25, 0.125));
        }
    } while (std::next_permutation(names.begin(), names.end()));
    EXPECT_EQ(read(with("\"T\";X;Y;Z\n0;0;0;0\n1;2;0;0\n")).walls[0].motion.places[1].x(), 2);
    const std::string mark = "\xef\xbb\xbf"; // as Excel writes it
    EXPECT_EQ(read(with(mark + "time,x,y,z\n0,0,0,0\n1,2,0,0\n")).walls[0].motion.places[1].x(), 2);
    EXPECT_EQ(read(with(mark + "0,0,0,0\n1,2,0,0\n")).walls[0].motion.places[1].x(), 2);
}

TEST_F(WallMotion, AHeaderThatIsNotUnderstoodIsRefused)
{
    const std::vector<std::array<std::string, 2>> headers = {
        {"time,x,y", "names 3 columns, expected time, x, y, z"},
        {"time,x,y,w", "unknown column \"w\""},
        {"time,x,y,y", "a repeated column \"y\""},
        {"time,x,y,z,q", "unknown column \"q\""},
        {"time [ms],x,y,z", "unit \"ms\", expected s"},
        {"time,x [mm],y,z", "unit \"mm\", expected m"},
        {"piston stroke", "unknown column \"piston\""}};
    for (const auto& [header, what] : headers) {
        const auto all = wrong(header + "\n0,0,0,0\n1,1,1,1\n");
        ASSERT_FALSE(all.empty()) << header;
        EXPECT_NE(all.front().what.find("paddle.csv:1: the header"), std::string::npos) << header;
        EXPECT_NE(all.front().what.find(what), std::string::npos) << all.front().what;
    }
}

TEST(Piston, MakesTheWaterMoveAsTheSolitaryWave)
{
    const double H = 0.06;
    const double d = 0.3;
    const Motion motion = solitary_piston(H, d, 9.81);
    const double k = std::sqrt(3 * H / (4 * d * d * d));
    const double c = std::sqrt(9.81 * (d + H));
    // Goring's stroke and duration, of the part between tanh = -0.999 and 0.999
    EXPECT_NEAR(motion.places.back().x(), std::sqrt(16 * H * d / 3) * std::tanh(3.80), 1e-14);
    EXPECT_NEAR(motion.times.back(), 2 * (3.80 + H / d * std::tanh(3.80)) / (k * c), 1e-14);
    EXPECT_EQ(motion.times.front(), 0);
    // u = c eta / (d + eta) at the paddle; the cubics are within 1e-3 of the largest speed of it
    const double top = c * H / (d + H);
    double worst = 0;
    for (double t = 0.1; t < motion.times.back() - 0.1; t += 0.001) {
        const double x = displacement(motion, t).x();
        const double phase =
            k * (c * (t - motion.times.back() / 2) - (x - motion.places.back().x() / 2));
        const double eta = H / std::pow(std::cosh(phase), 2);
        worst = std::max(worst, std::abs(velocity(motion, t).x() - c * eta / (d + eta)));
    }
    EXPECT_LE(worst, 1e-3 * top);
}

TEST(Piston, IsReadFromTheCase)
{
    const Scene scene =
        parse_case(short_case + "[[wall]]\nshape = \"plane\"\nnormal = [1, 0, 0]\n"
                                "[wall.motion]\npiston = { solitary_height = 0.06, depth = 0.3 }\n",
                   "case.toml");
    EXPECT_EQ(scene.walls[0].motion.places, solitary_piston(0.06, 0.3, 9.81).places);
    EXPECT_FALSE(mistakes("gravity = [0, 0, 0]\n" + short_case +
                          "[[wall]]\nshape = \"plane\"\n[wall.motion]\n"
                          "piston = { solitary_height = 0.06, depth = 0.3 }\n")
                     .empty());
}

} // namespace
} // namespace hyoryu::test_motion
