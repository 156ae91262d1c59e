// SPDX-License-Identifier: MIT
// Open sides in case files: the ground below windows, the walls carried out below carpets, and what
// is refused.
#include "hyoryu/scene/open_settings.hpp"
#include "hyoryu/scene/plan.hpp"
#include "hyoryu/scene/wall_layers.hpp"

#include "dice.hpp"
#include "test_case_file_support.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hyoryu::test_open_settings {
namespace {

// A basin of water in space with a window in its lower side along x.
std::string basin(const std::string& keys, double from = 0, double to = 1)
{
    return fmt::format(
        "[time]\nend = 2.0\n[particles]\nspacing = 0.1\n[fluid]\n[[fluid.block]]\nshape = \"box\"\n"
        "min = [0, 0, 0]\nmax = [2, 1, 0.6]\n[[wall]]\nname = \"basin\"\nshape = \"basin\"\n"
        "min = [0, 0, 0]\nmax = [2, 1, 1]\nopen = [\"-x\", \"+z\"]\n[[open]]\nname = \"sea\"\n"
        "min = [0, {}, 0]\nmax = [0, {}, 1]\ninto = \"+x\"\n{}",
        from, to, keys);
}

std::vector<Diagnostic> refused(const std::string& text)
{
    try {
        const Scene scene = parse_case(text, "case.toml");
        make_plan(scene, fill(scene));
        return {};
    } catch (const CaseError& error) {
        return error.diagnostics();
    }
}

struct Refusal {
    std::string from, to; // replaced in the text
    std::string key, words;
};

TEST(OpenSettings, MistakesAreToldWithTheirKeyLineAndHint)
{
    const std::string good = basin("kind = \"inflow\"\nlevel = 0.7\nvelocity = 0.2\n");
    ASSERT_TRUE(refused(good).empty());
    const std::vector<Refusal> refusals{
        {"kind = \"inflow\"", "kind = \"outflow\"", "level", "prescribes no flow"},
        {"level = 0.7\n", "", "velocity", "needs a `level`"},
        {"velocity = 0.2", "discharge = 0.2", "discharge", "beside `level`"},
        {"level = 0.7\nvelocity = 0.2\n", "", "series", "needs a flow to follow"},
        {"into = \"+x\"", "into = \"+y\"", "max", "thick along its normal"},
        {"into = \"+x\"", "into = \"-x\"", "into", "points out of the domain"},
        {"level = 0.7", "level = 1.2", "max", "above the window"},
        {"min = [0, 0, 0]\nmax = [0, 1, 1]", "min = [0.5, 0, 0]\nmax = [0.5, 1, 1]", "min",
         "must lie on that side"},
        {"open = [\"-x\", \"+z\"]", "open = [\"+z\"]", "min", "a wall closes the window"},
        {"min = [0, 0, 0]\nmax = [0, 1, 1]", "min = [0, 0, 0.3]\nmax = [0, 1, 1]", "min",
         "above the ground"},
        {"level = 0.7\nvelocity = 0.2\n", "series = \"nowhere.csv\"\n", "series", "nowhere.csv"},
        {"level = 0.7\n", "level = 0.7\ndatum = 0.5\n", "datum", "without a series"},
        {"level = 0.7\n", "level = 0.7\nhold = true\n", "hold", "without a series"},
        {"[fluid]\n", "[fluid]\nshifting.model = \"sun\"\n", "name", "fluid.shifting"},
        {"level = 0.7\nvelocity = 0.2\n",
         "[[open.station]]\nat = 0.5\ntimes = [0, 2, 1]\nlevels = [0.7, 0.7, 0.7]\n", "times[2]",
         "is not later than"},
        {"level = 0.7\nvelocity = 0.2\n",
         "[[open.station]]\nat = 0.5\ntimes = [0, 1]\nlevels = [0.7]\n", "times", "1 values"},
        {"level = 0.7\n",
         "[[open.station]]\nat = 0.5\ntimes = [0, 1]\nlevels = [0.7, 0.7]\n"
         "[[open.station]]\nat = 0.2\ntimes = [0, 1]\nlevels = [0.7, 0.7]\n",
         "station", "is not beyond"},
    };
    for (const Refusal& r : refusals) {
        const std::string text = replaced(good, r.from, r.to);
        SCOPED_TRACE(text);
        const auto all = refused(text);
        const auto found = std::ranges::find_if(all, [&](const Diagnostic& d) {
            return d.key.ends_with(r.key) && d.what.find(r.words) != std::string::npos;
        });
        ASSERT_NE(found, all.end()) << (all.empty() ? "nothing refused" : to_string(all.front()));
        EXPECT_GT(found->line, 0);
        EXPECT_FALSE(found->hint.empty());
    }
}

TEST(OpenSettings, SeveralMistakesAreToldTogether)
{
    const std::string text = basin("kind = \"inflow\"\nlevel = 1.2\n", -0.5, 0.5) +
                             "[[open]]\nname = \"sea\"\nmin = [0, 0.2, 0]\nmax = [0, 1, 1]\n"
                             "into = \"+x\"\nkind = \"absorb\"\n";
    EXPECT_FALSE(refused(text).empty());
    const std::string other =
        replaced(text, "name = \"sea\"\nmin = [0, 0.2", "name = \"b\"\nmin = [0, 0.2");
    const auto all = refused(other);
    EXPECT_GE(all.size(), 2U) << "the level above the window and the windows that overlap";
}

TEST(OpenSettings, BodiesStopWhereContactKnowsTheWindow)
{
    const std::string body = "[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [0.4, 0.4, 0.4]\n"
                             "density = 500\nposition = [1, 0.5, 0.62]\n";
    const std::string springs = "[contact]\nmethod = \"penalty\"\n[contact.penalty]\n"
                                "stiffness = \"2 kN/m\"\ndamping = \"0.1 N s/m\"\n";
    const std::string stops = basin("kind = \"inflow\"\nlevel = 0.7\nvelocity = 0.2\n");
    const std::string leaves = stops + "bodies = \"leave\"\n";
    const auto words_of = [](const std::string& text) {
        const auto all = refused(text);
        return all.empty() ? std::string() : all.front().what;
    };
    EXPECT_NE(words_of(stops + body + springs).find("penalty"), std::string::npos);
    EXPECT_EQ(words_of(stops + springs), "");
    EXPECT_EQ(words_of(leaves + body + springs), "");
    const auto named_alike = [](const std::string& text) {
        return replaced(text, "name = \"sea\"", "name = \"basin\"");
    };
    EXPECT_NE(words_of(named_alike(stops + body)).find("already used by a wall"),
              std::string::npos);
    EXPECT_EQ(words_of(named_alike(leaves + body)), "");
}

TEST(OpenSettings, BodiesAndWindowsHaveDifferentNames)
{
    const std::string body = "[[body]]\nname = \"sea\"\nshape = \"box\"\nsize = [0.4, 0.4, 0.4]\n"
                             "density = 500\nposition = [1, 0.5, 0.62]\n";
    const auto all = refused(basin("kind = \"inflow\"\nlevel = 0.7\nvelocity = 0.2\n") + body);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_NE(all.front().what.find("already used by a body"), std::string::npos);
}

// Numbers of the case are those of the scene; `scale` and the others tell how a file is read.
TEST(OpenSettings, StationsInTheCaseTakeNoKeysOfFiles)
{
    const std::string station = "[[open.station]]\nat = 0.5\ntimes = [0, 3]\nlevels = [0.6, 0.7]\n"
                                "velocities = [0, 0]\n";
    EXPECT_TRUE(refused(basin("kind = \"inflow\"\n" + station)).empty());
    for (const char* key : {"scale = 2.0\n", "datum = 0.1\n", "time_offset = 100.0\n"}) {
        const auto all = refused(basin(std::string("kind = \"inflow\"\n") + key + station));
        ASSERT_EQ(all.size(), 1U) << key;
        EXPECT_NE(all.front().what.find("which apply to files"), std::string::npos);
    }
}

// A window may reach below the underside of its ground, and one end of it may be dry.
TEST(OpenSettings, WindowsReachBelowTheirGroundAndAcrossItsShore)
{
    Dice dice(5);
    for (int n = 0; n < 6; ++n) {
        const double thick = dice.between(0.12, 0.5);
        const double low = n == 0 ? -thick : -dice.between(0.05, 1);
        const std::string text = fmt::format(
            "[time]\nend = 2.0\n[particles]\nspacing = 0.1\n[domain]\nmin = [0, 0, -2]\n"
            "max = [2, 2, 1]\n[fluid]\n[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
            "max = [2, 2, 0.6]\n[[wall]]\nname = \"bed\"\nshape = \"box\"\nmin = [-1, -1, {}]\n"
            "max = [3, 3, 0]\n[[wall]]\nname = \"shore\"\nshape = \"plane\"\npoint = [0, 0, 0]\n"
            "normal = [0, {}, 1]\n[[open]]\nname = \"sea\"\nmin = [0, 0, {}]\nmax = [0, 2, 1]\n"
            "into = \"+x\"\nkind = \"absorb\"\n",
            -thick, n % 2 == 0 ? 0.0 : -dice.between(0.3, 0.45), low);
        SCOPED_TRACE(text);
        const Scene scene = parse_case(text, "case.toml");
        EXPECT_NO_THROW(make_plan(scene, fill(scene)));
        const OpenSide side = open_side(scene, scene.open.front());
        EXPECT_NEAR(side.bed.front(), 0, 0.1);
    }
}

// A window that bodies may drift to, a flow that ends, water too shallow to enter.
// Ground that is lifted, so that the window begins below its underside: by less than a spacing, or
// by more. What hangs there is no wall behind the window.
TEST(OpenSettings, AWindowMayBeginBelowTheUndersideOfItsGround)
{
    Dice dice(9);
    for (int n = 0; n < 30; ++n) {
        const double spacing = dice.between(0.05, 0.1);
        const double under = spacing * dice.between(0.02, 3); // above the edge of the window
        const double top = under + spacing * dice.between(4, 8);
        const std::string text = fmt::format(
            "dimensions = 2\n[domain]\nmin = [0, 0, 0]\nmax = [2, 0, 3]\n[time]\nend = 2.0\n"
            "[particles]\nspacing = {0}\n[fluid]\n"
            "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, {1}]\nmax = [2, 0, {2}]\n"
            "[[wall]]\nname = \"ground\"\nshape = \"box\"\nmin = [-1, 0, {3}]\n"
            "max = [3, 0, {1}]\n[[wall]]\nname = \"sides\"\nshape = \"basin\"\n"
            "min = [0, 0, 0]\nmax = [2, 0, 3]\nopen = [\"-x\", \"-z\", \"+z\"]\n[[open]]\n"
            "name = \"sea\"\nmin = [0, 0, 0]\nmax = [0, 0, 3]\ninto = \"+x\"\n"
            "kind = \"inflow\"\nlevel = {2}\nvelocity = 0.1\n",
            spacing, top, top + 0.6, under);
        SCOPED_TRACE(text);
        const auto all = refused(text);
        EXPECT_TRUE(all.empty()) << to_string(all.front());
        const Scene scene = parse_case(text, "case.toml");
        EXPECT_NEAR(open_side(scene, scene.open.front()).bed.front(), top, 1e-6 * spacing);
    }
}

// A level alone asks for the velocity of a simple wave, u = 2 sqrt(g h) - 2 sqrt(g h0): with that
// velocity beside it the same speed is expected.
TEST(OpenSettings, ALevelAloneIsExpectedToBeAsFastAsItsWave)
{
    constexpr double g = 9.81;
    Dice dice(10);
    for (int n = 0; n < 100; ++n) {
        const double bed = dice.between(-5, 5);
        const double still = bed + dice.between(0, 2);
        OpenSettings alone;
        alone.level = bed + dice.between(0.1, 3);
        OpenSettings both = alone;
        both.velocity = 2 * (std::sqrt(g * (*alone.level - bed)) - std::sqrt(g * (still - bed)));
        const double u = fastest_asked(alone, bed, still, g, 3);
        EXPECT_NEAR(u, fastest_asked(both, bed, -infinity, g, 3), 1e-12 * u);
        EXPECT_NEAR(fastest_asked(alone, bed, -infinity, g, 3),
                    std::sqrt(6 * g * (*alone.level - bed)), 1e-12 * u)
            << "onto a dry bed: u = 2 sqrt(g h)";
    }
}

// One fault has one message: bodies and water are not looked for on the wrong side of a window, and
// the domain, which holds all bodies, does not end at one that stands across it.
TEST(OpenSettings, AFaultOfAWindowHasNoConsequences)
{
    const std::string good = basin("kind = \"absorb\"\n");
    const auto body = [](double x) {
        return fmt::format("[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [0.4, 0.4, 0.2]\n"
                           "density = 500\nposition = [{}, 0.5, 0.7]\n",
                           x);
    };
    Dice dice(6);
    for (int n = 0; n < 4; ++n) {
        std::string outward = good + body(dice.between(0.3, 1.7));
        outward.replace(outward.find("into = \"+x\""), 11, "into = \"-x\"");
        const std::vector<Diagnostic> turned = refused(outward);
        ASSERT_EQ(turned.size(), 1u) << outward;
        EXPECT_EQ(turned[0].key, "open.sea.into");
        const std::vector<Diagnostic> across = refused(good + body(dice.between(-0.15, 0.15)));
        ASSERT_EQ(across.size(), 1u);
        EXPECT_NE(across[0].what.find("stands across"), std::string::npos) << across[0].what;
    }
}

TEST(OpenSettings, CheckWarnsOfWhatHappensAtAWindow)
{
    const auto warns = [](const std::string& text, const std::string& words) {
        const Scene scene = parse_case(text, "case.toml");
        const Plan plan = make_plan(scene, fill(scene));
        return std::ranges::any_of(plan.warnings, [&](const Diagnostic& warning) {
            return warning.what.find(words) != std::string::npos;
        });
    };
    const std::string good = basin("kind = \"inflow\"\nlevel = 0.7\nvelocity = 0.2\n");
    const std::string leaves = good + "bodies = \"leave\"\n";
    const auto body = [](double length) {
        return fmt::format("[[body]]\nname = \"b\"\nshape = \"box\"\nsize = [{}, 0.4, 0.2]\n"
                           "density = 500\nposition = [1, 0.5, 0.62]\n",
                           length);
    };
    // A body of 1.3 m by 0.4 m by 0.2 m needs 1.4 m of water behind the window and 1.1 m beyond.
    const auto ground = [](double length) {
        return fmt::format("[domain]\nmin = [0, 0, 0]\nmax = [2, 1, 1]\n"
                           "[[wall]]\nname = \"apron\"\nshape = \"box\"\nmin = [{}, -0.5, -0.4]\n"
                           "max = [0.0, 1.5, 0.0]\n",
                           -length);
    };
    Dice dice(4);
    for (int n = 0; n < 5; ++n) {
        const double length = dice.between(0.5, 4);
        EXPECT_EQ(warns(leaves + body(1.3) + ground(length), "the ground ends"), length < 2.4)
            << length;
    }
    EXPECT_TRUE(warns(leaves + body(1.3), "the longest body needs 2.5 m"));
    EXPECT_FALSE(warns(leaves + body(1.3) + "fixed = true\n", "the ground ends"));
    EXPECT_FALSE(warns(good + body(1.3), "the ground ends"));
    EXPECT_FALSE(warns(leaves, "the ground ends"));
    const std::string series = "kind = \"inflow\"\n[[open.station]]\nat = 0.5\ntimes = [0, {}]\n"
                               "levels = [0.6, 0.7]\nvelocities = [0, 0]\n";
    EXPECT_TRUE(warns(basin(fmt::format(fmt::runtime(series), 1.0)), "values are held"));
    EXPECT_FALSE(warns(basin(fmt::format(fmt::runtime(series), 3.0)), "values are held"));
    EXPECT_TRUE(
        warns(basin("kind = \"inflow\"\nlevel = 0.3\nvelocity = 3.0\n"), "needed to carry a body"));
    for (int n = 0; n < 4; ++n) {
        const double width = dice.between(0.08, 0.6); // the spacing is 0.1
        EXPECT_EQ(warns(basin("kind = \"absorb\"\n", 0.2, 0.2 + width), "the level in a window"),
                  width < 0.3)
            << width;
    }
}

// A wall across all of the window and beyond it closes its water off; with a gap of two spacings,
// or below the water, it does not.
TEST(OpenSettings, AWallAcrossTheStripIsTold)
{
    Dice dice(77);
    for (int n = 0; n < 9; ++n) {
        const double gap = n % 3 == 1 ? 0.2 : 0;
        const double top = n % 3 == 2 ? dice.between(0.1, 0.4) : dice.between(0.7, 1.5);
        const double at = dice.between(0.15, 0.6);
        const std::string text =
            basin("kind = \"absorb\"\n") +
            fmt::format("[[wall]]\nname = \"across\"\nshape = \"box\"\nmin = [{}, -0.5, -0.5]\n"
                        "max = [{}, {}, {}]\n",
                        at, at + dice.between(0.2, 0.8), gap > 0 ? 1 - gap : 1.5, top);
        SCOPED_TRACE(text);
        const Scene scene = parse_case(text, "case.toml");
        const Plan plan = make_plan(scene, fill(scene));
        EXPECT_EQ(std::ranges::any_of(plan.warnings,
                                      [](const Diagnostic& warning) {
                                          return warning.what.find("close off") !=
                                                 std::string::npos;
                                      }),
                  n % 3 == 0);
    }
}

// Windows of any place and width in space: lanes lie within the window, and the ground is that of
// the floor and of a step in it.
TEST(OpenSettings, TheGroundBelowAWindowIsThatOfItsWalls)
{
    Dice dice(14);
    for (int n = 0; n < 20; ++n) {
        const double from = 0.1 * dice.below(4);
        const double to = 1 - 0.1 * dice.below(4);
        const double step = dice.between(0.1, 0.3);
        const std::string text =
            basin("kind = \"absorb\"\n", from, to) +
            fmt::format("[[wall]]\nname = \"step\"\nshape = \"box\"\nmin = [-1, 0.5, -0.2]\n"
                        "max = [2, 1.2, {}]\n",
                        step);
        SCOPED_TRACE(text);
        const Scene scene = parse_case(text, "case.toml");
        const OpenSide side = open_side(scene, scene.open.front());
        ASSERT_EQ(side.lanes(), std::lround((to - from) / 0.1));
        for (int lane = 0; lane < side.lanes(); ++lane) {
            const double y = side.first + (lane + 0.5) * 0.1;
            EXPECT_EQ(side.lane({0, y, 0}), lane);
            const double expected = y > 0.5 ? step : 0;
            EXPECT_NEAR(side.bed[static_cast<std::size_t>(lane)], expected, 1e-6);
            EXPECT_NEAR(side.strip[static_cast<std::size_t>(lane)], expected, 1e-6);
        }
    }
}

// Walls made one by one are those of the filling, bit for bit, also where they are carried out, and
// behind a window each is a particle of the first column carried out by whole spacings.
TEST(OpenSettings, WallsCarriedOutAreMadeAgainBitForBit)
{
    for (const bool sticks : {false, true}) {
        std::string text = basin("kind = \"absorb\"\n");
        if (sticks) {
            text = replaced(text, "[fluid]\n",
                            "[fluid]\nwalls = \"no_slip\"\nviscosity = { model = \"laminar\", "
                            "kinematic = 0.01 }\n");
        }
        const Scene scene = parse_case(text, "case.toml");
        const Filling filling = fill(scene);
        std::vector<SolidSurface> surfaces;
        for (const Wall& wall : scene.walls) {
            surfaces.push_back(
                surface_of(wall, wall_layers(scene.fluid->smoothing_ratio) * scene.spacing, 3));
        }
        const WallMaker make = wall_maker(scene, filling, surfaces, 1);
        int behind = 0;
        for (std::size_t k = 0; k < filling.wall.size(); ++k) {
            const WallPoint point = make(static_cast<std::int32_t>(k));
            ASSERT_EQ(point.place, filling.wall[k]);
            EXPECT_EQ(point.depth, sticks ? filling.wall_depth[k] : 0);
            if (filling.wall[k].x() < 0) {
                ++behind;
                Vec3 first = filling.wall[k];
                first.x() -= 0.1 * std::floor(first.x() / 0.1);
                EXPECT_TRUE(std::ranges::any_of(
                    filling.wall, [&](const Vec3& x) { return (x - first).norm() < 1e-9; }));
            }
        }
        EXPECT_GT(behind, 300);
    }
}

} // namespace
} // namespace hyoryu::test_open_settings
