// SPDX-License-Identifier: MIT
// Ranks at their limits: without particles, without fluid, with a failure; and what they say to
// each other.
#include "shared_runs.hpp"

namespace hyoryu::test_ranks_limits {
namespace {

using namespace shared_runs;

TEST(RanksAtLimits, MoreRanksThanTilesAndBodiesAloneHaveTheBitsOfOneProcess)
{
    const std::string puddle = R"(
title = "a puddle that leaves the domain"
dimensions = 2
[time]
end = 1
[domain]
min = [0, 0, 0]
max = [1, 0, 1]
[particles]
spacing = 0.05
[fluid]
sound_speed = 40
[[fluid.block]]
shape = "box"
min = [0.4, 0, 0.05]
max = [0.6, 0, 0.25]
)";
    expect_ranks_agree(puddle, {}, {13}, 300);
    expect_ranks_agree(falling_boxes(), {"body[0].position=[1,0,0.5]"}, {3}, 200);
}

TEST(RanksAtLimits, ARaftOverSeveralRanksHasTheBitsOfOneProcess)
{
    const std::string raft = R"(
[[body]]
name = "raft"
shape = "box"
size = [0.7, 1, 0.12]
density = 400
position = [0.4, 0, 0.62]
)";
    expect_ranks_agree(dam + raft, {}, {4, 7}, 300);
}

// Between steps everything that a stage does not send anew is not a number, but for velocities,
// which hold until new ones are known.
TEST(RanksAtLimits, NothingIsReadOfGhostsThatWasNotSent)
{
    for (const std::vector<std::string>& overrides : std::vector<std::vector<std::string>>{
             {},
             {"fluid.gradient=\"corrected\"", "fluid.density_diffusion.model=\"antuono\""},
             {"fluid.wall_continuity=\"paired\""},
             {"fluid.walls=\"no_slip\"", "fluid.viscosity.model=\"sps\"",
              "fluid.viscosity.kinematic=1e-3"}}) {
        const Case of(dam + crates, overrides);
        Outcome one;
        {
            Simulation sim = of.start(nullptr);
            run(sim, 150);
            one = rest_of(sim);
            add_fluid(one, sim);
        }
        Outcome many;
        std::mutex one_at_a_time;
        test_help::on_ranks(3, [&](Comm& comm) {
            Simulation sim = of.start(&comm);
            for (int k = 0; k < 150; ++k) {
                poison_ghosts(*sim.fluid->ghosts, *sim.fluid);
                step_on(sim);
            }
            Outcome own = rest_of(sim);
            const std::lock_guard lock(one_at_a_time);
            add_fluid(many, sim);
            many.bodies = own.bodies;
            many.sums = own.sums;
        });
        expect_equal(one, many);
    }
}

TEST(RanksAtLimits, AFailureIsThatOfOneProcessOnAllRanks)
{
    const Case of(dam + crates, {});
    const auto failure_of = [&](Comm* comm) -> std::string {
        Simulation sim = of.start(comm);
        run(sim, 20);
        Store& store = sim.fluid->particles.fluid;
        for (Index row = 0; row < store.size(); ++row) {
            store[field::density][row] *= store.id()[row] == 77 ? 3 : 1;
        }
        try {
            run(sim, 5);
        } catch (const NumericalError& error) {
            return error.what();
        }
        return "";
    };
    const std::string one = failure_of(nullptr);
    ASSERT_NE(one, "");
    std::vector<std::string> said(3);
    test_help::on_ranks(
        3, [&](Comm& comm) { said[static_cast<std::size_t>(comm.rank())] = failure_of(&comm); });
    for (const std::string& text : said) {
        EXPECT_EQ(text, one);
    }
}

// Each rank moves all bodies; what moves them apart by a picometre must not stay unseen.
TEST(RanksAtLimits, BodiesThatDifferBetweenRanksAreNamed)
{
    const std::string ground = "dimensions = 2\n[time]\nend = 10\n[particles]\nspacing = 0.04\n"
                               "[[wall]]\nname = \"ground\"\nshape = \"plane\"\n";
    for (const auto& [text, rank, body] :
         {std::tuple(dam + crates, 0, 1), std::tuple(dam + crates, 2, 0),
          std::tuple(ground + crates, 1, 1)}) {
        const Case of(text, {});
        std::vector<std::string> said(3);
        test_help::on_ranks(3, [&](Comm& comm) {
            Simulation sim = of.start(&comm);
            run(sim, 120);
            if (comm.rank() == rank) {
                sim.rigid.bodies[static_cast<std::size_t>(body)].position.x() += 1e-12;
            }
            try {
                run(sim, 100);
            } catch (const BodiesDiffer& error) {
                said[static_cast<std::size_t>(comm.rank())] = error.what();
            }
        });
        for (const std::string& told : said) {
            EXPECT_EQ(told, said.front());
            EXPECT_NE(told.find("after step 200 the processes disagree on body"), std::string::npos)
                << told;
        }
    }
}

// Looks at what each of 50 steps without new lists has said and sent.
void look_at_steps(const Case& of, CountedComm& comm,
                   const std::function<void(const Simulation&, const Traffic&)>& look)
{
    Simulation sim = of.start(&comm);
    run(sim, 5);
    int looks = 0;
    for (int k = 0; k < 50; ++k) {
        const Traffic before = comm.traffic();
        const long long builds = sim.fluid->neighbours.builds;
        step_on(sim);
        if (sim.fluid->neighbours.builds == builds) {
            const Traffic& now = comm.traffic();
            look(sim, {.calls = now.calls - before.calls, .bytes = now.bytes - before.bytes});
            ++looks;
        }
    }
    EXPECT_GT(looks, 10);
}

// The calls of a step, see docs/processes.md. To ghosts: places, pressures of solids, velocities.
// Of all: how far particles have moved, and the survey at the end. With bodies: their loads. With
// standing bodies: the pressures of their particles.
TEST(RanksAtLimits, AStepSaysWhatTheDocumentSays)
{
    const std::string floating = R"(
[[body]]
shape = "box"
size = [0.2, 1, 0.12]
density = 400
position = [0.4, 0, 0.62]
)";
    struct Stepped {
        std::string text;
        std::vector<std::string> overrides;
        long long calls;
    };
    const std::vector<Stepped> scenes{{dam, {}, 5},
                                      {dam, {"fluid.wall_continuity=\"paired\""}, 7},
                                      {dam + floating, {}, 6},
                                      {dam + crates, {}, 7}};
    for (const Stepped& scene : scenes) {
        const Case of(scene.text, scene.overrides);
        test_help::on_ranks(3, [&](CountedComm& comm) {
            look_at_steps(of, comm, [&](const Simulation&, const Traffic& step) {
                EXPECT_EQ(step.calls, scene.calls);
            });
        });
    }
}

// What a step sends, in double precision: of each copy of fluid that lists look at its place,
// density and gap, then its velocity; of each such copy of a wall particle volume and pressure; of
// each tile with copies of fluid the bounds of its motion. Sums and maxima take 48 bytes
// a number: three displacements; momentum and its scale, a count and five maxima, and the force
// on each wall.
TEST(RanksAtLimits, AStepSendsWhatItsCopiesNeed)
{
    const Case of(dam, {});
    test_help::on_ranks(3, [&](CountedComm& comm) {
        look_at_steps(of, comm, [](const Simulation& sim, const Traffic& step) {
            const auto sent = [](const Links& links) {
                std::size_t sum = 0;
                for (const std::vector<std::int32_t>& points : links.out) {
                    sum += points.size();
                }
                return static_cast<long long>(sum);
            };
            const Ghosts& ghosts = *sim.fluid->ghosts;
            const auto walls = static_cast<long long>(sim.scene.walls.size());
            const long long copies = sent(ghosts.fluid.links);
            EXPECT_LT(copies, sent(all_links(ghosts.fluid.halo)));
            EXPECT_EQ(step.bytes, (24 + 8 + 8 + 24) * copies + 16 * sent(ghosts.wall.links) +
                                      48 * sent(ghosts.fluid.halo.tiles) +
                                      48 * (3 + 10 + 3 * walls));
        });
    });
}

} // namespace
} // namespace hyoryu::test_ranks_limits
