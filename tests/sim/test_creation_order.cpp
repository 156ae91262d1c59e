// SPDX-License-Identifier: MIT
// The state is a function of the places and numbers of particles: the order in which they were
// created changes no bit of any column, sum, load or gauge, nor does the number of threads.
#include "../dice.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <numeric>

namespace hyoryu::test_creation_order {
namespace {

enum class SceneKind { bodies, leaving, periodic, moving };

// What a seed draws. The four kinds, dimensions, formulations and precisions come in turn.
struct Draw {
    SceneKind kind;
    int dimensions;
    bool mps, exact, sticky, shifting;
    double spacing, speed, depth;
};

Draw draw_of(std::uint64_t seed)
{
    Dice dice(seed);
    const auto n = static_cast<int>(seed);
    Draw draw{.kind = static_cast<SceneKind>(n % 4), .dimensions = n / 4 % 2 == 0 ? 2 : 3};
    draw.mps = (n + n / 4) % 3 == 0;
    draw.exact = (n + n / 2) % 2 == 0;
    draw.sticky = dice.chance(0.5);
    draw.shifting = !draw.mps && dice.chance(0.5);
    const bool fine = dice.chance(0.5);
    draw.spacing = draw.dimensions == 2 ? (fine ? 0.0125 : 0.02) : (fine ? 0.04 : 0.05);
    draw.speed = dice.between(0.8, 1.8);
    draw.depth = dice.between(0.3, 0.4);
    return draw;
}

std::string fluid_of(const Draw& d)
{
    const bool periodic = d.kind == SceneKind::periodic;
    return fmt::format(
        "dimensions = {}\n[time]\nend = 10.0\n[particles]\nspacing = {}\nprecision = \"{}\"\n"
        "[domain]\nmin = [0.0, 0.0, -0.3]\nmax = [{}, 0.4, 1.2]\nperiodic = [{}]\n[fluid]\n"
        "formulation = \"{}\"\nwalls = \"{}\"\nshifting.model = \"{}\"\n[fluid.viscosity]\n"
        "model = \"laminar\"\nkinematic = 1e-3\n[[fluid.block]]\nshape = \"box\"\n"
        "min = [0.0, 0.0, 0.0]\nmax = [{}, 0.4, {}]\nvelocity = [{}, 0.0, 0.3]\n",
        d.dimensions, d.spacing, d.exact ? "double" : "single",
        d.kind == SceneKind::leaving ? 0.7 : 1.2, periodic ? "\"x\"" : "", d.mps ? "mps" : "sph",
        d.sticky ? "no_slip" : "free_slip", d.shifting ? "sun" : "none", periodic ? 1.2 : 0.55,
        d.depth, d.speed);
}

std::string walls_of(const Draw& d)
{
    const char* open = d.kind == SceneKind::periodic  ? "\"+z\", \"-x\", \"+x\""
                       : d.kind == SceneKind::leaving ? "\"+z\", \"+x\""
                                                      : "\"+z\"";
    return fmt::format(
        "[[wall]]\nname = \"basin\"\nshape = \"basin\"\nmin = [0.0, 0.0, 0.0]\n"
        "max = [1.2, 0.4, 0.8]\nopen = [{}]\n[[wall]]\nname = \"pier\"\n"
        "shape = \"box\"\nmin = [0.9, 0.1, 0.0]\nmax = [1.1, 0.3, 0.5]\n{}",
        open, d.kind == SceneKind::moving ? "[wall.motion]\nvelocity = [-0.4, 0.0, 0.0]\n" : "");
}

// A crate that stands before the water, one on top of it, and a ball that falls into the water.
constexpr const char* bodies = R"(
[[body]]
name = "crate"
shape = "box"
size = [0.2, 0.2, 0.16]
density = 500.0
position = [0.67, 0.2, 0.08]
copies = { count = [1, 1, 2], pitch = [0.0, 0.0, 0.16] }
[[body]]
name = "ball"
shape = "sphere"
radius = 0.1
density = 700.0
position = [0.3, 0.2, 0.52]
velocity = [0.0, 0.0, -1.0]
)";

constexpr const char* gauges = R"(
[[gauge]]
name = "elevation"
type = "elevation"
at = [0.4, 0.2]
[[gauge]]
name = "pressure"
type = "pressure"
at = [0.1, 0.2, 0.02]
[[gauge]]
name = "flux"
type = "flux"
at = [0.5, 0.2, 0.1]
normal = [1.0, 0.0, 0.0]
[[gauge]]
name = "force"
type = "force"
on = "basin"
)";

std::string case_of(const Draw& d)
{
    const bool has_bodies = d.kind == SceneKind::bodies || d.kind == SceneKind::moving;
    return fluid_of(d) + walls_of(d) + (has_bodies ? bodies : "") + gauges;
}

void shuffle(Dice& dice, std::span<std::int32_t> order)
{
    for (std::size_t k = order.size(); k-- > 1;) {
        std::swap(order[k], order[static_cast<std::size_t>(dice.below(static_cast<int>(k) + 1))]);
    }
}

template <class T>
void permute(std::vector<T>& values, std::span<const std::int32_t> order)
{
    const std::vector<T> before = values;
    for (std::size_t k = 0; k < values.size(); ++k) {
        values[k] = before[static_cast<std::size_t>(order[k])];
    }
}

// The rows of a store in an order drawn at random; those of each wall and body stay together.
std::vector<std::int32_t> drawn_order(Dice& dice, const Store& store)
{
    std::vector<std::int32_t> order(static_cast<std::size_t>(store.size()));
    std::iota(order.begin(), order.end(), 0);
    const auto owner = store.owner();
    for (std::size_t first = 0; first < order.size();) {
        std::size_t last = owner.empty() ? order.size() : first;
        while (last < order.size() && owner[last] == owner[first]) {
            ++last;
        }
        shuffle(dice, std::span(order).subspan(first, last - first));
        first = last;
    }
    return order;
}

// Makes the simulation anew as if its particles had been created in another order; in the same one
// with no dice.
void create_again(Simulation& sim, Dice* dice)
{
    Fluid& fluid = *sim.fluid;
    if (dice != nullptr) {
        Particles& p = fluid.particles;
        p.fluid.gather(drawn_order(*dice, p.fluid));
        const std::vector<std::int32_t> of_walls = drawn_order(*dice, p.wall);
        p.wall.gather(of_walls);
        if (!sim.wall_start.empty()) {
            permute(sim.wall_start, of_walls);
        }
        const std::vector<std::int32_t> of_bodies = drawn_order(*dice, p.body);
        p.body.gather(of_bodies);
        permute(sim.body_particles.points, of_bodies);
    }
    fluid.neighbours = FluidNeighbours();
    update_neighbours(fluid);
    update_pressure(fluid);
    update_rates(fluid);
    sim.conservation.start = totals(sim);
}

using Bits = std::map<std::string, std::vector<std::uint64_t>>;

void put(std::vector<std::uint64_t>& bits, double value)
{
    bits.push_back(std::bit_cast<std::uint64_t>(value));
}
void put(std::vector<std::uint64_t>& bits, const Vec3& value)
{
    for (const double part : value) {
        put(bits, part);
    }
}

// Every column of a store in the order of the numbers.
void add_columns_of(const Store& store, const std::string& kind, Bits& bits)
{
    std::vector<std::size_t> row(static_cast<std::size_t>(store.size()));
    std::iota(row.begin(), row.end(), std::size_t(0));
    std::ranges::sort(row, {}, [&](std::size_t k) { return store.id()[k]; });
    for (const std::size_t k : row) {
        bits[kind + "/id"].push_back(static_cast<std::uint64_t>(store.id()[k]));
    }
    store.for_each_column([&](const FieldInfo& field, const auto& values) {
        for (const std::size_t k : row) {
            put(bits[fmt::format("{}/{}", kind, field.name)], values[k]);
        }
    });
}

void add_sums(const Simulation& sim, Bits& bits)
{
    const Totals t = totals(sim);
    auto& sums = bits["sums"];
    for (const double value : {t.fluid_kinetic, t.fluid_potential, t.fluid_internal, t.body_kinetic,
                               t.body_potential, t.momentum_scale, sim.conservation.worst_closure,
                               sim.fluid->lost.energy, sim.clock.time}) {
        put(sums, value);
    }
    put(sums, t.momentum);
    put(sums, sim.conservation.wall_impulse);
    put(sums, sim.fluid->lost.momentum);
    put(sums, static_cast<double>(sim.fluid->neighbours.builds));
    put(sums, sim.pair_visits);
    for (const Vec3& force : sim.loads.walls) {
        put(bits["wall forces"], force);
    }
    for (const Wrench& load : sim.loads.bodies) {
        put(bits["loads"], load.force);
        put(bits["loads"], load.torque);
    }
    for (const Body& body : sim.rigid.bodies) {
        put(bits["bodies"], body.position);
        put(bits["bodies"], body.velocity);
        put(bits["bodies"], body.angular_momentum);
    }
}

// Runs the scene of a draw; the bits at the end, and of the gauges on the way.
Bits run(const Draw& draw, Dice* dice, int threads, int steps)
{
    set_threads(threads);
    Simulation sim = make(case_of(draw));
    create_again(sim, dice);
    Bits bits;
    for (int k = 0; k < steps; ++k) {
        step_on(sim);
        if (k % 10 == 0) {
            for (const double reading : read_gauges(sim)) {
                put(bits["gauges"], reading);
            }
        }
    }
    EXPECT_GT(sim.fluid->neighbours.builds, 3);
    if (draw.kind == SceneKind::leaving) {
        EXPECT_GT(sim.fluid->lost.count, 0);
    }
    add_columns_of(sim.fluid->particles.fluid, "fluid", bits);
    add_columns_of(sim.fluid->particles.wall, "wall", bits);
    add_columns_of(sim.fluid->particles.body, "body", bits);
    add_sums(sim, bits);
    set_threads(0);
    return bits;
}

void expect_same(const Bits& a, const Bits& b, const std::string& how)
{
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [name, values] : a) {
        EXPECT_TRUE(values == b.at(name)) << name << ": " << how;
    }
}

TEST(CreationOrder, ChangesNoBitNorDoesTheNumberOfThreads)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_PLACEMENTS", 8);
    for (int seed = first; seed < first + count; ++seed) {
        const Draw draw = draw_of(static_cast<std::uint64_t>(seed));
        SCOPED_TRACE(fmt::format("HYORYU_SEED={} HYORYU_PLACEMENTS=1\n{}", seed, case_of(draw)));
        const int steps = draw.dimensions == 2 ? 300 : 200;
        const Bits expected = run(draw, nullptr, 1, steps);
        Dice dice(static_cast<std::uint64_t>(1000 + seed));
        expect_same(expected, run(draw, &dice, 1, steps), "another order");
        const int threads = 2 + seed % 3;
        expect_same(expected, run(draw, &dice, threads, steps),
                    fmt::format("a third order, {} threads", threads));
    }
}

} // namespace
} // namespace hyoryu::test_creation_order
