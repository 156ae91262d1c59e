// SPDX-License-Identifier: MIT
// Bodies that stand on the ground feel the water in the joint below them, and float when it is deep
// enough. Scenes are drawn at random with fixed seeds; expected values are those of Archimedes and
// of a pressure that falls evenly from rim to rim.
#include "runs.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <random>

namespace hyoryu::test_seepage {
namespace {

// A crate in a flat tank, with water on its left and right, in a tank four times as wide.
struct Crate {
    double spacing = 0.05;
    double width = 0.8, height = 0.4; // [m]
    double left = 0.2, right = 0.2;   // levels [m]
    double density = 300;             // [kg/m3]
    std::string keys;                 // of the body
    std::string rest;                 // of the case
    std::string precision = "single";

    double weight() const { return 9.81 * density * width * height; }
    // Pressure falls evenly from rim to rim.
    double uplift() const { return 9810 * width * (left + right) / 2; }

    std::string block(double from, double to, double level) const
    {
        return level > 0 ? fmt::format("[[fluid.block]]\nshape = \"box\"\nmin = [{}, 0, 0]\n"
                                       "max = [{}, 0, {}]\n",
                                       from, to, level)
                         : "";
    }
    std::string text() const
    {
        return fmt::format("dimensions = 2\n[time]\nend = 10.0\n[particles]\nspacing = {}\n"
                           "precision = \"{}\"\n[fluid]\n{}{}"
                           "[[wall]]\nname = \"basin\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                           "max = [{}, 0, {}]\nopen = [\"+z\"]\n"
                           "[[body]]\nname = \"crate\"\nshape = \"box\"\nsize = [{}, 0, {}]\n"
                           "density = {}\nposition = [{}, 0, {}]\n{}\n{}\n",
                           spacing, precision, block(0, 1.5 * width, left),
                           block(2.5 * width, 4 * width, right), 4 * width, 4 * height, width,
                           height, density, 2 * width, height / 2, keys, rest);
    }
};

// Widths, levels in multiples of 0.1 m, which suit all spacings here.
Crate random_crate(std::mt19937& dice)
{
    const auto tenths = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(dice) / 10.0;
    };
    Crate crate;
    crate.width = tenths(6, 12);
    crate.height = tenths(4, 8);
    crate.left = crate.right = tenths(2, 4);
    return crate;
}

double mean_lift(const Crate& crate, int steps)
{
    Simulation sim = make(crate.text());
    double total = 0;
    for (int k = 0; k < steps; ++k) {
        step_on(sim);
        total += sim.loads.bodies[0].force.z() / steps;
    }
    return total;
}

TEST(Seepage, AHeldCrateFeelsThePressureOfBothRimsAtTwoSpacings)
{
    std::mt19937 dice(1);
    for (int k = 0; k < 4; ++k) {
        Crate crate = random_crate(dice);
        crate.keys = "fixed = true";
        crate.right = k % 2 == 0 ? crate.right : 0;
        for (const double spacing : {0.1, 0.05}) {
            crate.spacing = spacing;
            // Half a row of the lattice at the lower edges; the dry side has not been reached yet.
            EXPECT_NEAR(mean_lift(crate, 20) / crate.uplift(), 1, 0.05)
                << "width " << crate.width << " level " << crate.left << " | " << crate.right
                << " spacing " << spacing;
        }
    }
}

// Keel after some time in still water [m].
double keel_after(const Crate& crate, double seconds)
{
    Simulation sim = make(crate.text());
    while (sim.clock.time < seconds) {
        step_on(sim);
    }
    EXPECT_LE(sim.conservation.worst_closure, 2e-7); // of sums in single precision
    return sim.rigid.bodies[0].position.z() - crate.height / 2;
}

// Levels half a spacing below and above the draft: stands, lifts.
TEST(Seepage, ACrateLiftsAtItsDraftWithinHalfASpacing)
{
    std::mt19937 dice(2);
    for (const double spacing : {0.1, 0.05}) {
        for (int k = 0; k < 3; ++k) {
            Crate crate = random_crate(dice);
            crate.spacing = spacing;
            const double over = crate.left / crate.height * 1000;
            crate.density = over * (1 + 0.5 * spacing / crate.left);
            EXPECT_NEAR(keel_after(crate, 0.5), 0, 1e-4) << "ratio " << crate.density / 1000;
            crate.density = over * (1 - 0.5 * spacing / crate.left);
            EXPECT_GT(keel_after(crate, 0.5), 0.1 * spacing) << "ratio " << crate.density / 1000;
            crate.keys = "stands = \"sealed\"";
            EXPECT_NEAR(keel_after(crate, 0.5), 0, 1e-4) << "sealed";
        }
    }
}

// Water on one side only presses on half of the joint: the crate turns about its dry edge.
TEST(Seepage, AHalfWetRimTips)
{
    for (const double spacing : {0.05, 0.025}) {
        Crate crate{.spacing = spacing, .width = 0.6, .height = 0.6, .left = 0.3, .right = 0};
        crate.rest = "[contact]\nfriction = 5.0"; // it cannot slide
        crate.density = 330; // moments of water over weight: 1.14, without uplift 0.13
        crate.rest += "\n";
        Simulation sim = make(crate.text());
        while (sim.clock.time < 0.15) {
            step_on(sim);
        }
        const Body& body = sim.rigid.bodies[0];
        EXPECT_GT(2 * body.orientation.y(), 0.002) << spacing; // about +y: the left side rises
        crate.keys = "stands = \"sealed\"";
        sim = make(crate.text());
        while (sim.clock.time < 0.15) {
            step_on(sim);
        }
        EXPECT_LT(2 * sim.rigid.bodies[0].orientation.y(), 0.0005) << spacing;
    }
}

TEST(Seepage, TheWallBelowFeelsTheOpposite)
{
    Crate crate{.left = 0.3, .right = 0.3, .keys = "fixed = true"};
    Simulation open = make(crate.text());
    step_on(open);
    crate.keys = "fixed = true\nstands = \"sealed\"";
    Simulation sealed = make(crate.text());
    step_on(sealed);
    // All that acts on body and wall together is what the water feels, and that is the same.
    const Vec3 both = open.loads.bodies[0].force + open.loads.walls[0];
    const Vec3 before = sealed.loads.bodies[0].force + sealed.loads.walls[0];
    EXPECT_NEAR((both - before).norm(), 0, 1e-3 * crate.uplift());
    EXPECT_GT(open.loads.bodies[0].force.z(), sealed.loads.bodies[0].force.z() + 500);
}

// A held crate under water, standing on what `ground` says with its lower face at z = 0.4.
std::string on_ground(const std::string& ground, const std::string& keys, const std::string& fluid)
{
    return fmt::format("dimensions = 2\n[time]\nend = 1.0\n[particles]\nspacing = 0.05\n"
                       "[fluid]\n{}\n[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
                       "max = [3.2, 0, 1.2]\n[[wall]]\nname = \"basin\"\nshape = \"basin\"\n"
                       "min = [0, 0, 0]\nmax = [3.2, 0, 2]\nopen = [\"+z\"]\n"
                       "[[body]]\nname = \"crate\"\nshape = \"box\"\nsize = [0.8, 0, 0.4]\n"
                       "density = 500\nposition = [1.6, 0, 0.6]\nfixed = true\n{}\n{}\n",
                       fluid, keys, ground);
}

// Wholly under water its load is its buoyancy, whatever it stands on; dry below it lacks
// rho g h A, four times that.
TEST(Seepage, ASubmergedCrateFeelsItsBuoyancyOnAnyGround)
{
    const double buoyancy = 9810 * 0.8 * 0.4;
    const std::string box = "shape = \"box\"\nsize = [1.6, 0, 0.4]\nposition = [1.6, 0, 0.2]\n";
    const std::string wall = "[[wall]]\nname = \"ground\"\n" + box;
    const std::string body = "[[body]]\nname = \"ground\"\ndensity = 2000\nfixed = true\n" + box;
    const std::vector<std::array<std::string, 3>> scenes{
        {wall, "", ""},
        {body, "", ""},
        {body + "stands = \"sealed\"\n", "", ""}, // what stands decides, not what is below
        {wall, "spacing = 0.04", ""},
        {wall, "", "formulation = \"mps\""},
        {wall, "", "walls = \"no_slip\""},
    };
    for (const auto& [ground, keys, fluid] : scenes) {
        Simulation sim = make(on_ground(ground, keys, fluid));
        double lift = 0;
        for (int k = 0; k < 20; ++k) {
            step_on(sim);
            lift += sim.loads.bodies[0].force.z() / 20;
        }
        EXPECT_NEAR(lift / buoyancy, 1, 0.1) << ground << keys << fluid;
    }
}

// The floor rises with the crate on it through water at rest: the joint goes with it.
TEST(Seepage, AJointMovesWithItsGround)
{
    Crate crate{.left = 0.3, .right = 0.3, .density = 2000};
    std::string text = crate.text();
    const std::string basin = "[[wall]]\nname = \"basin\"";
    text.insert(text.find(basin),
                "[[wall]]\nname = \"lift\"\nshape = \"box\"\nmin = [1.2, 0, -0.2]\n"
                "max = [2.0, 0, 0]\n[wall.motion]\nvelocity = [0, 0, 0.2]\n");
    text.replace(text.find("min = [0, 0, 0]\nmax = [3.2"), 15, "min = [0, 0, -0.4]");
    Simulation sim = make(text);
    while (sim.clock.time < 0.2) {
        step_on(sim);
    }
    ASSERT_FALSE(sim.seepage.loads[0].empty());
    const int lift = -1; // the first wall
    for (const JointLoad& load : sim.seepage.loads[0]) {
        EXPECT_EQ(load.other, lift);
        EXPECT_NEAR(load.gap, 0, 1e-4);
    }
}

// Pressure in the joint of a crate that begins to rise, at its cell on the left [Pa].
double left_pressure(Crate crate, double speed)
{
    crate.density = 8000; // so that the drop hardly slows it in a step
    crate.keys = fmt::format("velocity = [0, 0, {}]", speed);
    Simulation sim = make(crate.text());
    step_on(sim);
    const auto& loads = sim.seepage.loads[0];
    const auto left =
        std::ranges::min_element(loads, {}, [](const JointLoad& load) { return load.point.x(); });
    return left == loads.end() ? NAN : left->pressure;
}

// Bernoulli's law: rho (A v / s)^2 / 2, s a spacing for each rim with water. Air follows by a dry
// rim, and leaves the water that comes in by the other as much to fill.
TEST(Seepage, OnlyWhatIsWetLetsWaterIntoAJointThatOpens)
{
    std::mt19937 dice(8);
    for (const double spacing : {0.1, 0.05}) {
        for (int k = 0; k < 6; ++k) {
            Crate crate = random_crate(dice);
            crate.spacing = spacing;
            const int wet = 1 + k % 2;
            crate.right = wet == 2 ? crate.left : 0;
            const double speed = 0.5 * spacing / crate.width; // 0.5 m/s by one rim
            // What the crate does to the water at the rim in a step is linear in its speed.
            const double drop = 2 * left_pressure(crate, 0) - left_pressure(crate, speed) -
                                left_pressure(crate, -speed);
            EXPECT_NEAR(drop / (500 * sq(0.5 / wet)), 1, 0.1)
                << wet << " width " << crate.width << " level " << crate.left << " spacing "
                << spacing;
        }
    }
}

// A bore meets a pyramid: what stands is lifted, and no energy comes of it.
TEST(Seepage, AJointMakesNoEnergy)
{
    std::string text = "dimensions = 2\n[time]\nend = 1\n[particles]\nspacing = 0.05\n[fluid]\n"
                       "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [0.9, 0, 0.6]\n"
                       "[[fluid.block]]\nshape = \"box\"\nmin = [2.1, 0, 0]\nmax = [3, 0, 0.6]\n"
                       "[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\nmax = [3, 0, 1.6]\n"
                       "open = [\"+z\"]\n";
    const std::array<std::array<double, 3>, 3> crates{
        {{0.4, 1.2, 0.2}, {0.4, 1.8, 0.2}, {0.8, 1.5, 0.6}}};
    for (const auto& [width, x, z] : crates) {
        text += fmt::format("[[body]]\nshape = \"box\"\nsize = [{}, 0, 0.4]\ndensity = 300\n"
                            "position = [{}, 0, {}]\n",
                            width, x, z);
    }
    for (const double spacing : {0.05, 0.025}) {
        Simulation sim = make(text, {fmt::format("particles.spacing={}", spacing)});
        const auto energy = [&] {
            const Totals t = totals(sim);
            return t.fluid_kinetic + t.fluid_potential + t.fluid_internal + t.body_kinetic +
                   t.body_potential;
        };
        const double before = energy();
        double most = 0;
        while (sim.clock.time < 0.35) {
            step_on(sim);
            most = std::max(most, energy() - before);
        }
        // Water that the joints want for the while: two spacings of 0.6 m of head under 0.8 m.
        EXPECT_LE(most, 0.02 * before) << spacing;
        EXPECT_GT(sim.rigid.bodies[2].position.z(), 0.61) << spacing;
        EXPECT_LE(sim.conservation.worst_closure, 2e-7) << spacing; // crates push each other apart
    }
}

std::string stack_of_two(const std::string& keys)
{
    Crate crate{.width = 0.8, .height = 0.4, .left = 0.2, .right = 0.2, .density = 200};
    crate.rest =
        "[[body]]\nname = \"upper\"\nshape = \"box\"\nsize = [0.8, 0, 0.4]\ndensity = 200\n"
        "position = [1.6, 0, 0.6]\n" +
        keys;
    return crate.text();
}

TEST(Seepage, AStackFloatsUpTogether)
{
    Simulation sim = make(stack_of_two(""));
    while (sim.clock.time < 0.6) {
        step_on(sim);
    }
    const double rise = sim.rigid.bodies[0].position.z() - 0.2;
    EXPECT_GT(rise, 0.01); // draft of both: 0.16 m
    EXPECT_NEAR(sim.rigid.bodies[1].position.z() - 0.6, rise, 1e-3);
    EXPECT_LE(sim.conservation.worst_closure, 2e-7);
}

// Two boxes, one on the other, in the way of shallow water that hits the lower one and splashes up:
// what it does to the lower box is no pressure in the joint above it while it stays farther below
// than a spacing, however hard it hits. The witness is the highest water beside the boxes.
TEST(Seepage, WaterFarBelowAJointDoesNotEnterIt)
{
    std::mt19937 dice(17);
    std::uniform_real_distribution<double> part(0, 1);
    for (const double dp : {0.8, 0.6, 0.05, 0.04}) {
        const double height = dp * (3.1 + 0.3 * part(dice));
        const double width = 7.5 * dp;
        const double start = dp * (17 + part(dice));
        Simulation sim = make(fmt::format(
            "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = {0}\n[fluid]\n"
            "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [{1}, 0, {2}]\n[[wall]]\n"
            "shape = \"basin\"\nmin = [0, 0, 0]\nmax = [{3}, 0, {4}]\nopen = [\"+z\"]\n[[body]]\n"
            "name = \"box\"\nshape = \"box\"\nsize = [{5}, 0, {6}]\ndensity = 60\nposition = "
            "[{7}, 0, {8}]\n[body.copies]\ncount = [1, 1, 2]\npitch = [1, 1, {6}]\n",
            dp, 12.5 * dp, 2 * dp, 37.5 * dp, 12 * dp, width, height, start + width / 2,
            height / 2));
        const double seam = height;
        double highest = 0;
        double most = 0; // force of the water on the upper box, upward [N]
        while (sim.clock.time < 12 * std::sqrt(dp / 9.81) && highest < seam - dp) {
            step_on(sim);
            for (const Vec3& x : sim.fluid->particles.fluid[field::position]) {
                highest = x.x() > start - 4 * dp ? std::max(highest, x.z() + dp / 2) : highest;
            }
            if (highest < seam - dp) {
                most = std::max(most, sim.loads.bodies[1].force.z());
            }
        }
        EXPECT_LT(most, 1e-3 * 60 * 9.81 * width * height) << "spacing " << dp;
        EXPECT_GT(highest, dp) << "water has come";
    }
}

TEST(Seepage, SameBitsForOneTwoAndThreeThreadsAndAcrossARestart)
{
    const std::string text = stack_of_two("");
    set_threads(1);
    Simulation one = make(text);
    advance(one, 60);
    const Snapshot middle = save(one);
    advance(one, 60);
    EXPECT_FALSE(one.seepage.loads[0].empty());
    for (const int threads : {2, 3}) {
        set_threads(threads);
        Simulation more = make(text);
        advance(more, 120);
        expect_same_bits(save(one), save(more));
    }
    set_threads(1);
    Simulation resumed = make_blank(text);
    restore(resumed, middle);
    advance(resumed, 60);
    expect_same_bits(save(one), save(resumed));
    set_threads(0);
}

TEST(Seepage, AJointThatIsOpenGoesOnAfterARestart)
{
    Crate crate{.left = 0.3, .right = 0.3, .density = 300};
    Simulation whole = make(crate.text());
    const auto keel = [&] { return whole.rigid.bodies[0].position.z() - crate.height / 2; };
    while (keel() < 0.4 * crate.spacing) { // too wide for a joint to begin
        step_on(whole);
    }
    const Snapshot middle = save(whole);
    advance(whole, 40);
    EXPECT_FALSE(whole.seepage.joined.empty());
    Simulation resumed = make_blank(crate.text());
    restore(resumed, middle);
    advance(resumed, 40);
    expect_same_bits(save(whole), save(resumed));
}

// A body that never comes near another solid: nothing is made for joints, no bit changes.
TEST(Seepage, CostsNothingWhereNoFaceRests)
{
    Crate crate{.left = 0.8, .right = 0.8, .density = 500};
    std::string text = crate.text();
    const std::string at = "position = [1.6, 0, 0.2]";
    text.replace(text.find(at), at.size(), "position = [1.6, 0, 0.7]");
    Simulation open = make(text);
    Simulation sealed = make(text + "\nstands = \"sealed\"\n");
    EXPECT_TRUE(open.plan.runs("seepage"));
    advance(open, 40);
    advance(sealed, 40);
    EXPECT_TRUE(open.fluid->film_cuts.capacity() == 0);
    EXPECT_TRUE(open.seepage.loads[0].capacity() == 0);
    EXPECT_TRUE(sealed.seepage.loads[0].capacity() == 0);
    expect_same_bits(save(open), save(sealed));
    const Simulation dry = make(text.substr(0, text.find("[[body]]")));
    EXPECT_FALSE(dry.plan.runs("seepage"));
    EXPECT_TRUE(dry.seepage.open.empty());
}

} // namespace
} // namespace hyoryu::test_seepage
