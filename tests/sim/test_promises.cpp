// SPDX-License-Identifier: MIT
// Same bits for any thread count and across a restart; absent effects cost nothing; momentum
// closes.
#include "runs.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_promises {
namespace {

constexpr const char* flood = R"(
title = "small flood"
[time]
end = 10.0
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.6, 0.6, 0.6]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [2.0, 0.6, 1.0]
open = ["+z"]
[[body]]
name = "crate"
shape = "box"
size = [0.3, 0.3, 0.3]
density = 400.0
position = [0.9, 0.31, 0.15]
[[body]]
name = "ball"
shape = "sphere"
radius = 0.15
density = 600.0
position = [1.25, 0.3, 0.4]
)";

std::string with_precision(std::string text, const std::string& precision)
{
    const std::string table = "[particles]\n";
    return text.insert(text.find(table) + table.size(), "precision = \"" + precision + "\"\n");
}

TEST(Promises, SameBitsForOneTwoAndThreeThreads)
{
    set_threads(1);
    Simulation one = make(flood);
    advance(one, 150);
    for (const int threads : {2, 3}) {
        set_threads(threads);
        Simulation more = make(flood);
        advance(more, 150);
        expect_same_bits(save(one), save(more));
    }
    set_threads(0);
}

TEST(Promises, AResumedRunContinuesWithTheSameBits)
{
    Simulation whole = make(flood);
    advance(whole, 90);
    const Snapshot middle = save(whole);
    advance(whole, 85);

    Simulation resumed = make_blank(flood);
    restore(resumed, middle);
    advance(resumed, 85);
    expect_same_bits(save(whole), save(resumed));
}

// The crate stands on the floor in the flood, the ball falls onto it.
TEST(Promises, PenaltyMethodResumesWithTheSameBitsAndClosesMomentum)
{
    const std::string text = std::string(flood) + "[contact]\nmethod = \"penalty\"\n"
                                                  "[contact.penalty]\nstep = 1e-4\n";
    Simulation whole = make(text);
    advance(whole, 40);
    const Snapshot middle = save(whole);
    advance(whole, 40);

    Simulation resumed = make_blank(text);
    restore(resumed, middle);
    advance(resumed, 40);
    expect_same_bits(save(whole), save(resumed));
    EXPECT_TRUE(whole.plan.runs("contact_penalty"));
    EXPECT_FALSE(whole.contacts.empty());
    EXPECT_LE(whole.conservation.worst_closure, 2e-7); // of sums in single precision
    EXPECT_EQ(whole.rigid.counters.rounds, 0);         // nothing of the impulse method ran
}

TEST(Promises, ImpactLawReachesTheSolver)
{
    // A box that lands on one edge of the floor: under the law of the paper it leaves another way.
    const std::string text = R"(
[time]
end = 1.0
step = 0.001
[particles]
spacing = 0.05
[[wall]]
shape = "plane"
[[body]]
shape = "box"
size = [0.2, 0.2, 0.2]
density = 500.0
position = [0.0, 0.0, 0.2]
rotation_deg = { axis = [0, 1, 0], angle = 10.0 }
[contact]
law = ")";
    std::vector<double> speeds;
    for (const char* law : {"coupled", "paper"}) {
        Simulation sim = make(text + law + "\"\n");
        EXPECT_TRUE(sim.plan.runs(std::string("law_") + law));
        advance(sim, 150);
        speeds.push_back(sim.rigid.bodies[0].velocity.x());
    }
    EXPECT_GT(std::abs(speeds[0] - speeds[1]), 0.01);
}

TEST(Promises, MomentumOfFluidBodiesAndWallsCloses)
{
    // Pair forces are equal and opposite bit for bit; what is left is the rounding of their sums.
    const std::pair<const char*, double> bounds[] = {{"single", 2e-7}, {"double", 1e-10}};
    for (const auto& [precision, bound] : bounds) {
        Simulation sim = make(with_precision(flood, precision));
        advance(sim, 300);
        EXPECT_LE(sim.conservation.worst_closure, bound) << precision;
        EXPECT_GT(sim.conservation.worst_closure, 0); // it was measured at all
        EXPECT_EQ(sim.fluid->lost.count, 0);
    }
}

// Lists serve for several steps, with skins that follow the motion: in none of them may a pair
// within the support be missing.
TEST(Promises, EveryPairWithinTheSupportIsListedAtEveryStep)
{
    Simulation sim = make(flood);
    const Filling filling = fill(sim.scene); // with every wall, near water or not
    for (int k = 0; k < 20; ++k) {
        advance(sim, 12);
        update_neighbours(*sim.fluid); // as a step does in its middle
        const FluidNeighbours& n = sim.fluid->neighbours;
        const Particles& particles = sim.fluid->particles;
        std::vector<Vec3> by_slot;
        std::vector<Vec3> all;
        const auto add = [&](const Store& store, const Tiles& tiles) {
            const auto x = store[field::position];
            for (const std::int32_t row : tiles.row) {
                by_slot.push_back(x[row]);
            }
        };
        add(particles.fluid, n.fluid);
        add(particles.wall, n.wall);
        add(particles.body, n.body);
        for (const Store* store : {&particles.fluid, &particles.body}) {
            const auto x = (*store)[field::position];
            all.insert(all.end(), x.begin(), x.end());
        }
        ASSERT_EQ(by_slot.size(), static_cast<std::size_t>(particles.size()));
        all.insert(all.end(), filling.wall.begin(), filling.wall.end());
        const auto near = [&](const Vec3& a, const Vec3& b) {
            return (a - b).norm() < sim.fluid->kernel.support;
        };
        const auto place = [&](Index slot) { return by_slot[static_cast<std::size_t>(slot)]; };
        Index listed = 0;
        for (const PairList* list : {&n.fluid_fluid, &n.fluid_solid}) {
            list->for_each_pair(
                [&](Index i, Index j) { listed += near(place(i), place(j)) ? 1 : 0; });
        }
        Index pairs = 0;
        for (const Vec3& a : particles.fluid[field::position]) {
            for (const Vec3& b : all) {
                pairs += near(a, b) ? 1 : 0;
            }
        }
        ASSERT_EQ(listed, pairs) << "after step " << sim.clock.step;
    }
    EXPECT_GT(sim.clock.step, 2 * sim.fluid->neighbours.builds); // they did serve
}

TEST(Promises, WithoutFluidThereAreNoParticlesListsOrSweeps)
{
    Simulation sim = make(R"(
[time]
end = 1.0
[particles]
spacing = 0.05
[[body]]
shape = "box"
size = [0.1, 0.1, 0.1]
density = 500.0
position = [0.0, 0.0, 1.0]
)");
    advance(sim, 10);
    EXPECT_FALSE(sim.fluid.has_value());
    EXPECT_TRUE(sim.plan.fields.empty());
    EXPECT_TRUE(sim.plan.pair_kinds.empty());
    EXPECT_EQ(sim.plan.counts.particles(), 0);
    EXPECT_FALSE(sim.plan.runs("contact")); // alone in space
    EXPECT_FALSE(sim.rigid.penalty);
    for (const auto& stage : sim.timer.stages()) {
        const bool needed =
            stage.name == "bodies" || stage.name == "books" || stage.name == "watch";
        EXPECT_TRUE(needed) << stage.name;
    }
}

TEST(Promises, WithoutBodiesThereAreNoBodyPairsAndNoContact)
{
    const std::string text = flood;
    Simulation sim = make(text.substr(0, text.find("[[body]]")));
    advance(sim, 10);
    EXPECT_FALSE(sim.plan.runs("contact"));
    EXPECT_FALSE(sim.plan.runs("body_load"));
    EXPECT_TRUE(sim.fluid->neighbours.body_solid.empty());
    EXPECT_TRUE(sim.fluid->neighbours.wall_body.empty());
    EXPECT_EQ(sim.rigid.counters.rounds, 0);
    for (const auto& kind : sim.plan.pair_kinds) {
        EXPECT_EQ(kind.name.find("body"), std::string::npos) << kind.name;
    }
}

TEST(Promises, AnAbsentEffectHasNoField)
{
    const Simulation with = make(flood);
    const Scene plain = parse_case(
        flood, "test.toml", {"fluid.viscosity.model=none", "fluid.density_diffusion.model=none"});
    const Filling filling = fill(plain);
    Simulation without = make_simulation(plain, make_plan(plain, filling), filling);
    EXPECT_TRUE(with.fluid->particles.fluid.has(field::viscous_force));
    EXPECT_TRUE(with.fluid->particles.fluid.has(field::diffusion_rate));
    EXPECT_FALSE(without.fluid->particles.fluid.has(field::viscous_force));
    EXPECT_FALSE(without.fluid->particles.fluid.has(field::diffusion_rate));
    EXPECT_LT(without.plan.fields.size(), with.plan.fields.size());
    EXPECT_FALSE(without.plan.runs("artificial_viscosity"));
    advance(without, 20); // and runs without them
}

TEST(Promises, AnEffectOfNoStrengthGivesTheBitsOfItsAbsence)
{
    // alpha = 0 switches the effect off; the run equals one whose model is "none" bit for bit.
    const auto state = [](const std::vector<std::string>& overrides) {
        const Scene scene = parse_case(flood, "test.toml", overrides);
        const Filling filling = fill(scene);
        Simulation sim = make_simulation(scene, make_plan(scene, filling), filling);
        advance(sim, 60);
        return save(sim);
    };
    expect_same_bits(state({"fluid.viscosity.alpha=0"}), state({"fluid.viscosity.model=none"}));
}

} // namespace
} // namespace hyoryu::test_promises
