// SPDX-License-Identifier: MIT
// Numbers in other units, and keys in the wrong table: what is told, and that sound input is not.
#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_plan_units {
namespace {

struct Numbers {
    double spacing = 0.05;
    double water_density = 1000;
    double density = 500;
    double friction = 0.4;
    double angle = 10;
    std::string fluid; // more keys of [fluid]
    std::string body;  // more keys of the body, after its rotation
};

std::string text_of(const Numbers& n)
{
    return fmt::format(R"toml(
dimensions = 2
[time]
end = 1
[particles]
spacing = {}
[fluid]
density = {}
{}
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [1, 0, 0.5]
[[wall]]
shape = "basin"
min = [0, 0, 0]
max = [3, 0, 1]
open = ["+z"]
[[body]]
shape = "box"
size = [0.4, 0, 0.3]
density = {}
position = [2, 0, 0.5]
rotation_deg = {{ angle = {} }}
{}
[contact]
friction = {}
)toml",
                       n.spacing, n.water_density, n.fluid, n.density, n.angle, n.body, n.friction);
}

std::vector<Diagnostic> told_of(const std::string& text)
{
    try {
        const Scene scene = parse_case(text, "case.toml");
        std::vector<Diagnostic> all = scene.notices;
        const Plan plan = make_plan(scene, fill(scene));
        all.insert(all.end(), plan.warnings.begin(), plan.warnings.end());
        return all;
    } catch (const CaseError& error) {
        return error.diagnostics();
    }
}

bool tells(const std::string& text, const std::string& key, const std::string& what,
           const std::string& hint)
{
    return std::ranges::any_of(told_of(text), [&](const Diagnostic& d) {
        return d.key == key && d.what.find(what) != std::string::npos &&
               d.hint.find(hint) != std::string::npos;
    });
}

TEST(PlanUnits, NumbersInOtherUnitsAreToldWithTheirKey)
{
    EXPECT_TRUE(tells(text_of({.density = 0.5}), "body[0].density", "lower than", "write 500"));
    EXPECT_TRUE(tells(text_of({.density = 8e5}), "body[0].density", "higher than", "kg/m3"));
    EXPECT_TRUE(tells(text_of({.water_density = 1}), "fluid.density", "lower than", "write 1000"));
    EXPECT_TRUE(tells(text_of({.friction = 30}), "contact.friction", "unusually large", "0.577"));
    EXPECT_TRUE(tells(text_of({.angle = 0.785398}), "body[0].rotation_deg.angle",
                      "45 degrees in radians", "write 45"));
    EXPECT_TRUE(tells(text_of({.fluid = "sound_speed = 1480"}), "fluid.sound_speed",
                      "times the largest expected speed", "omit it"));
    EXPECT_TRUE(tells(text_of({.spacing = 20}), "particles.spacing", "is larger than", "metres"));
}

// Kinetic energies of such bodies underflowed, and the run said that it had become unstable.
TEST(PlanUnits, DensitiesBelowThoseOfGasesAreRefused)
{
    Dice dice(3);
    for (int n = 0; n < 12; ++n) {
        const double density = std::pow(10, dice.between(-320, -9.1));
        EXPECT_TRUE(tells(text_of({.density = density}), "body[0].density",
                          "expected at least 1e-09", "kg/m3"));
        EXPECT_TRUE(tells(text_of({.water_density = density}), "fluid.density",
                          "expected at least 1e-09", "kg/m3"));
        const Numbers light{.density = std::pow(10, dice.between(-8.9, 0))};
        EXPECT_FALSE(tells(text_of(light), "body[0].density", "expected at least", ""));
    }
}

TEST(PlanUnits, SoundNumbersAreNotToldOf)
{
    Dice dice(7);
    for (int n = 0; n < 24; ++n) {
        const Numbers numbers{.spacing = dice.between(0.03, 0.08),
                              .water_density = dice.between(800, 1100),
                              .density = dice.between(30, 20'000),
                              .friction = dice.between(0, 1.5),
                              .angle = dice.between(4, 90),
                              .fluid = fmt::format("sound_speed = {}", dice.between(20, 90)),
                              .body = ""};
        const std::string text = text_of(numbers);
        for (const Diagnostic& d : told_of(text)) {
            for (const char* words :
                 {"lower than the density", "higher than the density", "unusually large",
                  "in radians", "times as many steps", "is larger than"}) {
                EXPECT_EQ(d.what.find(words), std::string::npos) << d.what << text;
            }
        }
    }
}

TEST(PlanUnits, AKeyThatFollowsTheHeaderOfAnInnerTableIsToldWhereItBelongs)
{
    EXPECT_TRUE(tells(text_of({.body = "[body.copies]\ncount = [1, 1, 1]\nmaterial = \"oak\""}),
                      "body[0].copies.material", "unknown key", "[[body]]: write it above"));
    EXPECT_TRUE(tells("[time]\nend = 1\ngravity = [0, 0, -1]\n[particles]\nspacing = 1\n",
                      "time.gravity", "unknown key", "the case itself: write it above [time]"));
    EXPECT_TRUE(tells("[time]\nend = 1\nsteep = 1\n[particles]\nspacing = 1\n", "time.steep",
                      "unknown key", "step"));
}

// The table of a body is shown as it is written, without the brackets of the list.
TEST(PlanUnits, ATableGivenAsANumberIsShownAsTables)
{
    std::string text = text_of({});
    const std::string turned = "rotation_deg = { angle = 10 }";
    text.replace(text.find(turned), turned.size(), "rotation_deg = 45");
    EXPECT_TRUE(tells(text, "body[0].rotation_deg", "expected a table", "[body.rotation_deg]"));
}

TEST(PlanUnits, WaterThatIsAllInsideWallsIsTold)
{
    std::string text = text_of({});
    const std::string water = "max = [1, 0, 0.5]";
    text.replace(text.find(water), water.size(),
                 "max = [1, 0, 0.5]\n[[wall]]\nshape = \"plane\"\n"
                 "point = [0, 0, 0.9]");
    EXPECT_TRUE(tells(text, "fluid", "all particles of the blocks lie inside walls", "`normal`"));
}

// Each basin is solid outside: the water of one lies in the other. Both are told by name.
TEST(PlanUnits, WaterThatASecondBasinBuriesIsTold)
{
    const std::string text = "[time]\nend = 1\n[particles]\nspacing = 0.1\n[fluid]\n"
                             "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 1, "
                             "0.5]\n[[fluid.block]]\nshape = \"box\"\nmin = [2, 0, 0]\nmax = [3, "
                             "1, 0.5]\n[[wall]]\nname = \"left\"\nshape = \"basin\"\nmin = [0, 0, "
                             "0]\nmax = [1, 1, 1]\nopen = [\"+z\"]\n[[wall]]\nname = \"right\"\n"
                             "shape = \"basin\"\nmin = [2, 0, 0]\nmax = [3, 1, 1]\nopen = "
                             "[\"+z\"]\n";
    EXPECT_TRUE(tells(text, "fluid.block[0]", "outside of the basin \"right\"", "one basin"));
    EXPECT_TRUE(tells(text, "fluid.block[1]", "outside of the basin \"left\"", "one basin"));
    EXPECT_TRUE(tells(text, "fluid.block[1]", "everything outside of a basin is solid", "box"));
    EXPECT_EQ(told_of(text).size(), 2U);
    const std::string more = "[[gauge]]\nname = \"far\"\ntype = \"force\"\non = \"left\"\n"
                             "[[body]]\nname = \"a\"\nshape = \"box\"\nsize = [0.4, 0.4, 0.4]\n"
                             "density = 500\nposition = [0.5, 0.5, 2]\n[[body]]\nname = \"b\"\n"
                             "shape = \"box\"\nsize = [0.4, 0.4, 0.4]\ndensity = 500\n"
                             "position = [0.6, 0.5, 2]\n";
    EXPECT_TRUE(tells(text + more, "fluid.block[0]", "outside of the basin \"right\"", "basin"));
    EXPECT_TRUE(tells(text + more, "body[1]", "overlap", ""));
}

} // namespace
} // namespace hyoryu::test_plan_units
