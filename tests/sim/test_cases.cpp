// SPDX-License-Identifier: MIT
// The shipped cases against their exact answers.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/sim/frames.hpp"
#include "hyoryu/sim/gauges.hpp"
#include "hyoryu/sim/wall_barrier.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_cases {
namespace {

Simulation open_case(const std::string& name, const std::vector<std::string>& overrides = {})
{
    const Scene scene =
        read_case(std::string(HYORYU_SOURCE_DIR) + "/cases/" + name + "/case.toml", overrides);
    const Filling filling = fill(scene);
    return make_simulation(scene, make_plan(scene, filling), filling);
}

// How far momentum may be off in a step when the pair forces of a particle are summed in single
// precision: what a hundred of them lose, 2e-7 of the largest for one particle, is at random over
// the particles and measures 5e-8 in the small case and less in all others. Double closes to 1e-10,
// which tests/sim/test_promises.cpp shows.
constexpr double closes_in_single = 2e-7;

void run(Simulation& sim, const auto& after_step)
{
    while (!finished(sim.clock, sim.scene)) {
        step(sim);
        if (frame_due(sim.clock, sim.scene)) {
            sim.clock.frame += 1;
        }
        after_step();
    }
}

// Height of the centre of the cube of `bouncing_box` at time t: parabolas between impacts at speeds
// e^k v_1, at rest after the Zeno time.
double exact_bounce(double t)
{
    const double g = 9.81;
    const double e = 0.75;
    const double rest = 0.025;
    double v = std::sqrt(2 * g * 0.1);
    double impact = v / g;
    if (t < impact) {
        return rest + 0.1 - 0.5 * g * t * t;
    }
    for (int k = 0; k < 200; ++k) {
        v *= e;
        const double flight = 2 * v / g;
        if (t < impact + flight) {
            const double s = t - impact;
            return rest + v * s - 0.5 * g * s * s;
        }
        impact += flight;
    }
    return rest;
}

// However its particle lattice lies: the surface decides, not the particles.
class BouncingBox : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(BouncingBox, FollowsTheExactBounces)
{
    Simulation sim = open_case("bouncing_box", GetParam());
    double worst = 0;
    const Vec3 start = sim.rigid.bodies[0].position;
    run(sim, [&] {
        const Vec3& x = sim.rigid.bodies[0].position;
        worst = std::max(worst, std::abs(x.z() - exact_bounce(sim.clock.time)));
    });
    EXPECT_LE(worst, 1e-6); // 1e-3 mm, the promise of the method at 1 ms
    const Body& cube = sim.rigid.bodies[0];
    EXPECT_LE(std::hypot(cube.position.x() - start.x(), cube.position.y() - start.y()), 1e-12);
    EXPECT_LE(angular_velocity(cube).norm(), 1e-9);
    EXPECT_FALSE(sim.fluid.has_value()); // no particles, cells or sweeps
}

INSTANTIATE_TEST_SUITE_P(
    Lattices, BouncingBox,
    testing::Values(std::vector<std::string>{},
                    std::vector<std::string>{"body[0].position=[0.0027, 0.0, 0.125]"},
                    std::vector<std::string>{"body[0].position=[0.0025, 0.0025, 0.125]"},
                    std::vector<std::string>{"body[0].position=[0.1234567, -0.7654321, 0.125]"},
                    std::vector<std::string>{"body[0].spacing=0.005"},
                    std::vector<std::string>{"body[0].spacing=0.03"}));

TEST(Cases, SlidingBoxStopsWhereCoulombSaysItDoes)
{
    Simulation sim = open_case("sliding_box");
    double stopped = 0;
    run(sim, [&] {
        if (sim.rigid.bodies[0].velocity.norm() > 1e-9) {
            stopped = sim.clock.time;
        }
    });
    const double mu_g = 0.2 * 9.81;
    EXPECT_NEAR(sim.rigid.bodies[0].position.x(), 1 / (2 * mu_g), 1e-5 / (2 * mu_g));
    EXPECT_NEAR(stopped, 1 / mu_g, 1e-3); // within the step in which it stops
    EXPECT_NEAR(sim.rigid.bodies[0].position.z(), 0.025, 1e-9);
}

// The lattice of the start slides along the walls by rows as it settles. Where nothing but the
// rounding of double breaks its symmetry, a part of that never happens; any more, 1e-6 spacings in
// the places of the particles in double as much as single precision, sets it off, with speeds of
// 0.009 to 0.015 of sqrt(g H).
class HydrostaticTank : public testing::TestWithParam<std::pair<const char*, double>> {};

TEST_P(HydrostaticTank, StaysStill)
{
    const auto& [precision, fastest_allowed] = GetParam();
    Simulation sim =
        open_case("hydrostatic_tank", {std::string("particles.precision=\"") + precision + '"'});
    const std::size_t particles = sim.fluid->particles.fluid.id().size();
    const double H = 1.0;
    const double top = std::sqrt(9.81 * H);
    double fastest = 0;
    run(sim, [&] { fastest = std::max(fastest, top_speed(*sim.fluid)); });

    const Store& p = sim.fluid->particles.fluid;
    double error = 0;
    double count = 0;
    for (Index i = 0; i < p.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double depth = H - p[field::position][k].z();
        if (depth > 0.1) { // away from the surface
            error += sq(p[field::pressure][k] - 1000 * 9.81 * depth);
            count += 1;
        }
    }
    const double relative = std::sqrt(error / count) / (1000 * 9.81 * H);
    RecordProperty("pressure_error", std::to_string(relative));
    EXPECT_LE(relative, 0.02);
    EXPECT_LE(fastest, fastest_allowed * top);
    EXPECT_EQ(p.id().size(), particles);
    EXPECT_EQ(sim.fluid->lost.count, 0);
    EXPECT_LE(sim.conservation.worst_closure, precision[0] == 'd' ? 1e-10 : closes_in_single);
}

INSTANTIATE_TEST_SUITE_P(Cases, HydrostaticTank,
                         testing::Values(std::pair{"double", 0.01}, std::pair{"single", 0.02}));

TEST(Cases, FloatingBoxKeepsItsArchimedesDraft)
{
    Simulation sim = open_case("floating_box");
    double mean = 0;
    int samples = 0;
    run(sim, [&] {
        if (sim.clock.time > 3) {
            mean += sim.rigid.bodies[0].position.z();
            samples += 1;
        }
    });
    EXPECT_NEAR(mean / samples, 0.5, 0.02 / 3); // one third of a spacing
    const Quat& q = sim.rigid.bodies[0].orientation;
    EXPECT_LE(2 * std::abs(q.y()), 0.0175); // one degree
    EXPECT_LE(sim.conservation.worst_closure, closes_in_single);
    EXPECT_EQ(sim.fluid->lost.count, 0);
}

TEST(Cases, DamBreakRunsAsInviscidCodesDo)
{
    Simulation sim = open_case("dam_break");
    const double a = 0.05715;
    const double T3 = 3 / std::sqrt(2 * 9.81 / a);
    double front = 0;
    run(sim, [&] {
        if (sim.clock.time <= T3) {
            front = read_gauges(sim).at(0) / a;
        }
    });
    // Experiments: 3.47 to 3.79; inviscid particle codes lead them, 4.00 at a/dp = 20 and 4.12 for
    // dp -> 0. The band runs from the slowest experiment to 4 % beyond the extrapolated front, the
    // spread between sources.
    EXPECT_GE(front, 3.5);
    EXPECT_LE(front, 4.3);
    EXPECT_EQ(sim.fluid->lost.count, 0);
    EXPECT_LE(sim.conservation.worst_closure, closes_in_single);
}

TEST(Cases, DebrisFloodStartsSoundly)
{
    // Coarser and short: the whole of it is the quickstart's job.
    Simulation sim = open_case("debris_flood", {"particles.spacing=0.25", "time.end=0.6"});
    run(sim, [] {});
    EXPECT_EQ(sim.fluid->lost.count, 0);
    EXPECT_LE(sim.conservation.worst_closure, closes_in_single);
    // Films squeezed by bodies reach some percent at this coarse spacing; a run that is lost, 100
    // %.
    EXPECT_LE(sim.conservation.worst_density_error, 0.2);
    EXPECT_GE(sim.scene.bodies.size(), 8u);
}

TEST(Cases, PortTakesTheTsunamiIn)
{
    // Four spacings of water and the first seconds of the wave, that is all there is time for.
    Simulation sim = open_case("port", {"particles.spacing=1.5", "time.end=2.5"});
    Index accounted_for = sim.plan.counts.fluid;
    run(sim, [&] { EXPECT_EQ(count_in_solids(sim), 0); });
    for (const Carpet& carpet : sim.open.boundary.carpets) {
        accounted_for += carpet.made - carpet.dropped;
    }
    EXPECT_EQ(sim.scene.bodies.size(), 36u);
    EXPECT_EQ(sim.fluid->particles.fluid.size(), accounted_for);
    EXPECT_EQ(sim.fluid->lost.count, 0);
    EXPECT_LE(sim.conservation.worst_closure, closes_in_single);
    for (const Body& body : sim.rigid.bodies) {
        EXPECT_GT(body.position.x(), 40.0) << body.name << " stands on the quay";
        // It was set down from 1 mm, which gives 0.14 m/s at most, and has been at rest since.
        EXPECT_LT(body.velocity.norm(), 0.1) << body.name << " has not met water yet";
    }
}

} // namespace
} // namespace hyoryu::test_cases
