// SPDX-License-Identifier: MIT
// A case that several ranks share has the bits of one process: particles, bodies, sums and clock.
// The ranks are threads of this process.
#include "open_scenes.hpp"
#include "shared_runs.hpp"

#include <fmt/ranges.h>

namespace hyoryu::test_ranks {
namespace {

using namespace shared_runs;

TEST(Ranks, AFluidWithoutSolidsHasTheBitsOfOneProcess)
{
    expect_ranks_agree(drop, {}, {2, 3, 7}, 200);
}

TEST(Ranks, ADamBreakHasTheBitsOfOneProcess)
{
    expect_ranks_agree(dam, {}, {1, 2, 3, 4, 7, 13}, 300);
}

TEST(Ranks, CratesThatAreSweptAlongHaveTheBitsOfOneProcess)
{
    expect_ranks_agree(dam + crates, {}, {2, 3, 7}, 500);
}

TEST(Ranks, AMovingWallAndAFloatInSpaceHaveTheBitsOfOneProcess)
{
    expect_ranks_agree(tank, {}, {2, 5}, 150);
}

TEST(Ranks, FrictionOnWhatMovesHasTheBitsOfOneProcess)
{
    const std::string gauges =
        "[[gauge]]\nname = \"on paddle\"\ntype = \"force\"\non = \"paddle\"\n"
        "[[gauge]]\nname = \"on float\"\ntype = \"force\"\non = \"float\"\n"
        "[[gauge]]\nname = \"on basin\"\ntype = \"force\"\non = \"basin\"\n";
    const std::vector<std::string> sticking{"fluid.walls=\"no_slip\"",
                                            "fluid.viscosity.model=\"laminar\"",
                                            "fluid.viscosity.kinematic=1e-3"};
    for (const Cutting cutting : {Cutting::once, Cutting::at_random}) {
        expect_ranks_agree(tank + gauges, sticking, {2, 5}, 100, cutting);
    }
}

TEST(Ranks, CratesThatStandInWaterHaveTheBitsOfOneProcess)
{
    const std::string pool = R"(
title = "crates that stand in a pool"
dimensions = 2
[time]
end = 2
[particles]
spacing = 0.04
[fluid]
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [1.6, 0, 0.5]
[[wall]]
name = "basin"
shape = "basin"
min = [0, 0, 0]
max = [1.6, 0, 1]
open = ["+z"]
[[body]]
name = "lower"
shape = "box"
size = [0.4, 1, 0.16]
density = 1400
position = [0.7, 0, 0.08]
[[body]]
name = "upper"
shape = "box"
size = [0.2, 1, 0.2]
density = 1100
position = [0.7, 0, 0.26]
[[body]]
name = "neighbour"
shape = "box"
size = [0.2, 1, 0.2]
density = 1300
position = [1.03, 0, 0.1]
)";
    expect_ranks_agree(pool, {}, {2, 5}, 150);
    expect_ranks_agree(pool, {}, {4}, 150, Cutting::at_random);
}

TEST(Ranks, AJetThatSurfacesHoldHasTheBitsOfOneProcess)
{
    const std::string jet = R"(
title = "a jet against thin plates, one of which is free"
dimensions = 2
[time]
end = 2
[particles]
spacing = 0.04
[domain]
min = [-2, 0, -2]
max = [2, 0, 2]
[fluid]
[[fluid.block]]
shape = "box"
min = [-0.6, 0, -0.2]
max = [-0.2, 0, 0.2]
velocity = [8, 0, 0]
[[wall]]
name = "plate"
shape = "box"
size = [0.03, 1, 0.5]
position = [0, 0, 0.25]
rotation_deg = { axis = [0, 1, 0], angle = 12 }
[[body]]
name = "free plate"
shape = "box"
size = [0.03, 1, 0.5]
density = 1000
position = [0, 0, -0.26]
)";
    const Case of(jet, {});
    Simulation sim = of.start(nullptr);
    std::size_t hits = 0;
    for (int k = 0; k < 350; ++k) {
        step_on(sim);
        hits += hits_of_step(*sim.barrier);
    }
    ASSERT_GT(hits, 20U) << "the scene does not show what it is for";
    expect_ranks_agree(jet, {}, {2, 5}, 350);
    expect_ranks_agree(jet, {}, {3}, 350, Cutting::at_random);
}

TEST(Ranks, APeriodicDomainHasTheBitsOfOneProcess)
{
    expect_ranks_agree(ring, {}, {2, 3, 7}, 200);
    expect_ranks_agree(ring, {"fluid.shifting.model=\"sun\""}, {3}, 100);
    expect_ranks_agree(
        ring, {"fluid.shifting.model=\"sun\"", "fluid.shifting.continuity=\"conservative\""},
        {2, 5}, 100);
}

TEST(Ranks, CutsAtRandomChangeNothing)
{
    expect_ranks_agree(dam + crates, {}, {2, 3, 4, 5}, 200, Cutting::at_random);
    expect_ranks_agree(tank, {}, {3}, 80, Cutting::at_random);
    expect_ranks_agree(ring, {}, {3}, 100, Cutting::at_random);
    expect_ranks_agree(drop, {}, {4}, 100, Cutting::at_random);
}

TEST(Ranks, EveryEffectHasTheBitsOfOneProcess)
{
    for (const std::vector<std::string>& overrides : std::vector<std::vector<std::string>>{
             {"particles.precision=\"double\""},
             {"fluid.formulation=\"mps\""},
             {"fluid.gradient=\"corrected\"", "fluid.kernel=\"isotropic\""},
             {"fluid.wall_continuity=\"paired\""},
             {"fluid.wall_continuity=\"paired\"", "fluid.gradient=\"corrected\"",
              "fluid.walls=\"no_slip\"", "fluid.viscosity.model=\"laminar\"",
              "fluid.viscosity.kinematic=1e-3"},
             {"fluid.walls=\"no_slip\"", "fluid.viscosity.model=\"laminar\"",
              "fluid.viscosity.kinematic=1e-3"},
             {"fluid.walls=\"no_slip\"", "fluid.viscosity.model=\"sps\"",
              "fluid.viscosity.kinematic=1e-3"},
             {"fluid.density_diffusion.model=\"antuono\""},
             {"fluid.cavitation.model=\"void\""},
             {"fluid.collision.model=\"dynamic\""}}) {
        SCOPED_TRACE(fmt::format("{}", fmt::join(overrides, ", ")));
        expect_ranks_agree(dam + crates, overrides, {3}, 300);
        expect_ranks_agree(dam + crates, overrides, {3}, 100, Cutting::at_random);
    }
}

TEST(Ranks, ACheckpointShowsNoRanksAndServesAnyNumberOfThem)
{
    for (const std::vector<std::string>& overrides : std::vector<std::vector<std::string>>{
             {},
             {"fluid.walls=\"no_slip\"", "fluid.viscosity.model=\"laminar\"",
              "fluid.viscosity.kinematic=1e-3"}}) {
        for (const std::string& text : {dam + crates, tank, ring}) {
            const Case of(text, overrides);
            Simulation one = of.start(nullptr);
            run(one, 70);
            const Snapshot middle = save(one);
            run(one, 50);
            const Snapshot end = save(one);
            const Snapshot of_three = saved(of, 3, 70);
            expect_same_bits(of_three, middle);
            for (const int ranks : {1, 2, 5}) {
                SCOPED_TRACE(fmt::format("{}, then {} ranks", of.scene.title, ranks));
                expect_same_bits(saved(of, ranks, 50, &of_three), end);
            }
        }
    }
}

// The state of ranks in parts of groups of them, read by the ranks that take it up.
struct SavedParts {
    Snapshot common;
    std::vector<Snapshot> parts;
};

SavedParts saved_in_parts(const Case& of, int ranks, int most, int steps)
{
    SavedParts saved;
    const Groups groups = group_ranks(ranks, most);
    saved.parts.resize(static_cast<std::size_t>(groups.count));
    test_help::on_ranks(ranks, [&](Comm& comm) {
        Simulation sim = of.start(&comm);
        run(sim, steps);
        Snapshot state = save(sim);
        Snapshot particles = gather_particles(sim, comm, groups, take_particles(sim, state));
        if (groups.leads(comm.rank())) {
            saved.parts[static_cast<std::size_t>(groups.of(comm.rank()))] = std::move(particles);
        }
        if (comm.rank() == 0) {
            saved.common = std::move(state);
        }
    });
    return saved;
}

Snapshot continued(const Case& of, const SavedParts& from, int ranks, int steps)
{
    const auto state_for = [&](int rank) {
        return StateParts{.common = rank == 0 ? from.common : Snapshot{},
                          .count = static_cast<int>(from.parts.size()),
                          .particles = [&from, rank, ranks](int part) {
                              EXPECT_EQ(part % ranks, rank);
                              return from.parts[static_cast<std::size_t>(part)];
                          }};
    };
    if (ranks == 1) {
        Simulation sim = of.blank(nullptr);
        restore(sim, nullptr, state_for(0));
        run(sim, steps);
        return save(sim);
    }
    Snapshot state;
    test_help::on_ranks(ranks, [&](Comm& comm) {
        Simulation sim = of.blank(&comm);
        restore(sim, &comm, state_for(comm.rank()));
        run(sim, steps);
        Snapshot whole = save_whole(sim, comm);
        if (comm.rank() == 0) {
            state = std::move(whole);
        }
    });
    return state;
}

// Particles, walls that move, friction of the last step and bodies are in the parts: none is lost
// or taken twice, whatever number of parts, of ranks that wrote and of ranks that read.
TEST(Ranks, AStateInPartsServesAnyNumberOfThem)
{
    Dice dice(3);
    for (const std::string& text : {dam + crates, tank, ring}) {
        const Case of(text, {"fluid.walls=\"no_slip\"", "fluid.viscosity.model=\"laminar\"",
                             "fluid.viscosity.kinematic=1e-3"});
        Simulation one = of.start(nullptr);
        run(one, 100);
        const Snapshot end = save(one);
        for (int k = 0; k < 5; ++k) {
            const int ranks = 2 + dice.below(6);
            const int most = 1 + dice.below(ranks);
            const int readers = k == 0 ? 1 : 2 + dice.below(6);
            SCOPED_TRACE(fmt::format("{}: {} ranks, at most {} parts, then {} ranks",
                                     of.scene.title, ranks, most, readers));
            const SavedParts saved = saved_in_parts(of, ranks, most, 60);
            EXPECT_EQ(std::ssize(saved.parts), most);
            expect_same_bits(continued(of, saved, readers, 40), end);
        }
    }
}

TEST(Ranks, OpenSidesHaveTheBitsOfOneProcess)
{
    const std::string river = case_of({.near = inflow(0.4, 0.3)});
    expect_ranks_agree(river + crate_afloat, {}, {2, 5}, 300);
    expect_ranks_agree(river + crate_afloat, {}, {3}, 150, Cutting::at_random);
    expect_ranks_agree(case_of({.dimensions = 3, .spacing = 0.08, .near = inflow(0.4, 0.5)}), {},
                       {3}, 100);
    expect_ranks_agree(case_of({.velocity = 1.2, .far = "kind = \"outflow\"\n"}), {}, {3}, 200);
}

// HYORYU_SCENES=200 is the nightly size, HYORYU_SEED the first seed.
TEST(Ranks, ScenesDrawnAtRandomHaveTheBitsOfOneProcess)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_SCENES", 10);
    for (int seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE(fmt::format("HYORYU_SEED={} HYORYU_SCENES=1", seed));
        const std::string text = random_scene::scene_of(static_cast<std::uint64_t>(seed));
        const Cutting cutting = seed % 2 == 0 ? Cutting::at_random : Cutting::once;
        expect_ranks_agree(text, {}, {3}, 150, cutting);
    }
}

} // namespace
} // namespace hyoryu::test_ranks
