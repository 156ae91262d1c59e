// SPDX-License-Identifier: MIT
// What rank 0 deals out to the others at the start and of a checkpoint, and what it gathers from
// them for gauges.
#include "gauge_scenes.hpp"
#include "open_scenes.hpp"
#include "shared_runs.hpp"

#include "hyoryu/core/error.hpp"

#include <bit>

namespace hyoryu::test_ranks_start {
namespace {

using namespace shared_runs;

// Runs ranks and one process to the middle and the end, from checkpoints of each other.
void expect_checkpoints_serve(const std::string& text, const std::vector<std::string>& overrides,
                              int before, int after)
{
    const Case of(text, overrides);
    Simulation one = of.start(nullptr);
    run(one, before);
    const Snapshot middle = save(one);
    run(one, after);
    const Snapshot end = save(one);
    const Snapshot of_three = saved(of, 3, before);
    expect_same_bits(of_three, middle);
    for (const int ranks : {1, 2, 5, 13}) {
        SCOPED_TRACE(fmt::format("then {} ranks", ranks));
        expect_same_bits(saved(of, ranks, after, &of_three), end);
    }
}

TEST(RanksAtTheStart, CheckpointsWithOpenSidesServeAnyNumberOfRanks)
{
    expect_checkpoints_serve(case_of({.near = inflow(0.4, 0.3)}) + crate_afloat, {}, 70, 50);
    expect_checkpoints_serve(
        case_of({.velocity = 1.2, .near = inflow(0.4, 1.2), .far = "kind = \"outflow\"\n"}), {}, 90,
        60);
}

TEST(RanksAtTheStart, CheckpointsOfBodiesAloneServeAnyNumberOfRanks)
{
    expect_checkpoints_serve(falling_boxes(), {"body[0].position=[1,0,0.5]"}, 150, 50);
}

TEST(RanksAtTheStart, CheckpointsOfPeriodicDomainsWithWallsThatMoveServeAnyNumberOfRanks)
{
    for (const char* const walls : {"free_slip", "no_slip"}) {
        expect_checkpoints_serve(gauge_scenes::scene({2, 0.04, "\"x\"", true, walls}), {}, 60, 40);
        expect_checkpoints_serve(gauge_scenes::scene({3, 0.04, "\"y\"", true, walls}), {}, 12, 8);
    }
}

// HYORYU_SCENES=200 is the nightly size, HYORYU_SEED the first seed.
TEST(RanksAtTheStart, CheckpointsOfScenesDrawnAtRandomServeAnyNumberOfRanks)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_SCENES", 5);
    for (int seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE(fmt::format("HYORYU_SEED={} HYORYU_SCENES=1", seed));
        Dice dice(static_cast<std::uint64_t>(seed));
        const int before = dice.below(80);
        expect_checkpoints_serve(random_scene::scene_of(static_cast<std::uint64_t>(seed)), {},
                                 before, 1 + dice.below(40));
    }
}

std::vector<std::uint64_t> bits_of(const std::vector<double>& values)
{
    std::vector<std::uint64_t> bits;
    for (const double value : values) {
        bits.push_back(std::bit_cast<std::uint64_t>(value)); // dry gauges read not-a-number
    }
    return bits;
}

// Rows of the gauges, one every tenth step; of ranks those of rank 0, with cuts drawn at random.
std::vector<std::vector<std::uint64_t>> gauge_rows(const Case& of, Comm* comm)
{
    Simulation sim = of.start(comm);
    Dice dice(7);
    std::vector<std::vector<std::uint64_t>> rows;
    for (int look = 0; look < 6; ++look) {
        rows.push_back(bits_of(next_gauge_row(sim)));
        if (comm != nullptr) {
            sim.fluid->ghosts->next_cuts = random_cuts(*sim.fluid, comm->size(), dice);
        }
        run(sim, 10);
    }
    return rows;
}

TEST(RanksAtTheStart, GaugesReadWhatTheyReadOfOneProcess)
{
    std::uint64_t seed = 1;
    for (const gauge_scenes::Family& f :
         {gauge_scenes::Family{2, 0.03, "", false, "free_slip"},
          gauge_scenes::Family{2, 0.03, "\"x\"", true, "no_slip"},
          gauge_scenes::Family{3, 0.06, "", true, "no_slip"},
          gauge_scenes::Family{3, 0.04, "\"x\", \"y\"", false, "free_slip"}}) {
        Dice dice(seed++);
        std::string text = gauge_scenes::scene(f);
        for (int k = 0; k < 28; ++k) {
            text += gauge_scenes::random_gauge(dice, k, f);
        }
        const Case of(text, {});
        const auto one = gauge_rows(of, nullptr);
        for (const int ranks : {2, 5}) {
            std::vector<std::vector<std::uint64_t>> many;
            test_help::on_ranks(ranks, [&](Comm& comm) {
                auto rows = gauge_rows(of, &comm);
                if (comm.rank() == 0) {
                    many = std::move(rows);
                }
            });
            EXPECT_EQ(one, many) << ranks << " ranks, " << text;
        }
    }
}

// The fault that rank 0 tells of a state that was damaged; the others do not wait for it.
std::string fault_of(const Case& of, const Snapshot& state)
{
    try {
        test_help::on_ranks(3, [&](Comm& comm) {
            Simulation sim = of.blank(&comm);
            restore(sim, &comm, one_part(sim, comm.rank() == 0 ? state : Snapshot{}));
        });
    } catch (const IoError& error) {
        return error.what();
    }
    return "";
}

TEST(RanksAtTheStart, DamagedCheckpointsAreTold)
{
    const Case of(dam + crates, {});
    const Snapshot good = saved(of, 2, 20);
    EXPECT_EQ(fault_of(of, good), "");
    const auto expect_fault = [&](const std::string& what, const auto& damage) {
        Snapshot state = good;
        damage(state);
        EXPECT_NE(fault_of(of, state).find(what), std::string::npos) << fault_of(of, state);
    };
    for (const char* const name : {"fluid/id", "fluid/Velocity", "fluid/tiles/row", "body/tiles/x",
                                   "fluid/list_steps", "bodies/position"}) {
        expect_fault("has no `" + std::string(name) + "`",
                     [&](Snapshot& state) { state.arrays.erase(name); });
    }
    const auto values = [](Snapshot& state, const char* name) -> std::vector<std::int32_t>& {
        return std::get<std::vector<std::int32_t>>(state.arrays.at(name).values);
    };
    expect_fault("tiles that do not fit",
                 [&](Snapshot& state) { values(state, "fluid/tiles/row")[5] = 1 << 30; });
    expect_fault("tiles that do not fit",
                 [&](Snapshot& state) { values(state, "fluid/tiles/start").pop_back(); });
    expect_fault("tiles that do not fit",
                 [&](Snapshot& state) { values(state, "body/tiles/row")[0] = -1; });
    expect_fault("does not fit its tiles", [&](Snapshot& state) {
        std::get<std::vector<double>>(state.arrays.at("fluid/Density").values).resize(7);
    });
    expect_fault("belongs to another case", [&](Snapshot& state) {
        std::get<std::vector<std::int64_t>>(state.arrays.at("fluid/id").values).resize(1000000);
    });
    expect_fault("without a finite position", [&](Snapshot& state) {
        std::get<std::vector<double>>(state.arrays.at("fluid/Position").values)[4] = infinity;
    });
}

} // namespace
} // namespace hyoryu::test_ranks_start
