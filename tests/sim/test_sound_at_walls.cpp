// SPDX-License-Identifier: MIT
// Sound between walls against the exact period of a column of water that is open above.
#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_sound_at_walls {
namespace {

struct Column {
    int dimensions;
    int width;  // in spacings
    int length; // in spacings
    double spacing;
    double sound_speed; // over sqrt(g L)
};

// The lowest mode of a column of water, started by its velocity. Its hydrostatic pressure keeps the
// water pressed on the walls.
std::string text_of(const Column& c)
{
    const double L = c.length * c.spacing;
    const double W = c.width * c.spacing;
    const double c0 = c.sound_speed * std::sqrt(9.81 * L);
    const double D = c.dimensions == 2 ? 0 : W;
    return fmt::format(R"toml(
dimensions = {0}
[time]
end = {1}
[particles]
spacing = {2}
[fluid]
sound_speed = {3}
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [{4}, {5}, {6}]
velocity_field = ["0", "0", "{7}*sin(_pi*z/{8})"]
[[wall]]
name = "column"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [{4}, {5}, {9}]
open = ["+z"]
)toml",
                       c.dimensions, 20 * L / c0, c.spacing, c0, W, D, L, 5e-4 * c0, 2 * L,
                       1.3 * L);
}

// The period from the zeros of the momentum along the column, over c0/(4 L).
double period_of(const Column& c, const char* continuity)
{
    Simulation sim = make(text_of(c), {fmt::format("fluid.wall_continuity=\"{}\"", continuity)});
    const double L = c.length * c.spacing;
    const double exact = 4 * L / (c.sound_speed * std::sqrt(9.81 * L));
    std::vector<double> zeros;
    double before = 0;
    double then = 0;
    while (zeros.size() < 7) {
        double momentum = 0;
        for (const Vec3& v : sim.fluid->particles.fluid[field::velocity]) {
            momentum += v.z();
        }
        if (before * momentum < 0) {
            zeros.push_back(then + (sim.clock.time - then) * before / (before - momentum));
        }
        before = momentum;
        then = sim.clock.time;
        step_on(sim);
    }
    return (zeros.back() - zeros.front()) / 3 / exact;
}

// The static compression shortens the period by less than g L/c0^2, 0.25 % at the least sound
// speed; half a per cent is the tolerance of the case `acoustic_column` for the discretisation. The
// plain continuity lengthens the period by 1.4 dp/W and more.
TEST(SoundAtWalls, HasItsPeriodWithThePairedContinuity)
{
    Dice dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 31)));
    for (int k = 0; k < number_from("HYORYU_DRAWS", 8); ++k) {
        const bool plane = k % 4 != 3;
        const Column c{plane ? 2 : 3, plane ? 5 + dice.below(12) : 5 + dice.below(3),
                       plane ? 24 + dice.below(30) : 20 + dice.below(8), dice.between(0.01, 0.5),
                       dice.between(20, 40)};
        SCOPED_TRACE(fmt::format("{}-D, {} x {} spacings of {} m, c0 {} sqrt(g L)", c.dimensions,
                                 c.width, c.length, c.spacing, c.sound_speed));
        EXPECT_NEAR(period_of(c, "paired"), 1, 0.01);
        EXPECT_GT(period_of(c, "plain"), 1.02);
    }
}

} // namespace
} // namespace hyoryu::test_sound_at_walls
