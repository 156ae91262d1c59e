// SPDX-License-Identifier: MIT
// Which bodies stand across the window of an open side, where the centre of mass is anywhere in
// them.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/fill.hpp"
#include "hyoryu/scene/plan.hpp"

#include "dice.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace hyoryu::test_across_windows {
namespace {

// A basin with a window in its side x = 0 and a box whose shape begins at `from`, turned by a
// number of quarters about z. The centre of mass is `aside` from the middle, along the axis of the
// body that the turn brings to x.
std::string pool_with_box(double from, double half, double aside, int quarters)
{
    const double sign = quarters < 2 ? 1 : -1;
    const bool along_x = quarters % 2 == 0;
    const double offset = along_x ? sign * aside : -sign * aside; // R e_y = -e_x at one quarter
    return fmt::format(
        "[time]\nend = 2.0\n[particles]\nspacing = 0.1\n[fluid]\n[[fluid.block]]\nshape = \"box\"\n"
        "min = [0, 0, 0]\nmax = [3, 2, 0.6]\n[[wall]]\nname = \"basin\"\nshape = \"basin\"\n"
        "min = [0, 0, 0]\nmax = [3, 2, 1.2]\nopen = [\"-x\", \"+z\"]\n[[open]]\nname = \"sea\"\n"
        "min = [0, 0, 0]\nmax = [0, 2, 1.2]\ninto = \"+x\"\nkind = \"absorb\"\n[[body]]\nname = "
        "\"crate\"\nshape = \"box\"\nsize = [{0}, {0}, 0.4]\ndensity = 400.0\ncenter_of_mass = "
        "[{1}, {2}, 0]\nposition = [{3}, 1.0, 0.45]\nrotation_deg = {{ axis = [0, 0, 1], angle = "
        "{4} }}\n",
        2 * half, along_x ? offset : 0, along_x ? 0 : offset, from + half + aside, 90 * quarters);
}

// What `check` refuses.
std::vector<std::string> refused(const std::string& text)
{
    std::vector<std::string> all;
    try {
        const Scene scene = parse_case(text, "case.toml");
        make_plan(scene, fill(scene));
    } catch (const CaseError& error) {
        std::ranges::transform(error.diagnostics(), std::back_inserter(all), &Diagnostic::what);
    }
    return all;
}

TEST(AcrossWindows, TheShapeDecidesAndNotTheCentreOfMass)
{
    Dice dice(31);
    for (int draw = 0; draw < 12; ++draw) {
        const double half = dice.between(0.25, 0.4);
        const double aside = dice.between(-0.9, 0.9) * half;
        const bool across = dice.chance(0.5);
        const double from = across ? -dice.between(0.02, 0.9) * half : dice.between(0.02, 0.3);
        const int quarters = draw % 4;
        const std::vector<std::string> all = refused(pool_with_box(from, half, aside, quarters));
        const bool told =
            std::ranges::find(all, "body \"crate\" stands across the window") != all.end();
        EXPECT_EQ(told, across) << "from " << from << ", half " << half << ", aside " << aside
                                << ", quarters " << quarters;
        EXPECT_TRUE(across || all.empty()) << all.front();
    }
}

} // namespace
} // namespace hyoryu::test_across_windows
