// SPDX-License-Identifier: MIT
// Gauges against numbers known without them: uniform streams, still water, impulses of the books.
#include "hyoryu/core/error.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hyoryu::test_gauges {
namespace {

// A square of water in flight along x at 2 m/s, without gravity and walls.
const std::string stream = R"(
dimensions = 2
gravity = [0.0, 0.0, 0.0]
[time]
end = 1.0
step = 0.001
[particles]
spacing = 0.02
[domain]
min = [-1.0, 0.0, -1.0]
max = [9.0, 0.0, 2.0]
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [1.0, 0.0, 0.5]
velocity = [2.0, 0.0, 0.0]
)";

// A tank of still water, and above it a crate that falls by 1 cm onto a shelf.
const std::string tank = R"(
dimensions = 2
[time]
end = 1.0
[particles]
spacing = 0.02
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.5, 0.0, 0.4]
[[wall]]
name = "basin"
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [0.5, 0.0, 0.9]
open = ["+z"]
[[wall]]
name = "shelf"
shape = "box"
min = [0.3, 0.0, 0.6]
max = [0.5, 0.0, 0.66]
[[body]]
name = "crate"
shape = "box"
size = [0.1, 0.0, 0.1]
density = 400.0
position = [0.4, 0.0, 0.72]
)";

std::string gauge(const std::string& name, const std::string& rest)
{
    return "[[gauge]]\nname = \"" + name + "\"\n" + rest + "\n";
}

double read(Simulation& sim, const std::string& column)
{
    const std::vector<Table::Head> heads = gauge_heads(sim.scene);
    const auto at = std::find_if(heads.begin(), heads.end(),
                                 [&](const Table::Head& head) { return head.name == column; });
    EXPECT_NE(at, heads.end()) << column;
    return next_gauge_row(sim).at(static_cast<std::size_t>(at - heads.begin()));
}

TEST(Gauges, AUniformStreamHasItsFluxVelocityAndFront)
{
    Simulation sim = make(stream +
                          gauge("Q", "type = \"flux\"\nat = [0.513, 0.0, 0.0]\n"
                                     "normal = [-3.0, 0.0, 0.0]") +
                          gauge("v", "type = \"velocity\"\nat = [0.513, 0.0, 0.2]") +
                          gauge("x", "type = \"front\""));
    // Pressure and density are at rest, so that the sum over a lattice is exact.
    EXPECT_NEAR(read(sim, "Q"), -2.0 * 0.5, 1e-12);
    EXPECT_NEAR(read(sim, "v_x"), 2.0, 1e-12);
    EXPECT_NEAR(read(sim, "x"), 1.0, 1e-12);
    advance(sim, 100);
    EXPECT_NEAR(read(sim, "x"), 1.2, 1e-9);
}

TEST(Gauges, StillWaterHasTheHydrostaticPressureOnEveryFaceAndAirHasNone)
{
    Simulation sim = make(tank + gauge("point", "type = \"pressure\"\nat = [0.25, 0.0, 0.1]") +
                          gauge("floor", "type = \"pressure\"\nat = [0.25, 0.0, 0.0]") +
                          gauge("side", "type = \"pressure\"\nat = [0.0, 0.0, 0.1]\narea = 0.05\n"
                                        "normal = [1.0, 0.0, 0.0]") +
                          gauge("air", "type = \"pressure\"\nat = [0.25, 0.0, 0.45]") +
                          gauge("level", "type = \"elevation\"\nat = [0.25, 0.0]") +
                          gauge("level_at_wall", "type = \"elevation\"\nat = [0.0, 0.0]"));
    // The start is hydrostatic, p = rho0 c0^2 (exp(g d/c0^2) - 1): 0.3 % above rho0 g d at most.
    const double g = 9.81;
    EXPECT_NEAR(read(sim, "point"), 1000 * g * 0.3, 0.005 * 1000 * g * 0.3);
    EXPECT_NEAR(read(sim, "floor"), 1000 * g * 0.4, 0.005 * 1000 * g * 0.4);
    EXPECT_NEAR(read(sim, "side"), 1000 * g * 0.3, 0.005 * 1000 * g * 0.3);
    EXPECT_EQ(read(sim, "air"), 0);
    EXPECT_NEAR(read(sim, "level"), 0.4, 0.02 * 0.02); // a fiftieth of a spacing
    EXPECT_NEAR(read(sim, "level_at_wall"), 0.4, 0.02 * 0.02);
}

// Water before a sheet of one to three spacings: its wet face has the hydrostatic pressure, its dry
// face none, whichever side is wet.
TEST(Gauges, AFaceReadsTheWaterInFrontOfItAlone)
{
    for (const double spacing : {0.02, 0.0125}) {
        for (const double rows : {1.0, 1.5, 2.0, 3.0}) {
            for (const bool left : {false, true}) {
                const double thick = rows * spacing;
                const std::string sides =
                    gauge("left", "type = \"pressure\"\nat = [0.5, 0.0, 0.1]\narea = 0.05\n"
                                  "normal = [-1.0, 0.0, 0.0]") +
                    gauge("right", fmt::format("type = \"pressure\"\nat = [{}, 0.0, 0.1]\n"
                                               "area = 0.05\nnormal = [1.0, 0.0, 0.0]",
                                               0.5 + thick));
                Simulation sim = make(fmt::format(
                    "dimensions = 2\n[time]\nend = 1.0\n[particles]\nspacing = {}\n[fluid]\n"
                    "[[fluid.block]]\nshape = \"box\"\nmin = [{}, 0.0, 0.0]\n"
                    "max = [{}, 0.0, 0.3]\n[[wall]]\nshape = \"basin\"\nmin = [0.0, 0.0, 0.0]\n"
                    "max = [{}, 0.0, 0.5]\nopen = [\"+z\"]\n[[wall]]\nname = \"sheet\"\n"
                    "shape = \"box\"\nmin = [0.5, 0.0, 0.0]\nmax = [{}, 0.0, 0.4]\n{}",
                    spacing, left ? 0 : 0.5 + thick, left ? 0.5 : 1 + thick, 1 + thick, 0.5 + thick,
                    sides));
                step_on(sim);
                const double head = 1000 * 9.81 * 0.2;
                EXPECT_NEAR(read(sim, left ? "left" : "right"), head, 0.06 * head) << rows;
                EXPECT_EQ(read(sim, left ? "right" : "left"), 0) << rows;
            }
        }
    }
}

TEST(Gauges, ForcesAddUpToTheImpulsesOfTheBooks)
{
    Simulation sim = make(tank + gauge("basin", "type = \"force\"\non = \"basin\"") +
                          gauge("shelf", "type = \"force\"\non = \"shelf\"") +
                          gauge("crate", "type = \"force\"\non = \"crate\""));
    while (sim.clock.time < 0.12) {
        step_on(sim);
    }
    const double weight = 9.81 * 400 * 0.01;
    const Body& crate = sim.rigid.bodies[0];
    const Vec3 outside = sim.conservation.wall_impulse;
    // What the walls received they gave; fluid on the basin, the crate on the shelf.
    EXPECT_NEAR(read(sim, "basin_fluid_impulse_z") + read(sim, "shelf_contact_impulse_z"),
                -outside.z(), 1e-9 * std::abs(outside.z()));
    EXPECT_NEAR(read(sim, "crate_contact_impulse_z"),
                crate.mass.mass * crate.velocity.z() + weight * sim.clock.time, 1e-9);
    EXPECT_NEAR(read(sim, "crate_contact_impulse_z"), -read(sim, "shelf_contact_impulse_z"), 1e-12);
    EXPECT_GT(read(sim, "crate_contact_impulse_z"), 0.1 * weight * sim.clock.time);
    EXPECT_EQ(read(sim, "crate_x"), 0); // dry
    EXPECT_NEAR(read(sim, "basin_z"), -9.81 * 1000 * 0.2, 0.02 * 9.81 * 1000 * 0.2);
    EXPECT_EQ(read(sim, "basin_viscous_x"), 0); // free slip
    EXPECT_EQ(read(sim, "basin_z"), read(sim, "basin_pressure_z"));
}

TEST(Gauges, ContactForceIsTheMeanSinceTheRowBefore)
{
    Simulation sim = make(tank + gauge("crate", "type = \"force\"\non = \"crate\""));
    const auto mean = [&](double until) {
        const double before = read(sim, "crate_contact_impulse_z"); // this is a row as well
        const double from = sim.clock.time;
        while (sim.clock.time < until) {
            step_on(sim);
        }
        const std::vector<double> row = next_gauge_row(sim);
        const double impulse = row.at(17) - before;
        return std::pair(row.at(11), impulse / (sim.clock.time - from));
    };
    const auto [falling, none] = mean(0.02);
    EXPECT_EQ(falling, 0);
    const auto [read_mean, from_impulse] = mean(0.1);
    EXPECT_NEAR(read_mean, from_impulse, 1e-12 * from_impulse);
    EXPECT_GT(read_mean, 1.0);
    const auto [later, from_later] = mean(0.2); // what came before the last row does not count
    EXPECT_NEAR(later, from_later, 1e-12 * from_later);
}

TEST(Gauges, FiltersFollowARampAsTheyShould)
{
    // x grows by 0.002 m a row; the row at step n holds 1 + 0.002 n.
    const std::string front = "type = \"front\"\nwindow = 0.0049\nfilter = ";
    Simulation sim = make(stream + gauge("a", front + "\"mean\"") +
                          gauge("b", front + "\"median\"") + gauge("c", front + "\"exponential\""));
    std::vector<double> row;
    for (int n = 0; n < 100; ++n) {
        row = next_gauge_row(sim);
        step_on(sim);
    }
    ASSERT_EQ(row.size(), 6u);
    const double raw = 1 + 0.002 * 99;
    EXPECT_NEAR(row[0], raw, 1e-9);
    EXPECT_NEAR(row[1], raw - 0.004, 1e-9); // five rows: the middle one is two rows old
    EXPECT_NEAR(row[3], raw - 0.004, 1e-9);
    // Discrete first-order lag: y lags a ramp of slope s by s dt / (exp(dt/T) - 1).
    EXPECT_NEAR(row[5], raw - 0.002 / std::expm1(0.001 / 0.0049), 1e-8);
    EXPECT_EQ(gauge_heads(sim.scene)[3].name, "b_median");
}

// Rows of gauges: times, and the columns.
struct GaugeRows {
    std::vector<double> times;
    std::vector<std::vector<double>> rows;
};

// Rows at random steps, the first at time 0.
GaugeRows rows_at_random(Simulation& sim, int count, unsigned seed)
{
    std::mt19937 random(seed);
    GaugeRows all;
    for (int k = 0; k < count; ++k) {
        all.times.push_back(sim.clock.time);
        all.rows.push_back(next_gauge_row(sim));
        for (auto steps = 1 + random() % 5; steps > 0; --steps) {
            step_on(sim);
        }
    }
    return all;
}

// Sum of all readings that are numbers, each over the time since the row before, by exp(-age/w).
double weighted_mean(const GaugeRows& all, std::size_t row, std::size_t column, double window)
{
    double sum = 0;
    double weights = 0;
    for (std::size_t k = 1; k <= row; ++k) {
        const double x = all.rows[k][column];
        const double weight = std::exp((all.times[k] - all.times[row]) / window) -
                              std::exp((all.times[k - 1] - all.times[row]) / window);
        sum += std::isnan(x) ? 0 : weight * x;
        weights += std::isnan(x) ? 0 : weight;
    }
    return sum / weights;
}

TEST(Gauges, ExponentialMeanIsThatOfTheTimeSinceTheStart)
{
    for (const double window : {0.003, 0.05, 2.0}) {
        const std::string filter = fmt::format("\nfilter = \"exponential\"\nwindow = {}", window);
        Simulation sim =
            make(tank + gauge("p", "type = \"pressure\"\nat = [0.0, 0.0, 0.1]" + filter) +
                 gauge("f", "type = \"force\"\non = \"basin\"" + filter));
        const GaugeRows all = rows_at_random(sim, 40, 3);
        // Columns: p, p_exponential, f and its parts and impulses, f_exponential_x, _y, _z.
        const std::size_t f = 2;
        EXPECT_EQ(all.rows[0][1], all.rows[0][0]);
        EXPECT_EQ(all.rows[0][f + 20], 0);
        EXPECT_DOUBLE_EQ(all.rows[1][f + 20], all.rows[1][f + 2])
            << "the first force that is known";
        for (std::size_t row = 1; row < all.rows.size(); ++row) {
            for (const auto& [raw, filtered] : {std::pair(std::size_t{0}, std::size_t{1}),
                                                std::pair(f, f + 18), std::pair(f + 2, f + 20)}) {
                const double expected = weighted_mean(all, row, raw, window);
                // Round-off of sums, in a long window of weights that cancel to 1e-3.
                EXPECT_NEAR(all.rows[row][filtered], expected,
                            1e-10 * (std::abs(expected) + std::abs(all.rows[row][raw]) + 1))
                    << "row " << row << ", window " << window;
            }
        }
    }
}

// A square of water at 2 m/s passes a gauge, and after a time without water one at 3 m/s.
TEST(Gauges, ExponentialMeanLeavesOutTheTimeWithoutWater)
{
    const std::string squares =
        "dimensions = 2\ngravity = [0.0, 0.0, 0.0]\n[time]\nend = 1.0\nstep = 0.001\n"
        "[particles]\nspacing = 0.02\n[domain]\nmin = [-2.0, 0.0, -1.0]\nmax = [9.0, 0.0, 2.0]\n"
        "[fluid]\n[[fluid.block]]\nshape = \"box\"\nmin = [0.0, 0.0, 0.0]\n"
        "max = [0.2, 0.0, 0.4]\nvelocity = [2.0, 0.0, 0.0]\n"
        "[[fluid.block]]\nshape = \"box\"\nmin = [-0.8, 0.0, 0.0]\nmax = [-0.6, 0.0, 0.4]\n"
        "velocity = [3.0, 0.0, 0.0]\n";
    constexpr double window = 0.1;
    Simulation sim = make(squares + gauge("v", "type = \"velocity\"\nat = [0.4, 0.0, 0.2]\n"
                                               "filter = \"exponential\"\nwindow = 0.1"));
    const GaugeRows all = rows_at_random(sim, 150, 5);
    int gaps = 0;
    double least = infinity;
    double most = 0;
    for (std::size_t row = 1; row < all.rows.size(); ++row) {
        const bool dry = std::isnan(all.rows[row][0]);
        gaps += dry && !std::isnan(all.rows[row - 1][0]) ? 1 : 0;
        EXPECT_EQ(std::isnan(all.rows[row][3]), dry);
        if (!dry) {
            const double mean = all.rows[row][3];
            EXPECT_NEAR(mean, weighted_mean(all, row, 0, window), 1e-10);
            least = std::min(least, mean);
            most = std::max(most, mean);
        }
    }
    EXPECT_EQ(gaps, 2) << "each square came and went";
    EXPECT_NEAR(least, 2.0, 0.01);
    EXPECT_LT(most, 2.95) << "the first square is remembered";
    EXPECT_GT(most, 2.3);
}

TEST(Gauges, NoFilterCountsTheForceBeforeTheFirstStep)
{
    for (const char* filter : {"mean", "median", "exponential"}) {
        Simulation sim = make(tank + gauge("f", fmt::format("type = \"force\"\non = \"basin\"\n"
                                                            "filter = \"{}\"\nwindow = 5.0",
                                                            filter)));
        EXPECT_EQ(next_gauge_row(sim).at(20), 0);
        step_on(sim);
        const std::vector<double> first = next_gauge_row(sim);
        EXPECT_LT(first.at(2), -100) << "the water weighs on the basin";
        EXPECT_DOUBLE_EQ(first.at(20), first.at(2)) << filter;
        step_on(sim);
        const std::vector<double> second = next_gauge_row(sim);
        // Two rows about equally far apart: the mean lies in their middle.
        EXPECT_NEAR(second.at(20), (first.at(2) + second.at(2)) / 2,
                    0.1 * std::abs(second.at(2) - first.at(2)) + 1e-9)
            << filter;
    }
}

// A checkpoint of an earlier version has the mean without its weight, which then counted as 1.
TEST(Gauges, AnExponentialMeanOfAnEarlierVersionGoesOn)
{
    const std::string text = tank + gauge("p", "type = \"pressure\"\nat = [0.0, 0.0, 0.1]\n"
                                               "filter = \"exponential\"\nwindow = 0.02");
    Simulation sim = make(text);
    rows_at_random(sim, 10, 7);
    next_gauge_row(sim);
    Snapshot old = save(sim);
    std::get<std::vector<std::int64_t>>(old.arrays.at("gauges/samples").values) = {1};
    std::get<std::vector<double>>(old.arrays.at("gauges/sample_times").values).resize(1);
    auto& mean = std::get<std::vector<double>>(old.arrays.at("gauges/sample_values").values);
    mean = {2 * mean.front()};
    Simulation resumed = make_blank(text);
    restore(resumed, old);
    step_on(resumed);
    const std::vector<double> row = next_gauge_row(resumed);
    const double share = -std::expm1(-resumed.clock.dt / 0.02);
    EXPECT_NEAR(row.at(1), (1 - share) * mean.front() + share * row.at(0),
                1e-9 * std::abs(mean.front()));
}

TEST(Gauges, AResumedRunReadsTheSameBits)
{
    const std::string text = tank +
                             gauge("crate", "type = \"force\"\non = \"crate\"\n"
                                            "filter = \"mean\"\nwindow = 0.01") +
                             gauge("p", "type = \"pressure\"\nat = [0.0, 0.0, 0.1]\n"
                                        "filter = \"exponential\"\nwindow = 0.01") +
                             gauge("z", "type = \"elevation\"\nat = [0.25, 0.0]\n"
                                        "filter = \"median\"\nwindow = 0.01");
    Simulation whole = make(text);
    const auto rows = [](Simulation& sim, int count) {
        std::vector<std::vector<double>> all;
        for (int k = 0; k < count; ++k) {
            step_on(sim);
            all.push_back(next_gauge_row(sim));
            sim.clock.gauge += 1;
        }
        return all;
    };
    rows(whole, 60);
    const Snapshot middle = save(whole);
    const auto rest = rows(whole, 40);
    Simulation resumed = make_blank(text);
    restore(resumed, middle);
    EXPECT_EQ(resumed.clock.gauge, 60);
    EXPECT_EQ(rows(resumed, 40), rest);
}

TEST(Gauges, AnAbsentGaugeCostsNothingAndAPresentOneChangesNothing)
{
    Simulation without = make(tank);
    Simulation with = make(tank + gauge("f", "type = \"force\"\non = \"basin\"") +
                           gauge("p", "type = \"pressure\"\nat = [0.0, 0.0, 0.1]"));
    for (int k = 0; k < 30; ++k) {
        step_on(without);
        step_on(with);
        next_gauge_row(with);
    }
    EXPECT_TRUE(without.gauges.forces.empty());
    EXPECT_TRUE(without.gauges.filters.empty());
    EXPECT_FALSE(without.plan.runs("gauges"));
    EXPECT_TRUE(without.plan.gauges.empty());
    for (const auto& stage : without.timer.stages()) {
        EXPECT_NE(stage.name, "gauges");
    }
    const Snapshot a = save(without);
    const Snapshot b = save(with);
    EXPECT_EQ(a.arrays.count("gauges"), 0u);
    for (const auto& [name, column] : a.arrays) {
        EXPECT_EQ(column.values, b.arrays.at(name).values) << name;
    }
}

TEST(Gauges, CheckNamesThemAndRefusesOneThatCanNeverRead)
{
    const Simulation sim =
        make(tank +
             gauge("p", "type = \"pressure\"\nat = [0.0, 0.0, 0.1]\narea = 0.01\n"
                        "normal = [1.0, 0.0, 0.0]\nfilter = \"mean\"\nwindow = 0.1") +
             "[output]\ngauge_every = 0.5\n");
    ASSERT_EQ(sim.plan.gauges.size(), 1u);
    EXPECT_EQ(sim.plan.gauges[0].columns, "p, p_mean");
    EXPECT_NE(sim.plan.gauges[0].what.find("0.01 m"), std::string::npos);
    EXPECT_EQ(sim.plan.gauge_rows, 3);
    try {
        make(tank + gauge("far", "type = \"pressure\"\nat = [50.0, 0.0, 0.1]"));
        FAIL() << "a gauge outside the domain was taken";
    } catch (const CaseError& error) {
        EXPECT_NE(std::string(error.what()).find("outside the domain"), std::string::npos);
    }
    const Simulation deep =
        make(tank + gauge("deep", "type = \"pressure\"\nat = [0.4, 0.0, 0.63]"));
    EXPECT_TRUE(
        std::any_of(deep.plan.warnings.begin(), deep.plan.warnings.end(), [](const auto& w) {
            return w.what.find("inside the wall \"shelf\"") != std::string::npos;
        }));
}

TEST(Gauges, ColumnsAreUnique)
{
    try {
        parse_case(stream + gauge("p", "type = \"front\"\nfilter = \"mean\"\nwindow = 1.0") +
                       gauge("p_mean", "type = \"front\""),
                   "test.toml");
        FAIL() << "two columns of one name were taken";
    } catch (const CaseError& error) {
        EXPECT_NE(std::string(error.what()).find("p_mean"), std::string::npos);
    }
}

} // namespace
} // namespace hyoryu::test_gauges
