// SPDX-License-Identifier: MIT
// A run that is saved and taken up again goes on with the same bits, whatever effects it has and
// whenever that is: every combination of them that a case allows, each at steps drawn at random.
#include "runs.hpp"

#include "hyoryu/sim/frames.hpp"
#include "hyoryu/sim/gauges.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

namespace hyoryu::test_restart {
namespace {

struct Features {
    bool mps, shifting, recorded, exact, periodic, bodies, moving;
};

// Bits of a number; a period allows neither bodies nor walls that move, MPS no shifting.
std::vector<Features> combinations()
{
    std::vector<Features> all;
    for (unsigned n = 0; n < 128; ++n) {
        const auto bit = [n](unsigned k) { return (n >> k & 1) != 0; };
        const Features f{bit(0), bit(1), bit(2), bit(3), bit(4), bit(5), bit(6)};
        if ((!f.periodic || (!f.bodies && !f.moving)) && (!f.mps || !f.shifting)) {
            all.push_back(f);
        }
    }
    return all;
}

// Both forms of its continuity, by the precision.
const char* shifting_of(const Features& f)
{
    return !f.shifting ? R"({ model = "none" })"
           : f.exact   ? R"({ model = "sun", continuity = "conservative" })"
                       : R"({ model = "sun" })";
}

std::string head_of(const Features& f)
{
    return fmt::format(
        "dimensions = 2\n[time]\nend = 10.0\n[particles]\nspacing = 0.04\nprecision = \"{}\"\n"
        "[fluid]\nformulation = \"{}\"\nshifting = {}\n[[fluid.block]]\nshape = \"box\"\n"
        "min = [0.0, 0.0, 0.0]\nmax = [{}, 0.0, 0.4]\nvelocity = [0.5, 0.0, 0.0]\n",
        f.exact ? "double" : "single", f.mps ? "mps" : "sph", shifting_of(f),
        f.periodic ? 1.2 : 0.6);
}

std::string walls_of(const Features& f)
{
    std::string text = f.periodic
                           ? "[domain]\nmin = [0.0, 0.0, 0.0]\nmax = [1.2, 0.0, 1.0]\n"
                             "periodic = [\"x\"]\n[[wall]]\nname = \"basin\"\nshape = \"plane\"\n"
                           : "[[wall]]\nname = \"basin\"\nshape = \"basin\"\n"
                             "min = [0.0, 0.0, 0.0]\nmax = [1.2, 0.0, 1.0]\nopen = [\"+z\"]\n";
    if (f.moving) {
        text += "[[wall]]\nname = \"ram\"\nshape = \"box\"\nmin = [0.8, 0.0, 0.02]\n"
                "max = [1.2, 0.0, 0.5]\nmotion.velocity = [-0.8, 0.0, 0.0]\n";
    }
    return text;
}

// Two crates on top of each other, which water and ram reach, and a ball that falls into the water.
constexpr const char* bodies = R"(
[[body]]
name = "crate"
shape = "box"
size = [0.16, 0.0, 0.16]
density = 500.0
position = [0.7, 0.0, 0.08]
copies = { count = [1, 1, 2], pitch = [0.0, 0.0, 0.16] }
[[body]]
name = "ball"
shape = "sphere"
radius = 0.08
density = 700.0
position = [0.3, 0.0, 0.5]
velocity = [0.0, 0.0, -1.0]
)";

constexpr const char* gauges = R"(
[[gauge]]
name = "p"
type = "pressure"
at = [0.1, 0.0, 0.1]
filter = "exponential"
window = 0.02
[[gauge]]
name = "wall"
type = "force"
on = "basin"
filter = "mean"
window = 0.01
)";

std::string case_of(const Features& f)
{
    return head_of(f) + walls_of(f) + (f.bodies ? bodies : "") + (f.recorded ? gauges : "");
}

// The rows of the gauges of so many steps.
std::vector<std::vector<double>> rows(Simulation& sim, int steps)
{
    std::vector<std::vector<double>> all;
    for (int k = 0; k < steps; ++k) {
        step_on(sim);
        all.push_back(next_gauge_row(sim));
        sim.clock.gauge += 1;
    }
    return all;
}

TEST(Restart, GoesOnWithTheSameBitsInEveryCombinationAtAnyStep)
{
    const char* const seed = std::getenv("HYORYU_SEED");
    std::mt19937 random(seed == nullptr ? 1U : static_cast<unsigned>(std::atoi(seed)));
    int hit = 0;
    for (const Features& f : combinations()) {
        const std::string text = case_of(f);
        const int before = static_cast<int>(random() % 60);
        const int after = 1 + static_cast<int>(random() % 40);
        SCOPED_TRACE(fmt::format("{} steps, then {}, of\n{}", before, after, text));
        Simulation whole = make(text);
        rows(whole, before);
        hit += whole.contacts.empty() ? 0 : 1;
        const Snapshot middle = save(whole);
        const auto rest = rows(whole, after);
        Simulation resumed = make_blank(text);
        restore(resumed, middle);
        EXPECT_EQ(rows(resumed, after), rest);
        expect_same_bits(save(whole), save(resumed));
    }
    EXPECT_GT(hit, 0) << "some were saved with bodies in contact";
}

// What the summary tells of a run is of all its steps, however often it was taken up again.
TEST(Restart, WorkIsThatOfTheWholeRun)
{
    const std::string text = case_of({.exact = true, .bodies = true});
    Simulation whole = make(text);
    advance(whole, 70);
    Simulation resumed = make(text);
    advance(resumed, 25);
    for (const int steps : {30, 15}) {
        const Snapshot saved = save(resumed);
        resumed = make_blank(text);
        restore(resumed, saved);
        advance(resumed, steps);
    }
    EXPECT_EQ(resumed.steps_by_limit, whole.steps_by_limit);
    EXPECT_GT(whole.pair_visits, 0);
    EXPECT_LT(resumed.pair_visits, whole.pair_visits) << "those of this process alone";
    EXPECT_EQ(resumed.earlier_visits + resumed.pair_visits, whole.pair_visits);
}

TEST(Restart, OfACheckpointWithoutWorkCountsFromThere)
{
    const std::string text = case_of({});
    Simulation begun = make(text);
    advance(begun, 20);
    Snapshot old = save(begun);
    EXPECT_GT(std::erase_if(old.arrays, [](const auto& a) { return a.first.starts_with("work/"); }),
              1U);
    Simulation resumed = make_blank(text);
    restore(resumed, old);
    advance(begun, 10);
    advance(resumed, 10);
    long long steps = 0;
    for (const auto& [limit, count] : resumed.steps_by_limit) {
        steps += count;
    }
    EXPECT_EQ(steps, 10);
    EXPECT_EQ(resumed.earlier_visits, 0);
    EXPECT_EQ(save(resumed).arrays.at("fluid/Position").values,
              save(begun).arrays.at("fluid/Position").values);
}

// A gate that the water is pressed against at the start, and that then stands above it: what was
// wet then and is dry when the run is taken up again must show no pressure, from the first step on.
TEST(Restart, FramesOfMovingWallsAreTheSame)
{
    const Features f{};
    const std::string text =
        head_of(f) + walls_of(f) +
        "[[wall]]\nname = \"gate\"\nshape = \"box\"\nmin = [0.6, 0.0, 0.02]\n"
        "max = [0.72, 0.0, 0.7]\n"
        "motion = { times = [0.0, 0.3], places = [[0.0, 0.0, 0.0], [0.0, 0.0, 0.7]] }\n";
    for (const double before : {0.01, 0.1, 0.2, 0.3, 0.35}) {
        Simulation whole = make(text);
        while (whole.clock.time < before) {
            step_on(whole);
        }
        Simulation resumed = make_blank(text);
        restore(resumed, save(whole));
        for (int after = 1; after < 6; ++after) {
            step_on(whole);
            step_on(resumed);
            const Cloud a = wall_cloud(whole);
            const Cloud b = wall_cloud(resumed);
            EXPECT_EQ(a.points, b.points);
            for (std::size_t k = 0; k < a.columns.size(); ++k) {
                EXPECT_EQ(a.columns[k].values, b.columns[k].values)
                    << a.columns[k].name << ", " << before << " s + " << after << " steps";
            }
        }
    }
}

} // namespace
} // namespace hyoryu::test_restart
