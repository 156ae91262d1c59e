// SPDX-License-Identifier: MIT
// Runs that several ranks share, as threads of this process, and what they come to.
#pragma once

#include "../thread_ranks.hpp"
#include "random_scene.hpp"
#include "runs.hpp"

#include "hyoryu/sim/state_parts.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <map>

namespace hyoryu::shared_runs {

/// What a run comes to. Equal means equal bits.
struct Outcome {
    std::map<std::int64_t, std::array<double, 7>> fluid; // by number: place, velocity, density
    std::vector<std::array<double, 13>> bodies;
    std::vector<double> sums;

    bool operator==(const Outcome&) const = default;
};

inline void add_fluid(Outcome& outcome, const Simulation& sim)
{
    if (!sim.fluid) {
        return;
    }
    const Store& store = sim.fluid->particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    for (Index k = 0; k < store.size(); ++k) {
        outcome.fluid[store.id()[k]] = {x[k].x(), x[k].y(), x[k].z(), v[k].x(),
                                        v[k].y(), v[k].z(), rho[k]};
    }
}

inline Outcome rest_of(const Simulation& sim)
{
    Outcome outcome;
    for (const Body& b : sim.rigid.bodies) {
        outcome.bodies.push_back({b.position.x(), b.position.y(), b.position.z(), b.velocity.x(),
                                  b.velocity.y(), b.velocity.z(), b.angular_momentum.x(),
                                  b.angular_momentum.y(), b.angular_momentum.z(), b.orientation.x(),
                                  b.orientation.y(), b.orientation.z(), b.orientation.w()});
    }
    const Totals t = totals(sim);
    outcome.sums = {sim.clock.time,
                    static_cast<double>(sim.clock.step),
                    t.fluid_kinetic,
                    t.fluid_potential,
                    t.fluid_internal,
                    t.momentum.x(),
                    t.momentum.z(),
                    sim.conservation.worst_closure,
                    sim.conservation.worst_density_error,
                    sim.conservation.wall_impulse.x(),
                    sim.conservation.wall_impulse.z(),
                    sim.fluid ? static_cast<double>(sim.fluid->neighbours.builds) : 0,
                    sim.fluid ? static_cast<double>(sim.fluid->lost.count) : 0,
                    sim.fluid ? sim.fluid->lost.energy : 0};
    return outcome;
}

struct Case {
    Scene scene;
    Filling filling;
    Plan plan;

    Case(const std::string& text, const std::vector<std::string>& overrides)
        : scene(parse_case(text, "test.toml", overrides)), filling(fill(scene)),
          plan(make_plan(scene, filling))
    {
    }
    Simulation start(Comm* comm) const { return make(comm, make_simulation); }
    // To be restored.
    Simulation blank(Comm* comm) const { return make(comm, make_to_restore); }

private:
    // Of several ranks each fills a part.
    Simulation make(Comm* comm, const auto& make_of) const
    {
        if (comm == nullptr) {
            return make_of(scene, plan, filling, nullptr);
        }
        Filling own = fill(scene, {comm});
        const Plan same = make_plan(scene, own, comm);
        return make_of(scene, same, std::move(own), comm);
    }
};

inline void run(Simulation& sim, int steps)
{
    for (int k = 0; k < steps && !finished(sim.clock, sim.scene); ++k) {
        step_on(sim);
    }
}

/// What is of one step alone, in the order of the steps: list entries and skins, forces on walls
/// and gauges.
inline void add_step(std::vector<double>& history, const Simulation& sim)
{
    if (sim.fluid) {
        const FluidNeighbours& n = sim.fluid->neighbours;
        history.insert(history.end(),
                       {static_cast<double>(n.entries.fluid), static_cast<double>(n.entries.solid),
                        n.skins.fluid, n.skins.solid});
    }
    for (const Vec3& force : sim.loads.walls) {
        history.insert(history.end(), force.begin(), force.end());
    }
    for (const GaugedForce& force : sim.gauges.forces) {
        history.insert(history.end(), force.viscous.begin(), force.viscous.end());
        history.insert(history.end(), force.pressure.begin(), force.pressure.end());
    }
}

inline Outcome alone(const Case& of, int steps)
{
    Simulation sim = of.start(nullptr);
    std::vector<double> history;
    for (int k = 0; k < steps && !finished(sim.clock, sim.scene); ++k) {
        step_on(sim);
        add_step(history, sim);
    }
    Outcome outcome = rest_of(sim);
    outcome.sums.insert(outcome.sums.end(), history.begin(), history.end());
    add_fluid(outcome, sim);
    return outcome;
}

/// Cuts drawn at random, so that particles move from rank to rank at all lists; some ranks have
/// nothing.
inline Cuts random_cuts(const Fluid& fluid, int ranks, Dice& dice)
{
    const TileLattice& lattice = fluid.neighbours.fluid.lattice;
    Cuts cuts;
    for (int rank = 1; rank < ranks; ++rank) {
        const Vec3 share{dice.between(0, 1), dice.between(0, 1), dice.between(0, 1)};
        const Vec3 size = fluid.domain_max - fluid.domain_min;
        const Vec3 place = fluid.domain_min + share.cwiseProduct(size);
        cuts.first.push_back(lattice.tile_of(lattice.wrapped(place)));
    }
    std::ranges::sort(cuts.first);
    return cuts;
}

enum class Cutting { once, at_random };

/// The outcome of ranks, which each of them must have reached.
inline Outcome shared(const Case& of, int ranks, int steps, Cutting cutting)
{
    Outcome all;
    std::vector<Outcome> each(static_cast<std::size_t>(ranks));
    std::mutex one_at_a_time;
    test_help::on_ranks(ranks, [&](Comm& comm) {
        Simulation sim = of.start(&comm);
        Dice dice(static_cast<std::uint64_t>(ranks));
        std::vector<double> history;
        for (int k = 0; k < steps && !finished(sim.clock, sim.scene); ++k) {
            if (cutting == Cutting::at_random && sim.fluid) {
                sim.fluid->ghosts->next_cuts = random_cuts(*sim.fluid, ranks, dice);
            }
            step_on(sim);
            add_step(history, sim);
        }
        Outcome own = rest_of(sim);
        own.sums.insert(own.sums.end(), history.begin(), history.end());
        const std::lock_guard lock(one_at_a_time);
        add_fluid(all, sim);
        each[static_cast<std::size_t>(comm.rank())] = std::move(own);
    });
    for (const Outcome& own : each) {
        EXPECT_EQ(own, each.front()) << "the ranks disagree";
    }
    all.bodies = each.front().bodies;
    all.sums = each.front().sums;
    return all;
}

inline void expect_equal(const Outcome& one, const Outcome& many)
{
    EXPECT_TRUE(one.sums == many.sums) << "sums, or what was of a step on the way";
    EXPECT_EQ(one.bodies, many.bodies);
    ASSERT_EQ(one.fluid.size(), many.fluid.size());
    int different = 0;
    for (const auto& [id, values] : one.fluid) {
        const auto found = many.fluid.find(id);
        different += found == many.fluid.end() || found->second != values ? 1 : 0;
    }
    EXPECT_EQ(different, 0) << "particles that differ, of " << one.fluid.size();
}

inline void expect_ranks_agree(const std::string& text, const std::vector<std::string>& overrides,
                               std::initializer_list<int> ranks, int steps,
                               Cutting cutting = Cutting::once)
{
    const Case of(text, overrides);
    const Outcome one = alone(of, steps);
    for (const int count : ranks) {
        SCOPED_TRACE(fmt::format("{} ranks", count));
        expect_equal(one, shared(of, count, steps, cutting));
    }
}

inline const std::string dam = R"(
title = "dam break"
dimensions = 2
[time]
end = 2
[particles]
spacing = 0.04
[fluid]
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [0.8, 0, 0.6]
[[wall]]
name = "basin"
shape = "basin"
min = [0, 0, 0]
max = [2, 0, 1]
open = ["+z"]
)";

inline const std::string crates = R"(
[[body]]
name = "light"
shape = "box"
size = [0.2, 1, 0.16]
density = 500
position = [1.0, 0, 0.0801]
[[body]]
name = "heavy"
shape = "box"
size = [0.16, 1, 0.2]
density = 900
position = [1.4, 0, 0.1001]
)";

// Of a river 0.4 m deep.
inline const std::string crate_afloat = R"(
[[body]]
name = "crate"
shape = "box"
size = [0.15, 1, 0.15]
density = 400
position = [1.1, 0, 0.4]
)";

// Without fluid.
inline std::string falling_boxes()
{
    return R"(
title = "boxes that fall"
dimensions = 2
[time]
end = 1
[particles]
spacing = 0.04
[[wall]]
name = "ground"
shape = "plane"
)" + crates;
}

inline const std::string drop = R"(
title = "a block of fluid that a shear tears"
dimensions = 2
gravity = [0, 0, 0]
[time]
end = 1
[particles]
spacing = 0.05
[fluid]
sound_speed = 15
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [1, 0, 0.5]
velocity = [-0.7, 0, 0.2]
[[fluid.block]]
shape = "box"
min = [0, 0, 0.5]
max = [1, 0, 1]
velocity = [0.7, 0, -0.3]
)";

inline const std::string tank = R"(
title = "still water that a paddle moves"
[time]
end = 1
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [0.1, 0, 0]
max = [0.8, 0.4, 0.3]
[[wall]]
name = "basin"
shape = "basin"
min = [0, 0, 0]
max = [0.8, 0.4, 0.6]
open = ["+z"]
[[wall]]
name = "paddle"
shape = "box"
size = [0.1, 0.36, 0.5]
position = [0.05, 0.2, 0.3]
motion = { velocity = [0.05, 0, 0] }
[[body]]
name = "float"
shape = "box"
size = [0.15, 0.15, 0.1]
density = 500
position = [0.45, 0.2, 0.3]
)";

inline const std::string ring = R"(
title = "shear in a periodic box"
dimensions = 2
gravity = [0, 0, 0]
[time]
end = 1
[domain]
min = [0, 0, 0]
max = [1, 0, 1]
periodic = ["x", "z"]
[particles]
spacing = 0.05
[fluid]
sound_speed = 10
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [1, 0, 0.5]
velocity = [0.7, 0, 0.1]
[[fluid.block]]
shape = "box"
min = [0, 0, 0.5]
max = [1, 0, 1]
velocity = [-0.7, 0, -0.2]
)";

/// The state as a checkpoint has it after so many steps of ranks, which begin with a state or anew.
inline Snapshot saved(const Case& of, int ranks, int steps, const Snapshot* before = nullptr)
{
    Snapshot state;
    test_help::on_ranks(ranks, [&](Comm& comm) {
        Simulation sim = before != nullptr ? of.blank(&comm) : of.start(&comm);
        if (before != nullptr) {
            restore(sim, &comm, one_part(sim, comm.rank() == 0 ? *before : Snapshot{}));
        }
        run(sim, steps);
        Snapshot whole = save_whole(sim, comm);
        if (comm.rank() == 0) {
            state = std::move(whole);
        }
        run(sim, 1); // goes on as if nothing had been
    });
    return state;
}

} // namespace hyoryu::shared_runs
