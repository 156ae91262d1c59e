// SPDX-License-Identifier: MIT
// Water that bears no tension: what flies apart flies freely, and what comes together again is not
// pushed before its voids have closed.
#include "runs.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_cavitation {
namespace {

// A square that expands evenly by a fifth in each second, without weight.
constexpr const char* square = R"(
dimensions = 2
gravity = [0.0, 0.0, 0.0]
[time]
end = 10.0
step = 1e-3
[particles]
spacing = 0.02
precision = "double"
[domain]
min = [-1.0, 0.0, -1.0]
max = [1.0, 0.0, 1.0]
[fluid]
sound_speed = 10.0
viscosity.model = "none"
[[fluid.block]]
shape = "box"
min = [-0.2, 0.0, -0.2]
max = [0.2, 0.0, 0.2]
velocity_field = ["0.2*x", "0", "0.2*z"]
)";

struct Deviation {
    double place = 0;    // from free flight at most [m]
    double pressure = 0; // at most [Pa]
    double cavity = 0;   // at most, over the density [1]
};

// Particles by their numbers: the search for neighbours sorts the rows.
std::vector<Vec3> places(const Simulation& sim)
{
    const Store& particles = sim.fluid->particles.fluid;
    std::vector<Vec3> x(particles.id().size());
    for (std::size_t row = 0; row < x.size(); ++row) {
        x[static_cast<std::size_t>(particles.id()[row])] = particles[field::position][row];
    }
    return x;
}

Deviation deviation(const Simulation& sim, const std::vector<Vec3>& start, double flight)
{
    Deviation worst;
    const std::vector<Vec3> now = places(sim);
    for (std::size_t k = 0; k < now.size(); ++k) {
        worst.place = std::max(worst.place, (now[k] - (1 + 0.2 * flight) * start[k]).norm());
    }
    for (const real p : sim.fluid->particles.fluid[field::pressure]) {
        worst.pressure = std::max(worst.pressure, std::abs(p));
    }
    if (sim.fluid->particles.fluid.has(field::cavity)) {
        for (const real c : sim.fluid->particles.fluid[field::cavity]) {
            worst.cavity = std::max(worst.cavity, c / 1000);
        }
    }
    return worst;
}

TEST(Cavitation, WaterThatPartsFliesFreely)
{
    Simulation sim = make(square, {"fluid.cavitation.model=void"});
    const std::vector<Vec3> start = places(sim);
    advance(sim, 200);
    const Deviation torn = deviation(sim, start, 0.2);
    EXPECT_LE(torn.place, 1e-14); // round-off
    EXPECT_EQ(torn.pressure, 0);
    // Conservation of mass: an area (1 + 0.2/s x 0.2 s)^2 as large; the kernel sum misses 1e-4.
    EXPECT_NEAR(torn.cavity, 1 - 1 / (1.04 * 1.04), 1e-3);

    Simulation pulled = make(square);
    advance(pulled, 200);
    EXPECT_GT(deviation(pulled, start, 0.2).place, 1e-3); // it bears tension and stays together
}

TEST(Cavitation, VoidsCloseBeforeTheWaterIsCompressed)
{
    Simulation sim = make(square, {"fluid.cavitation.model=void"});
    const std::vector<Vec3> start = places(sim);
    advance(sim, 200);
    for (Vec3& v : sim.fluid->particles.fluid[field::velocity]) {
        v = -v;
    }
    update_rates(*sim.fluid);
    advance(sim, 199);
    const Deviation almost = deviation(sim, start, 1e-3);
    EXPECT_LE(almost.place, 1e-14);
    EXPECT_EQ(almost.pressure, 0);
    EXPECT_LE(almost.cavity, 5e-4); // 2 x 0.2/s x 1e-3 s are left
    advance(sim, 20);
    const Deviation closed = deviation(sim, start, 0);
    EXPECT_GT(closed.pressure, 100); // 2 x 0.2/s x 0.01 s of rho c^2 are 400 Pa; edges give way
}

TEST(Cavitation, ARestartKeepsTheVoids)
{
    Simulation whole = make(square, {"fluid.cavitation.model=void"});
    advance(whole, 50);
    const Snapshot middle = save(whole);
    advance(whole, 50);

    Simulation resumed = make_blank(square, {"fluid.cavitation.model=void"});
    restore(resumed, middle);
    advance(resumed, 50);
    expect_same_bits(save(whole), save(resumed));
    const double open = deviation(whole, places(whole), 0).cavity;
    EXPECT_GT(open, 0.03);
    EXPECT_EQ(deviation(resumed, places(resumed), 0).cavity, open);
}

TEST(Cavitation, OpensAtThePressureOfTheVoid)
{
    Simulation sim = make(square, {"fluid.cavitation.model=void", "fluid.cavitation.pressure=-50"});
    advance(sim, 100);
    const auto p = sim.fluid->particles.fluid[field::pressure];
    EXPECT_NEAR(*std::min_element(p.begin(), p.end()), -50, 1e-9);
}

} // namespace
} // namespace hyoryu::test_cavitation
