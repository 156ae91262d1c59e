// SPDX-License-Identifier: MIT
// Runs that go wrong: what is noticed, and how it is told.
#include "runs.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/sim/watch.hpp"

#include "dice.hpp"

namespace hyoryu::test_watch {
namespace {

const std::string tank = R"(
title = "tank"
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 0.5]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 1.0]
open = ["+z"]
[[body]]
name = "float"
shape = "box"
size = [0.2, 0.0, 0.2]
density = 500.0
position = [0.5, 0.0, 0.5]
)";

const std::string crates = R"(
title = "crates"
[time]
end = 1.0
step = 1e-3
[particles]
spacing = 0.05
[[wall]]
name = "floor"
shape = "plane"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[[body]]
name = "left"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500.0
position = [0.0, 0.0, 0.1]
[[body]]
name = "right"
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500.0
position = [0.3, 0.0, 0.1]
)";

// What the error says, or nothing if there is none.
std::string said(const auto& action)
{
    try {
        action();
    } catch (const NumericalError& error) {
        return error.what();
    }
    return {};
}

void expect_words(const std::string& text, std::initializer_list<const char*> words)
{
    for (const char* word : words) {
        EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
    }
}

TEST(Watch, NamesTheParticleAndWhatLiesAroundIt)
{
    Simulation sim = make(tank);
    advance(sim, 1);
    Store& particles = sim.fluid->particles.fluid;
    const auto x = particles[field::position];
    std::size_t corner = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        corner = x[k].x() + x[k].z() < x[corner].x() + x[corner].z() ? k : corner;
    }
    particles[field::velocity][corner] = {1e6, 0, 0};
    const std::string text = said([&] { watch(sim, survey(sim)); });
    expect_words(text, {"fluid particle", "speed 1e+06", "of the fluid", "of wall \"basin\"",
                        "the nearest at", "step 1"});
    EXPECT_EQ(text.find("of body"), std::string::npos) << text;
}

TEST(Watch, ANumberThatIsNoneIsFoundWhereverItIs)
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    Simulation sim = make(tank);
    advance(sim, 1);
    sim.fluid->particles.fluid[field::density][7] = none;
    expect_words(said([&] { watch(sim, survey(sim)); }), {"fluid particle", "density nan"});
    sim = make(tank);
    sim.rigid.bodies[0].angular_momentum.x() = none;
    expect_words(said([&] { watch(sim, survey(sim)); }), {"body \"float\"", "not finite"});
}

TEST(Watch, SolidsThatRunIntoEachOtherAreNamed)
{
    Simulation sim = make(crates);
    advance(sim, 3);
    sim.rigid.bodies[1].position.x() = 0.05; // 0.15 m into the other, whose inner radius is 0.1 m
    const std::string text = said([&] { step(sim); });
    expect_words(text, {"body \"right\" and body \"left\"", "overlap by 0.1",
                        "whose inner radius is 0.1 m"});
    EXPECT_EQ(text.find("moving wall"), std::string::npos) << "there is none";
}

// A wall closes on two crates in a row that stand against the side of a basin, and goes on.
const std::string press = R"(
dimensions = 2
[time]
end = 1.0
step = 1e-3
[particles]
spacing = 0.02
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 1.0]
open = ["+z"]
[[wall]]
name = "ram"
shape = "box"
min = [0.2, 0.0, 0.0]
max = [0.4, 0.0, 0.5]
[wall.motion]
velocity = [0.5, 0.0, 0.0]
[[body]]
name = "near"
shape = "box"
size = [0.2, 1.0, 0.2]
density = 500.0
position = [0.6, 0.0, 0.1]
[[body]]
name = "far"
shape = "box"
size = [0.2, 1.0, 0.2]
density = 500.0
position = [0.8, 0.0, 0.1]
[contact]
friction = 0.3
restitution = 0.2
)";

// Room is gone at 0.4 s; a quarter of a spacing takes 0.01 s, however the three contacts share it,
// and another step.
TEST(Watch, WhatAMovingWallCrushesIsNamedWithWhatStandsInTheWay)
{
    Simulation sim = make(press);
    const std::string text = said([&] { advance(sim, 1000); });
    expect_words(text, {"body \"near\"", "wall \"ram\" presses it against wall \"basin\"",
                        "over-constrained"});
    EXPECT_GT(sim.clock.time, 0.4);
    EXPECT_LE(sim.clock.time, 0.4115);
    for (const Body& body : sim.rigid.bodies) {
        EXPECT_LE(body.position.x(), 0.9 + 0.25 * 0.0205) << "held by the side of the basin";
    }
}

// One to five boxes before the ram, with the room that they leave.
struct Column {
    std::string text;
    double speed = 0;    // of the ram [m/s]
    double room = 0.6;   // between the ram and the side of the basin, less the boxes [m]
    double thinnest = 0; // the spacing, or the inner radius of a box [m]
};

Column thrown(Dice& dice, const std::string& keys_of_boxes)
{
    Column column{.text = press.substr(0, press.find("[[body]]")), .speed = dice.between(0.2, 1)};
    column.thinnest = dice.between(0.01, 0.03);
    const auto put = [&](const std::string& old, const std::string& with) {
        column.text.replace(column.text.find(old), old.size(), with);
    };
    put("spacing = 0.02", fmt::format("spacing = {}", column.thinnest));
    put("velocity = [0.5, 0.0, 0.0]", fmt::format("velocity = [{}, 0.0, 0.0]", column.speed));
    put("end = 1.0", "end = 10.0");
    const int count = 1 + dice.below(5);
    double used = 0.4;
    for (int k = 0; k < count; ++k) {
        const double width = dice.between(0.04, 0.08);
        used += dice.between(0.005, 0.03) + width;
        column.text += fmt::format("[[body]]\nname = \"box {0}\"\nshape = \"box\"\n"
                                   "size = [{1}, 1.0, {1}]\ndensity = 500.0\n"
                                   "position = [{2}, 0.0, {3}]\n{4}",
                                   k, width, used - width / 2, width / 2, keys_of_boxes);
        column.room -= width;
        column.thinnest = std::min(column.thinnest, width / 2);
    }
    column.text += "[contact]\nfriction = 0.3\nrestitution = 0.2\n";
    return column;
}

// The run stops when the ram has gone on by a quarter of a spacing, or of the inner radius of the
// thinnest box, a step before or three after.
TEST(Watch, ColumnsOfAnyNumberOfBodiesAreCrushedWhenTheirRoomIsGone)
{
    Dice dice(17);
    for (int n = 0; n < 12; ++n) {
        const Column column = thrown(dice, "locks = [\"z\", \"ry\"]\n");
        Simulation sim = make(column.text);
        const std::string told = said([&] { advance(sim, 10000); });
        expect_words(told, {"wall \"ram\" presses it against wall \"basin\""});
        const double gone = sim.clock.time * column.speed - column.room;
        EXPECT_GT(gone, 0.25 * column.thinnest - 1e-3 * column.speed) << column.text;
        EXPECT_LT(gone, 0.25 * column.thinnest + 3e-3 * column.speed) << column.text;
    }
}

// Boxes that may rise are squeezed out of the column, one after the other: what is told in the end
// is the wall, not a number that is none.
TEST(Watch, WhatIsSqueezedOutEndsWithTheSameCause)
{
    Dice dice(17);
    for (int n = 0; n < 12; ++n) {
        const Column column = thrown(dice, "");
        Simulation sim = make(column.text);
        const std::string told = said([&] { advance(sim, 10000); });
        expect_words(told, {"wall \"ram\" presses it against wall \"basin\""});
        EXPECT_GT(sim.clock.time * column.speed, column.room) << column.text;
    }
}

// Slower, so that there is room to the end.
TEST(Watch, WhatAMovingWallPressesIsLeftAloneWhileThereIsRoom)
{
    std::string text = press;
    const std::string motion = "velocity = [0.5, 0.0, 0.0]";
    text.replace(text.find(motion), motion.size(), "velocity = [0.1995, 0.0, 0.0]");
    Simulation sim = make(text);
    EXPECT_EQ(said([&] { advance(sim, 1000); }), "");
    EXPECT_LE(sim.rigid.counters.worst_penetration, 1e-3);
}

// E5: each cause where it is there, and none of the others.
TEST(Watch, E5NamesTheRightCause)
{
    struct Cause {
        std::vector<std::string> set;
        const char* words;
    };
    const std::vector<Cause> causes{
        {{"time.step=1e-4"}, "the fixed `time.step` is too long"},
        {{"time.cfl=0.9"}, "`time.cfl` = 0.9 is too large"},
        {{"domain.min=[-0.2, 0.0, -0.2]", "domain.max=[0.6, 0.0, 1.2]"},
         "[domain] is too small: `fluid.block[0]` reaches beyond it"},
        {{"fluid.viscosity.model=none"}, "`fluid.viscosity.model` is \"none\""},
        {{"fluid.viscosity.alpha=0"}, "its coefficient in [fluid.viscosity] is 0"},
        {{"fluid.sound_speed=12"}, "`fluid.sound_speed` is too low"},
        {{}, "an overlap at the start"}};
    for (const Cause& cause : causes) {
        Simulation sim = make(tank, cause.set);
        advance(sim, 1);
        sim.fluid->particles.fluid[field::velocity][0] = {1e6, 0, 0};
        const std::string text = said([&] { watch(sim, survey(sim)); });
        for (const Cause& other : causes) {
            EXPECT_EQ(text.find(other.words) != std::string::npos, &other == &cause)
                << other.words << " in: " << text;
        }
        Totals more = totals(sim);
        more.fluid_kinetic = more.fluid_kinetic + 1e9;
        if (sim.plan.fluid->drive.isZero(0)) {
            expect_words(said([&] { watch_energy(sim, more); }), {cause.words});
        }
    }
}

TEST(Watch, EnergyFromNowhereIsTold)
{
    Simulation sim = make(tank);
    advance(sim, 20);
    EXPECT_EQ(said([&] { watch_energy(sim, totals(sim)); }), "");
    Totals more = totals(sim);
    // 500 kg/m could fall by 1.2 m, margins included: a hundredth of that is 59 J/m.
    more.fluid_kinetic += 100;
    expect_words(said([&] { watch_energy(sim, more); }), {"whole scene", "energy has grown by"});
    sim.fluid->parameters.drive = {1, 0, 0};
    EXPECT_EQ(said([&] { watch_energy(sim, more); }), "") << "something drives it";
}

TEST(Watch, AtRestNeitherNoiseNorRoundOffIsTrouble)
{
    Simulation sim = make(crates);
    for (int k = 0; k < 200; ++k) {
        step_on(sim);
        watch_energy(sim, totals(sim));
    }
    EXPECT_EQ(sim.clock.step, 200);
}

} // namespace
} // namespace hyoryu::test_watch
