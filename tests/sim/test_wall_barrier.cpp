// SPDX-License-Identifier: MIT
// The last barrier: water thrown at solids of every kind, thinner than a spacing too, that stand,
// move or float, does not pass their surfaces, and what holds it is felt.
#include "hyoryu/core/parallel.hpp"
#include "runs.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

namespace hyoryu::test_wall_barrier {
namespace {

constexpr double spacing = 0.04;

// Water of a speed, beside what is at x = 0.
std::string jet(int dimensions, double speed, double gap, bool mps)
{
    const double width = dimensions == 3 ? 0.32 : 0;
    return fmt::format("dimensions = {}\n[time]\nend = 10.0\n[particles]\nspacing = {}\n"
                       "[domain]\nmin = [-2, -2, -2]\nmax = [2, 2, 2]\n[fluid]\n"
                       "formulation = \"{}\"\n[[fluid.block]]\nshape = \"box\"\n"
                       "min = [{}, {}, -0.2]\nmax = [{}, {}, 0.2]\nvelocity = [{}, 0, 0]\n",
                       dimensions, spacing, mps ? "mps" : "sph", -gap - 0.4, -width / 2, -gap,
                       width / 2, speed);
}

// The barrier alone, with its loads.
void hold(Simulation& sim, double dt)
{
    begin_loads(sim);
    hold_at_solids(sim, 0, dt);
    total_loads(sim);
}

// Whether a point is beside a plate of a half height about the origin, turned by an angle about y.
struct Plate {
    double angle = 0; // [rad]
    double half = 0;  // [m]
    double speed = 0; // along x [m/s]
    double across(const Vec3& x, double time) const
    {
        return (x.x() - speed * time) * std::cos(angle) - x.z() * std::sin(angle);
    }
    double along(const Vec3& x, double time) const
    {
        return (x.x() - speed * time) * std::sin(angle) + x.z() * std::cos(angle);
    }
};

// Particles that were on one side of the plate a step ago and are on the other.
class Crossings {
public:
    explicit Crossings(const Plate& plate) : plate_(plate) {}
    Index look(const Simulation& sim)
    {
        const Store& particles = sim.fluid->particles.fluid;
        Index crossed = 0;
        std::map<std::int64_t, double> now;
        for (Index i = 0; i < particles.size(); ++i) {
            const Vec3& x = particles[field::position][static_cast<std::size_t>(i)];
            const std::int64_t id = particles.id()[static_cast<std::size_t>(i)];
            if (std::abs(plate_.along(x, sim.clock.time)) < plate_.half - spacing) {
                now[id] = plate_.across(x, sim.clock.time);
                crossed += before_.contains(id) && before_[id] * now[id] < 0 ? 1 : 0;
            }
        }
        before_ = std::move(now);
        return crossed;
    }

private:
    Plate plate_;
    std::map<std::int64_t, double> before_;
};

// A plate as a wall that stands, one that comes towards the water, and a fixed body.
std::string plate_of(const Plate& plate, double thickness, int kind)
{
    const std::string shape =
        fmt::format("shape = \"box\"\nsize = [{}, 1, {}]\nposition = [0, 0, 0]\n"
                    "rotation_deg = {{ axis = [0, 1, 0], angle = {} }}\n",
                    thickness, 2 * plate.half, plate.angle * 180 / EIGEN_PI);
    if (kind == 2) {
        return "[[body]]\nname = \"plate\"\ndensity = 1000.0\nfixed = true\n" + shape;
    }
    return "[[wall]]\nname = \"plate\"\n" + shape +
           fmt::format("motion.velocity = [{}, 0, 0]\n", plate.speed);
}

TEST(WallBarrier, NoWaterHopsThroughAThinPlate)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    std::size_t hits = 0;
    for (int n = 0; n < 24; ++n) {
        const double speed = 1 + 7 * part(random);
        const double gap = spacing * (0.6 + part(random));
        const double thickness = spacing * (0.05 + 0.9 * part(random));
        const int kind = n % 3;
        const Plate plate{0.6 * (part(random) - 0.5), 0.5, kind == 1 ? -3 * part(random) : 0};
        const std::string text =
            jet(2, speed, gap + 0.2, n % 4 == 3) + plate_of(plate, thickness, kind);
        SCOPED_TRACE(text);
        Simulation sim = make(text);
        Crossings crossings(plate);
        Index crossed = 0;
        while (sim.clock.time < 0.15) {
            step_on(sim);
            hits += hits_of_step(*sim.barrier);
            crossed += crossings.look(sim);
        }
        EXPECT_EQ(crossed, 0);
    }
    EXPECT_GT(hits, 100U) << "the barrier had something to hold";
}

// Solids of every kind in the jet, as walls and as bodies that are free to go.
std::string solid_of(int kind, bool body)
{
    const std::string place = "position = [0.15, 0, 0]\n"
                              "rotation_deg = { axis = [1, 2, 0.5], angle = 40.0 }\n";
    const std::string shape = kind == 0 ? "shape = \"box\"\nsize = [0.2, 0.3, 0.25]\n" + place
                              : kind == 1
                                  ? "shape = \"sphere\"\nradius = 0.14\nposition = [0.15, 0, 0]\n"
                                  : "shape = \"cylinder\"\nradius = 0.1\nlength = 0.3\n" + place;
    return (body ? "[[body]]\nname = \"it\"\ndensity = 400.0\n" : "[[wall]]\nname = \"it\"\n") +
           shape;
}

// A tetrahedron in place of a shape.
MeshShape tetrahedron(double size)
{
    MeshShape mesh;
    mesh.corners = {
        {size, size, size}, {size, -size, -size}, {-size, size, -size}, {-size, -size, size}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

Simulation solid_in_jet(int kind, bool body, double speed)
{
    Scene scene =
        parse_case(jet(3, speed, 0.1, false) + solid_of(kind == 3 ? 0 : kind, body), "test.toml");
    if (kind == 3 && body) {
        scene.bodies[0].shape = tetrahedron(0.12);
    } else if (kind == 3) {
        std::get<SolidWall>(scene.walls[0].geometry).shape = tetrahedron(0.12);
    }
    const Filling filling = fill(scene);
    return make_simulation(scene, make_plan(scene, filling), filling);
}

TEST(WallBarrier, HoldsAtSolidsOfEveryShape)
{
    set_threads(1);
    for (int kind = 0; kind < 4; ++kind) {
        for (const bool body : {false, true}) {
            SCOPED_TRACE(fmt::format("kind {}, body {}", kind, body));
            Simulation sim = solid_in_jet(kind, body, 6);
            std::size_t hits = 0;
            for (int n = 0; n < 150; ++n) {
                step_on(sim);
                hits += hits_of_step(*sim.barrier);
                ASSERT_EQ(particles_in_solids(sim), 0) << "step " << n;
            }
            EXPECT_GT(hits, 0U);
            EXPECT_LT(sim.conservation.worst_closure, 6e-8)
                << "half a unit of the last place of a float";
        }
    }
    set_threads(0);
}

// A basin holds from inside.
TEST(WallBarrier, HoldsInABasin)
{
    Simulation sim = make(jet(2, 8, 0.1, false) +
                          "[[wall]]\nname = \"box\"\nshape = \"basin\"\nmin = [-0.6, -1, -0.3]\n"
                          "max = [0, 1, 0.3]\n");
    while (sim.clock.time < 0.2) {
        step_on(sim);
        ASSERT_EQ(particles_in_solids(sim), 0) << "at " << sim.clock.time << " s";
    }
    EXPECT_EQ(sim.fluid->lost.count, 0);
    EXPECT_LT(sim.conservation.worst_closure, 6e-8);
}

// One particle just before a floating body's side, and one within: the impulses by hand.
TEST(WallBarrier, GivesTheImpulseThatTheSolidFeels)
{
    Simulation sim = make(jet(2, 0, 0.5, false) +
                          "[[body]]\nname = \"it\"\nshape = \"box\"\nsize = [0.4, 1, 0.4]\n"
                          "density = 500.0\nposition = [0.2, 0, 0]\nvelocity = [-1, 0, 0]\n");
    Store& particles = sim.fluid->particles.fluid;
    const double dt = 1e-4;
    const double m = sim.fluid->parameters.mass;
    const auto x = particles[field::position];
    const auto v = particles[field::velocity];
    x[0] = {-0.2 * spacing, 0, 0.1};
    v[0] = {3, 0, 2};
    x[1] = {0.1 * spacing, 0, -0.05};
    v[1] = {0, 0, 1};
    sim.barrier.reset();
    sim.barrier = make_wall_barrier(sim.scene);
    hold(sim, dt);
    EXPECT_LT((v[0] - Vec3(-1, 0, 2)).norm(), 1e-12) << "goes with the body, and slips";
    const double out = std::min(0.1 * spacing / (20 * dt), 0.02 * sim.fluid->parameters.eos.c0);
    EXPECT_LT((v[1] - Vec3(-1 - out, 0, 1)).norm(), 1e-12) << "is led out";
    const Vec3 first = m * Vec3(4, 0, 0) / dt;
    const Vec3 second = m * Vec3(1 + out, 0, 0) / dt;
    const Wrench& load = sim.loads.bodies[0];
    EXPECT_LT((load.force - first - second).norm(), 1e-9 * first.norm());
    const Vec3 torque =
        (x[0] - Vec3(0.2, 0, 0)).cross(first) + (x[1] - Vec3(0.2, 0, 0)).cross(second);
    EXPECT_LT((load.torque - torque).norm(), 1e-9 * torque.norm());
}

// Particles thrown at a wall from distances of 0.05 to 1 spacing, little apart: where each would
// end the step changes in proportion to where it starts. A rule that jumps lets round-off decide.
TEST(WallBarrier, IsContinuousInTheDistance)
{
    Simulation sim =
        make(jet(2, 0, 0.5, false) +
             "[[wall]]\nshape = \"box\"\nsize = [0.4, 1, 0.4]\nposition = [0.2, 0, 0]\n");
    Store& particles = sim.fluid->particles.fluid;
    const Index count = particles.size();
    const double apart = 0.95 * spacing / static_cast<double>(count);
    const double dt = 1e-3;
    for (const double speed : {0.1, 1.0, 10.0, 200.0}) {
        const auto x = particles[field::position];
        const auto v = particles[field::velocity];
        for (Index k = 0; k < count; ++k) {
            x[at(k)] = {-0.05 * spacing - static_cast<double>(k) * apart, 0, 0.1};
            v[at(k)] = {speed, 0, 0};
        }
        sim.barrier = make_wall_barrier(sim.scene);
        hold(sim, dt);
        for (Index k = 1; k < count; ++k) {
            const double change = (x[at(k)] - x[at(k - 1)] + dt * (v[at(k)] - v[at(k - 1)])).norm();
            EXPECT_LE(change, 5 * apart) << "speed " << speed << ", distance " << -x[at(k)].x();
        }
    }
}

// A body of half the mass of the particle that hits it in the middle: m sum K = 2, so half of the
// impulse that would stop the particle is exchanged. Another particle, on a wall, is stopped.
TEST(WallBarrier, ALightBodyTakesItsShareOfWhatItStops)
{
    for (const double part : {0.5, 0.25, 2.0}) {
        const double m = 1000 * spacing * spacing;
        Simulation sim =
            make(jet(2, 0, 0.5, false) +
                 fmt::format("[[body]]\nname = \"it\"\nshape = \"box\"\nsize = [0.4, 1, 0.4]\n"
                             "density = {}\nposition = [0.2, 0, 0]\nvelocity = [-1, 0, 0]\n"
                             "[[wall]]\nshape = \"box\"\nsize = [0.4, 1, 0.4]\n"
                             "position = [0.2, 0, 1]\n",
                             part * m / 0.16));
        Store& particles = sim.fluid->particles.fluid;
        const double mass = sim.fluid->parameters.mass;
        const double share = std::min(1.0, part * m / mass);
        const auto x = particles[field::position];
        const auto v = particles[field::velocity];
        x[0] = {-0.2 * spacing, 0, 0};
        v[0] = {3, 0, 2};
        x[1] = {-0.2 * spacing, 0, 1};
        v[1] = {3, 0, 2};
        sim.barrier.reset();
        sim.barrier = make_wall_barrier(sim.scene);
        const double dt = 1e-4;
        hold(sim, dt);
        EXPECT_LT((v[0] - Vec3(3 - 4 * share, 0, 2)).norm(), 1e-9) << part;
        EXPECT_LT((v[1] - Vec3(0, 0, 2)).norm(), 1e-12) << part;
        const Vec3 received = mass * 4 * share / dt * Vec3(1, 0, 0);
        EXPECT_LT((sim.loads.bodies[0].force - received).norm(), 1e-9 * received.norm()) << part;
        EXPECT_LT(sim.loads.bodies[0].torque.norm(), 1e-9 * received.norm()) << part;
    }
}

// A light body between two particles that hit it at the same speed, and does not move: m sum K is
// that of both. If their impulses cancelled, it would press both as a heavy body does.
TEST(WallBarrier, OppositeHitsOnALightBodyDoNotCancel)
{
    for (const double part : {0.25, 1.0, 1.5, 3.0}) {
        const double m = 1000 * spacing * spacing;
        Simulation sim =
            make(jet(2, 0, 0.5, false) +
                 fmt::format("[[body]]\nname = \"it\"\nshape = \"box\"\nsize = [0.4, 1, 0.4]\n"
                             "density = {}\nposition = [0.2, 0, 0]\n",
                             part * m / 0.16));
        Store& particles = sim.fluid->particles.fluid;
        const auto x = particles[field::position];
        const auto v = particles[field::velocity];
        x[0] = {-0.2 * spacing, 0, 0};
        v[0] = {3, 0, 2};
        x[1] = {0.4 + 0.1 * spacing, 0, 0};
        v[1] = {-3, 0, 1};
        sim.barrier.reset();
        sim.barrier = make_wall_barrier(sim.scene);
        hold(sim, 1e-4);
        const double share = std::min(1.0, part * m / sim.fluid->parameters.mass / 2);
        EXPECT_LT((v[0] - Vec3(3 - 3 * share, 0, 2)).norm(), 1e-9) << part;
        EXPECT_LT((v[1] - Vec3(3 * share - 3, 0, 1)).norm(), 1e-9) << part;
        EXPECT_LT(sim.loads.bodies[0].force.norm(), 1e-6) << part;
    }
}

// In the joint of two solids that stand no velocity leads out: the particle stays, and they are not
// pressed apart. What flows there is stopped.
TEST(WallBarrier, DoesNotPressSolidsApart)
{
    for (const double gap : {-0.1, 0.0, 0.1, 0.2}) {
        std::string text = jet(2, 0, 0.5, false);
        for (const double side : {-1.0, 1.0}) {
            text += fmt::format("[[wall]]\nshape = \"box\"\nsize = [0.8, 1, 0.4]\n"
                                "position = [0.5, 0, {}]\n",
                                side * (0.2 + gap * spacing / 2));
        }
        Simulation sim = make(text);
        Store& particles = sim.fluid->particles.fluid;
        const auto x = particles[field::position];
        const auto v = particles[field::velocity];
        x[0] = {0.5, 0, 0.02 * spacing};
        v[0] = {1, 0, 0};
        x[1] = {0.6, 0, 0};
        v[1] = {1, 0, 2};
        sim.barrier.reset();
        sim.barrier = make_wall_barrier(sim.scene);
        const double dt = 1e-4;
        hold(sim, dt);
        EXPECT_LT((v[0] - Vec3(1, 0, 0)).norm(), 1e-12) << gap;
        EXPECT_LT((v[1] - Vec3(1, 0, 0)).norm(), 1e-12) << gap;
        const double stopped = 2 * sim.fluid->parameters.mass / dt;
        EXPECT_LT((sim.loads.walls[1] - Vec3(0, 0, stopped)).norm(), 1e-9 * stopped) << gap;
        EXPECT_LT(sim.loads.walls[0].norm(), 1e-9 * stopped) << gap;
    }
}

// What is beyond the edge of a period is its image: a pier at one end holds what is at the other.
TEST(WallBarrier, HoldsAcrossThePeriod)
{
    Simulation sim = make(R"(
dimensions = 2
[time]
end = 10.0
[particles]
spacing = 0.04
[domain]
min = [0, 0, -1]
max = [1.2, 0, 1]
periodic = ["x"]
[fluid]
[[fluid.block]]
shape = "box"
min = [0.6, 0, -0.2]
max = [1.0, 0, 0.2]
[[wall]]
name = "pier"
shape = "box"
min = [0, 0, -0.6]
max = [0.1, 0, 0.6]
)");
    Store& particles = sim.fluid->particles.fluid;
    const auto x = particles[field::position];
    const auto v = particles[field::velocity];
    x[0] = {1.2 - 0.1 * spacing, 0, 0.1};
    x[1] = {1.2 + 0.1 * spacing, 0, 0.2}; // has gone through the edge since lists were made
    v[0] = v[1] = {3, 0, 2};
    hold(sim, 1e-4);
    EXPECT_LT((v[0] - Vec3(0, 0, 2)).norm(), 1e-12);
    EXPECT_LT(v[1].x(), 0) << "is led out";
    sim.clock.time = 0;
    x[1].x() += 0.3 * spacing;
    EXPECT_EQ(particles_in_solids(sim), 1);
}

// Some hundred particles are set before a plate, which they then meet in their own ways.
Simulation particles_before_plate()
{
    Simulation sim = make(jet(2, 7, 0.05, false) + plate_of({0, 0.5, 0}, 0.1 * spacing, 0) +
                              "[[body]]\nname = \"it\"\nshape = \"sphere\"\nradius = 0.1\n"
                              "density = 300.0\nposition = [-0.56, 0, 0]\nvelocity = [9, 0, 0]\n",
                          {"particles.spacing=0.01"});
    const auto x = sim.fluid->particles.fluid[field::position];
    for (std::size_t k = 0; k < 200; ++k) {
        x[k] = {-0.0032 - 1e-5 * static_cast<double>(k % 40), 0, -0.45 + 0.0045 * double(k)};
    }
    return sim;
}

TEST(WallBarrier, GivesTheSameBitsForAnyThreadsAndFromACheckpoint)
{
    constexpr int before = 1;
    constexpr int after = 40;
    set_threads(1);
    Simulation one = particles_before_plate();
    std::size_t hits = 0;
    advance(one, before);
    const Snapshot middle = save(one);
    for (int n = 0; n < after; ++n) {
        step_on(one);
        hits += hits_of_step(*one.barrier);
    }
    set_threads(3);
    Simulation resumed = particles_before_plate();
    restore(resumed, middle);
    advance(resumed, after);
    Simulation three = particles_before_plate();
    advance(three, before + after);
    set_threads(0);
    EXPECT_GT(hits, 0U);
    expect_same_bits(save(one), save(three));
    expect_same_bits(save(one), save(resumed));
}

} // namespace
} // namespace hyoryu::test_wall_barrier
