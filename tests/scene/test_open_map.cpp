// SPDX-License-Identifier: MIT
// Gauges of a map at the windows of a case: they lie in it as the terrain does, unless the case
// says otherwise. Terrains, currents and windows are drawn at random.
#include "building_files.hpp"

#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/plan.hpp"

#include <algorithm>

namespace hyoryu::test_open_map {
namespace {

class GaugesInAMap : public BuildingFiles {
protected:
    // A window in one side of a tank over the terrain, that follows the gauge g.txt.
    static std::string case_of_window(const SlopingGround& plane, int into, const std::string& keys)
    {
        constexpr std::array<const char*, 4> names{"+x", "-x", "+y", "-y"};
        constexpr std::array<const char*, 4> mins{"[-6, -6, -50]", "[6, -6, -50]", "[-6, -6, -50]",
                                                  "[-6, 6, -50]"};
        constexpr std::array<const char*, 4> maxs{"[-6, 6, 50]", "[6, 6, 50]", "[6, -6, 50]",
                                                  "[6, 6, 50]"};
        const auto k = static_cast<std::size_t>(into);
        return fmt::format(
            "[time]\nend = 1\n[particles]\nspacing = 1\n[domain]\nmin = [-6, -6, -50]\nmax = [6, "
            "6, "
            "50]\n[fluid]\n[[fluid.block]]\nshape = \"box\"\nmin = [-6, -6, 20]\nmax = [6, 6, "
            "24]\n{}[[open]]\nname = \"sea\"\nmin = {}\nmax = {}\ninto = \"{}\"\nkind = "
            "\"inflow\"\nseries = \"g.txt\"\nformat = \"geoclaw\"\n{}",
            terrain_of(plane), mins[k], maxs[k], names[k], keys);
    }
};

TEST_F(GaugesInAMap, LieInTheCaseAsTheTerrainDoes)
{
    Dice dice(31);
    for (int n = 0; n < 24; ++n) {
        const SlopingGround plane = draw_plane(dice);
        const Complex current{dice.between(-3, 3), dice.between(-3, 3)}; // to the east, the north
        const double eta = dice.between(-1, 1);
        write("g.asc", grid_of(plane));
        write("g.txt", fmt::format("1 0 2 {0} {1} {2}\n1 9 2 {0} {1} {2}\n", 2 * current.real(),
                                   2 * current.imag(), eta));
        const Complex along = plane.in_case(plane.origin + current); // x + i y of the case
        const std::array<double, 4> expected{along.real(), -along.real(), along.imag(),
                                             -along.imag()};
        const Scene scene = read(case_of_window(plane, n % 4, ""));
        EXPECT_NEAR(scene.open[0].series[0].velocities[0],
                    expected[static_cast<std::size_t>(n % 4)], 1e-9);
        EXPECT_NEAR(scene.open[0].series[0].levels[0], plane.datum + eta, 1e-12);
        EXPECT_TRUE(scene.notices.empty());
        const Scene other = read(case_of_window(plane, n % 4, "datum = 0.5\n"));
        EXPECT_NEAR(other.open[0].series[0].levels[0], 0.5 + eta, 1e-12);
    }
}

TEST_F(GaugesInAMap, ADirectionThatIsNotThatOfTheTerrainIsToldOf)
{
    Dice dice(32);
    for (int n = 0; n < 12; ++n) {
        const SlopingGround plane = draw_plane(dice);
        write("g.asc", grid_of(plane));
        write("g.txt", "1 0 2 1 1 0\n1 9 2 1 1 0\n");
        const std::array<double, 4> from_x{0, 180, -90, 90}; // clockwise, +y being left of +x
        const double right = plane.azimuth_deg + from_x[static_cast<std::size_t>(n % 4)];
        const auto notices = [&](double azimuth) {
            return read(case_of_window(plane, n % 4, fmt::format("azimuth_deg = {}\n", azimuth)))
                .notices;
        };
        EXPECT_TRUE(notices(right).empty());
        EXPECT_TRUE(notices(right + 360).empty());
        const auto told = notices(right + dice.between(5, 355));
        ASSERT_EQ(told.size(), 1U);
        EXPECT_NE(told[0].what.find("by the terrain `into` points"), std::string::npos);
    }
}

// A gauge of another zero is a step at the start. The ground is level, and the water 4 m deep.
TEST_F(GaugesInAMap, AStepAtTheStartIsToldOf)
{
    Dice dice(33);
    for (int n = 0; n < 4; ++n) {
        SlopingGround plane = draw_plane(dice);
        plane.east = plane.north = 0;
        write("g.asc", grid_of(plane));
        const double off = dice.between(1.2, 3) * (dice.chance(0.5) ? 1 : -1); // spacing 1 m
        const auto told = [&](double level) {
            write("g.txt", fmt::format("1 0 4 0 0 {0}\n1 9 4 0 0 {0}\n", level - plane.datum));
            std::string text = case_of_window(plane, 0, "") +
                               "[[wall]]\nname = \"sides\"\nshape = \"basin\"\nmin = [-6, -6, "
                               "-50]\nmax = [6, 6, 50]\nopen = [\"-x\", \"+z\", \"-z\"]\n";
            const std::string water = "min = [-6, -6, 20]\nmax = [6, 6, 24]";
            text.replace(
                text.find(water), water.size(),
                fmt::format("min = [-6, -6, {}]\nmax = [6, 6, {}]", plane.datum, plane.datum + 4));
            const Scene scene = read(text);
            const Plan plan = make_plan(scene, fill(scene));
            return std::ranges::any_of(plan.warnings, [](const Diagnostic& note) {
                return note.what.find("enters as a wave immediately") != std::string::npos;
            });
        };
        EXPECT_FALSE(told(plane.datum + 4));
        EXPECT_TRUE(told(plane.datum + 4 + off)) << off;
    }
}

} // namespace
} // namespace hyoryu::test_open_map
