// SPDX-License-Identifier: MIT
// D1: gauges look only at the particles about them and read the bits of gauges that look at all.
#include "clear_gauges.hpp"
#include "dice.hpp"
#include "gauge_scenes.hpp"
#include "hyoryu/core/parallel.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>

namespace hyoryu::test_gauge_search {
namespace {

using namespace gauge_scenes;

std::vector<std::uint64_t> bits_of(const std::vector<double>& values)
{
    std::vector<std::uint64_t> bits;
    for (const double value : values) {
        bits.push_back(std::bit_cast<std::uint64_t>(value));
    }
    return bits;
}

// The raw columns of the gauges of the fluid, and for force gauges the viscous ones, read clearly.
std::vector<double> read_clearly(const Simulation& sim)
{
    std::vector<double> readings;
    auto force = sim.gauges.forces.begin();
    for (const Gauge& gauge : sim.scene.gauges) {
        if (gauge.type == GaugeType::force) {
            ++force;
        } else {
            const std::vector<double> own = by_all_particles::read_fluid(*sim.fluid, gauge);
            readings.insert(readings.end(), own.begin(), own.end());
        }
    }
    return readings;
}

std::vector<double> read_fluid_columns(const Simulation& sim)
{
    const std::vector<double> all = read_gauges(sim);
    std::vector<double> readings;
    std::size_t first = 0;
    for (const Gauge& gauge : sim.scene.gauges) {
        const std::size_t count = raw_columns(gauge, sim.scene.dimensions).size();
        if (gauge.type != GaugeType::force) {
            for (std::size_t k = first; k < first + count; ++k) {
                readings.push_back(all[k]);
            }
        }
        first += count;
    }
    return readings;
}

void expect_clear_bits(const Family& f, std::uint64_t seed)
{
    constexpr int most_threads = 3;
    set_threads(most_threads); // rooms of the solver are made for the threads of its last lists
    Dice dice(seed);
    std::string text = scene(f);
    for (int k = 0; k < 56; ++k) {
        text += random_gauge(dice, k, f);
    }
    Simulation sim = make(text);
    int wet = 0;
    for (int look = 0; look < 4; ++look) {
        const std::vector<double> clearly = read_clearly(sim);
        for (const int threads : {1, 2, most_threads}) {
            set_threads(threads);
            EXPECT_EQ(bits_of(read_fluid_columns(sim)), bits_of(clearly))
                << "look " << look << ", threads " << threads << "\n"
                << text;
        }
        for (const double value : clearly) {
            wet += std::isfinite(value) && value != 0 ? 1 : 0;
        }
        advance(sim, 1 + dice.below(25)); // lists serve several steps
    }
    EXPECT_GT(wet, 60) << "most gauges read nothing: they test nothing";
    set_threads(0);
}

TEST(GaugeSearch, D1ReadsTheBitsOfGaugesThatLookAtEveryParticle)
{
    std::uint64_t seed = 1;
    for (const std::string periodic : {"", "\"x\"", "\"x\", \"y\""}) {
        for (const bool moving : {false, true}) {
            expect_clear_bits(
                {2, 0.01, periodic == "\"x\", \"y\"" ? "\"x\"" : periodic, moving, "free_slip"},
                seed++);
            expect_clear_bits({3, 0.025, periodic, moving, "free_slip"}, seed++);
            expect_clear_bits({3, 0.04, periodic, moving, "no_slip"}, seed++);
        }
    }
}

TEST(GaugeSearch, D1ViscousForcesAreThoseOfAllParticlesOfTheSolid)
{
    Simulation sim = make(scene({2, 0.02, "", true, "no_slip"}) +
                          "[[gauge]]\nname = \"a\"\ntype = \"force\"\non = \"basin\"\n"
                          "[[gauge]]\nname = \"b\"\ntype = \"force\"\non = \"pier\"\n"
                          "[[gauge]]\nname = \"c\"\ntype = \"force\"\non = \"crate\"\n");
    while (sim.clock.time < 0.25) {
        step_on(sim);
    }
    book_forces(sim, 1e-4);
    for (const GaugedForce& force : sim.gauges.forces) {
        const Vec3 all = by_all_particles::viscous_force(*sim.fluid, force.target);
        EXPECT_EQ(force.viscous, all) << force.target;
        EXPECT_GT(all.norm(), 0) << force.target;
    }
}

TEST(GaugeSearch, D1AGaugeOfAnEmptyPlaceReadsWhatItReadWithoutWater)
{
    // Far above the water, where no tile is; the front of water whose tiles are all near another.
    const Simulation sim = make(scene({3, 0.05, "", false, "free_slip"}) +
                                "[[gauge]]\nname = \"p\"\ntype = \"pressure\"\nat = [1.15, 0.2, "
                                "0.9]\n[[gauge]]\nname = \"v\"\ntype = \"velocity\"\nat = [1.15, "
                                "0.2, 0.9]\n[[gauge]]\nname = \"z\"\ntype = \"elevation\"\nat = "
                                "[1.15, 0.2]\n");
    const std::vector<double> row = read_gauges(sim);
    EXPECT_EQ(row.at(0), 0);
    EXPECT_TRUE(std::isnan(row.at(1)));
    EXPECT_TRUE(std::isnan(row.at(4)));
}

} // namespace
} // namespace hyoryu::test_gauge_search
