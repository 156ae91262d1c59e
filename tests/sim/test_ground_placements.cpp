// SPDX-License-Identifier: MIT
// Ground wherever it lies against the lattice: beds, planes, slopes, steps and meshes at random
// heights and angles under blocks that start anywhere. No water is or gets inside a solid, none is
// lost, none appears, and still water stays still. A placement follows from its seed alone;
// HYORYU_PLACEMENTS=200 is the nightly size, with meshes in three dimensions, HYORYU_SEED the first
// seed, HYORYU_SHOW=1 prints the cases.
#include "../dice.hpp"
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/solid_surface.hpp"
#include "runs.hpp"

#include "hyoryu/sim/gauges.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>
#include <numbers>

namespace hyoryu::test_ground_placements {
namespace {

enum class Ground { bed, plane, slope, step, mesh };

// A tank of a length between upright sides, water from `start` to `level` above ground of a height
// at x = 0 that is between the two, or below both.
struct Placement {
    Ground ground = Ground::bed;
    double spacing = 0.05, length = 1, width = 0, height = 0, rise = 0;
    double start = 0, level = 0.6, water = 1; // from x = 0 to `water` [m]
    bool mps = false;
    std::string text;
    double volume = 0; // of the water [m2], [m3]
};

double ground_at(const Placement& p, double x)
{
    if (p.ground == Ground::step) {
        return p.height + (x > p.length / 2 ? p.rise : 0);
    }
    return p.height +
           (p.ground == Ground::bed || p.ground == Ground::plane ? 0 : p.rise * x / p.length);
}

double volume_of(const Placement& p)
{
    double area = 0;
    constexpr int n = 20000;
    for (int k = 0; k < n; ++k) {
        const double x = (k + 0.5) / n * p.water;
        area += p.water / n * std::max(p.level - std::max(ground_at(p, x), p.start), 0.0);
    }
    return area * (p.width > 0 ? p.width : 1);
}

std::string ground_of(const Placement& p)
{
    const auto box = [&](const char* name, double from, double to, double top) {
        return fmt::format("[[wall]]\nname = \"{}\"\nshape = \"box\"\nmin = [{}, -0.5, -1.0]\n"
                           "max = [{}, {}, {}]\n",
                           name, from, to, p.width + 0.5, top);
    };
    if (p.ground == Ground::bed || p.ground == Ground::mesh) {
        return box("ground", -0.5, p.length + 0.5, p.height);
    }
    if (p.ground == Ground::step) {
        return box("ground", -0.5, p.length + 0.5, p.height) +
               box("step", p.length / 2, p.length + 0.5, p.height + p.rise);
    }
    const double angle = std::atan2(p.ground == Ground::plane ? 0 : p.rise, p.length);
    if (p.ground == Ground::plane) {
        return fmt::format("[[wall]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, {}]\n"
                           "normal = [0, 0, 1]\n",
                           p.height);
    }
    // A box turned about the middle of its top, which stays at half the rise.
    const double half = 0.4;
    const double x = p.length / 2 + half * std::sin(angle);
    const double z = p.height + p.rise / 2 - half * std::cos(angle);
    return fmt::format("[[wall]]\nname = \"ground\"\nshape = \"box\"\nsize = [{}, {}, {}]\n"
                       "position = [{}, {}, {}]\n"
                       "rotation_deg = {{ axis = [0, 1, 0], angle = {} }}\n",
                       1.5 * p.length + 1, p.width + 1, 2 * half, x, p.width / 2, z,
                       -angle * 180 / std::numbers::pi);
}

std::string text_of(const Placement& p)
{
    const int dimensions = p.width > 0 ? 3 : 2;
    std::string text =
        fmt::format("dimensions = {}\n[time]\nend = 10.0\n[particles]\nspacing = {}\n[fluid]\n"
                    "formulation = \"{}\"\n[[fluid.block]]\nshape = \"box\"\nmin = [0.0, 0.0, {}]\n"
                    "max = [{}, {}, {}]\n[[wall]]\nname = \"sides\"\nshape = \"basin\"\n"
                    "min = [0, 0, -0.4]\nmax = [{}, {}, {}]\nopen = [\"-z\", \"+z\"]\n",
                    dimensions, p.spacing, p.mps ? "mps" : "sph", p.start, p.water, p.width,
                    p.level, p.length, p.width, p.level + 1.5);
    return text + ground_of(p);
}

Placement placement(std::uint64_t seed, bool still, bool solid)
{
    Dice dice(seed);
    Placement p;
    const int kind = dice.below(solid ? 5 : 4);
    p.ground = static_cast<Ground>(kind);
    p.spacing = dice.below(2) == 0 ? 0.05 : 0.04;
    p.length = dice.between(0.9, 1.3);
    p.height = dice.between(-0.05, 0.1);
    p.rise = dice.between(0.05, 0.5);
    p.start = dice.between(-0.05, 0.1);
    p.level = 0.25 + std::max(p.height + (still ? 0 : p.rise), p.start) + dice.between(0, 0.3);
    p.water = still ? p.length : p.length * dice.between(0.3, 0.7);
    p.mps = !still && dice.below(5) == 0;
    p.width = p.ground == Ground::mesh ? 6.3 * p.spacing : 0;
    if (still) {
        p.ground = static_cast<Ground>(kind % 2); // flat
        p.width = 0;
        p.start = std::min(p.start, p.height);
    }
    p.text = text_of(p);
    p.volume = volume_of(p);
    return p;
}

// A prism under a slope in place of the bed: what an STL file of a beach would be.
void put_mesh(const Placement& p, Scene& scene)
{
    const double low = -1;
    MeshShape prism;
    for (const double y : {-0.5, p.width + 0.5}) {
        for (const double x : {-0.5, p.length + 0.5}) {
            prism.corners.emplace_back(x, y, low);
            prism.corners.emplace_back(x, y, ground_at(p, x));
        }
    }
    prism.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 7, 6}, {4, 5, 7}, {0, 6, 2}, {0, 4, 6},
                       {1, 7, 5}, {1, 3, 7}, {0, 5, 4}, {0, 1, 5}, {2, 7, 3}, {2, 6, 7}};
    auto& solid = std::get<SolidWall>(scene.walls.back().geometry);
    solid = {prism, Vec3(0, 0, 0), Quat::Identity()};
}

Scene scene_of(const Placement& p)
{
    Scene scene = parse_case(p.text, "test.toml");
    if (p.ground == Ground::mesh) {
        put_mesh(p, scene);
    }
    return scene;
}

// The least distance of the fluid from any wall or body, in spacings.
double least_clearance(const Scene& scene, const Filling& filling)
{
    double least = infinity;
    std::vector<SolidSurface> surfaces;
    for (const Wall& wall : scene.walls) {
        surfaces.push_back(surface_of(wall, 3 * scene.spacing, scene.dimensions));
    }
    for (const BodySettings& body : scene.bodies) {
        surfaces.push_back(surface_of(body, scene.dimensions));
    }
    for (const SolidSurface& surface : surfaces) {
        for (const Vec3& x : filling.fluid) {
            const Vec3 own = surface.rotation.conjugate() * (x - surface.centre);
            least = std::min(least, nearest_place(surface, own).distance);
        }
    }
    return least / scene.spacing;
}

// The largest kernel sum of fluid and walls over a fluid particle; 1 on a lattice of the spacing.
double most_crowded(const Scene& scene, const Filling& filling)
{
    const double dp = scene.spacing;
    const Kernel kernel = make_kernel(1.5 * dp, dp, scene.dimensions);
    const double volume = std::pow(dp, scene.dimensions);
    double most = 0;
    for (const Vec3& a : filling.fluid) {
        double sum = 0;
        const auto add = [&](const Vec3& b) {
            const Vec3 r = a - b;
            sum += r.squaredNorm() < sq(kernel.support)
                       ? volume * kernel(Vec<real>{r.x(), r.y(), r.z()}).w
                       : 0;
        };
        std::ranges::for_each(filling.fluid, add);
        std::ranges::for_each(filling.wall, add);
        for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
            for (const Vec3& p : filling.bodies[b].points) {
                add(scene.bodies[b].position + scene.bodies[b].rotation * p);
            }
        }
        most = std::max(most, sum);
    }
    return most;
}

// From which on a row at the start presses through a wall of particles where nothing else holds it:
// the least sum of those that did.
constexpr double presses_through = 1.19;

// Calls f(placement) for the placements of this run.
void for_placements(int usual, bool still, const auto& f)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_PLACEMENTS", usual);
    set_threads(1); // the scenes are small
    for (int seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE(fmt::format("HYORYU_SEED={} HYORYU_PLACEMENTS=1", seed));
        const Placement p =
            placement(static_cast<std::uint64_t>(seed), still, count > usual || count == 1);
        if (std::getenv("HYORYU_SHOW") != nullptr) {
            fmt::print("{}", p.text);
        }
        f(p);
    }
    set_threads(0);
}

// Volumes in layers of particles over the bed.
TEST(GroundPlacements, FillingKeepsItsDistanceAndItsVolume)
{
    double excess = 0;
    int count = 0;
    for (const bool still : {false, true}) {
        for_placements(40, still, [&](const Placement& p) {
            const Scene scene = scene_of(p);
            const Filling filling = fill(scene);
            const double filled =
                static_cast<double>(filling.fluid.size()) * std::pow(p.spacing, scene.dimensions);
            const double layer = p.spacing * p.water * (p.width > 0 ? p.width : 1);
            excess += (filled - p.volume) / layer;
            count += 1;
            EXPECT_NEAR(filled / layer, p.volume / layer, 0.55) << "half a layer, or of a column";
            EXPECT_NEAR(filling.fluid_volume / layer, p.volume / layer, 0.05)
                << "the rays through a column are a quarter of a spacing apart";
            EXPECT_GT(least_clearance(scene, filling), 0.45) << "half of a rounded cell";
            EXPECT_LT(most_crowded(scene, filling), presses_through);
        });
    }
    if (count > 10) {
        EXPECT_NEAR(excess / count, 0, 0.1) << "neither water gained nor lost in the mean";
    }
}

// A body at random in a tank that fits its lattice.
Scene tank_with_body(std::uint64_t seed)
{
    Dice dice(seed);
    const double a = dice.between(0.15, 0.4);
    const double b = dice.between(0.15, 0.4);
    const bool round = dice.below(3) == 0;
    const double x = dice.between(0.3, 0.9);
    const double z = dice.between(0.3, 0.8);
    const double angle = dice.below(2) == 0 ? 0 : dice.between(0, 90);
    return parse_case(
        fmt::format("dimensions = 2\n[time]\nend = 10.0\n[particles]\nspacing = 0.04\n[fluid]\n"
                    "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [1.2, 0, 0.8]\n"
                    "[[wall]]\nname = \"sides\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                    "max = [1.2, 0, 2.0]\nopen = [\"+z\"]\n[[body]]\nname = \"body\"\n"
                    "density = 600.0\nposition = [{}, 0, {}]\n{}\n"
                    "rotation_deg = {{ axis = [0, 1, 0], angle = {} }}\n",
                    x, z,
                    round ? fmt::format("shape = \"sphere\"\nradius = {}", a / 2)
                          : fmt::format("shape = \"box\"\nsize = [{}, 1, {}]", a, b),
                    angle),
        "test.toml");
}

// Beside a body, whose own layers are of whole particles too, lie parts of a layer that are pushed
// into the next one: it was 1.33 where they stayed in the cells that the body cuts.
TEST(GroundPlacements, FillingKeepsItsDistanceFromBodies)
{
    const int count = number_from("HYORYU_PLACEMENTS", 60);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = tank_with_body(static_cast<std::uint64_t>(seed));
        const Filling filling = fill(scene);
        EXPECT_GT(least_clearance(scene, filling), 0.44);
        EXPECT_LT(most_crowded(scene, filling), 1.25);
    }
}

// Boxes of a stack in a tank that fits its lattice, turned together about a horizontal axis.
Scene tank_with_stack(std::uint64_t seed)
{
    Dice dice(seed);
    const double angle = dice.below(2) == 0 ? 0 : dice.between(-30, 30);
    const double turn = angle * std::numbers::pi / 180;
    const Vec3 up(std::sin(turn), 0, std::cos(turn));
    const Vec3 along(std::cos(turn), 0, -std::sin(turn));
    Vec3 foot{dice.between(0.4, 0.8), 0, dice.between(0.1, 0.2)};
    std::string text = "dimensions = 2\n[time]\nend = 10.0\n[particles]\nspacing = 0.04\n[fluid]\n"
                       "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\nmax = [1.2, 0, 0.8]\n"
                       "[[wall]]\nname = \"sides\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                       "max = [1.2, 0, 2.0]\nopen = [\"+z\"]\n";
    for (int k = 0; k < 3; ++k) {
        const double width = dice.between(0.15, 0.4);
        const double height = dice.between(0.1, 0.2);
        const Vec3 place = foot + height / 2 * up + dice.between(-0.1, 0.1) * along;
        foot += height * up;
        text += fmt::format("[[body]]\nname = \"box{}\"\nshape = \"box\"\nsize = [{}, 1, {}]\n"
                            "density = 600.0\nposition = [{}, 0, {}]\n"
                            "rotation_deg = {{ axis = [0, 1, 0], angle = {} }}\n",
                            k, width, height, place.x(), place.z(), angle);
    }
    return parse_case(text, "test.toml");
}

// Each box takes its part out of the cells between two of them: what both left, deep in their
// joint, pressed them apart with ten times their weight.
TEST(GroundPlacements, FillingLeavesNoWaterBetweenBodiesThatTouch)
{
    const int count = number_from("HYORYU_PLACEMENTS", 60);
    for (int seed = 1; seed <= count; ++seed) {
        SCOPED_TRACE(seed);
        const Scene scene = tank_with_stack(static_cast<std::uint64_t>(seed));
        EXPECT_GT(least_clearance(scene, fill(scene)), 0.4);
    }
}

TEST(GroundPlacements, NoWaterGetsIntoASolidOrIsLost)
{
    constexpr int look_every = 20; // steps, in which water moves by a spacing at most
    for_placements(20, false, [&](const Placement& p) {
        const Scene scene = scene_of(p);
        const Filling filling = fill(scene);
        Simulation sim = make_simulation(scene, make_plan(scene, filling), filling);
        Index inside = 0;
        while (sim.clock.time < 1.0) {
            step_on(sim);
            if (sim.clock.step % look_every == 0) {
                inside = std::max(inside, particles_in_solids(sim));
            }
        }
        EXPECT_EQ(inside, 0);
        EXPECT_EQ(sim.fluid->lost.count, 0);
        if (!p.mps) { // MPS does not promise it
            EXPECT_LT(sim.conservation.worst_closure, 6e-8)
                << "half a unit of the last place of a float";
        }
    });
}

// The pressure that a gauge on the bed reads over that of the depth, and the top speed over
// sqrt(g H), both between two times.
struct Stillness {
    double pressure = 0, speed = 0;
};

Stillness stillness(const Placement& p, double from, double to)
{
    Scene scene = scene_of(p);
    Gauge gauge;
    gauge.name = "bed";
    gauge.type = GaugeType::pressure;
    gauge.at = {p.length / 2, 0, p.height};
    scene.gauges.push_back(gauge);
    const Filling filling = fill(scene);
    Simulation sim = make_simulation(scene, make_plan(scene, filling), filling);
    const double gH = scene.gravity.norm() * p.volume / p.water;
    Stillness result;
    while (sim.clock.time < to) {
        step_on(sim);
        if (sim.clock.time > from) {
            const double dt = sim.clock.dt / (to - from);
            result.pressure += dt * next_gauge_row(sim).front() / (scene.fluid->density * gH);
            result.speed = std::max(result.speed, top_speed(*sim.fluid) / std::sqrt(gH));
        }
    }
    return result;
}

TEST(GroundPlacements, StillWaterPressesOnItsBedAndStaysStill)
{
    for_placements(10, true, [&](const Placement& p) {
        const Stillness still = stillness(p, 2, 3);
        EXPECT_NEAR(still.pressure, 1, 0.015);
        EXPECT_LT(still.speed, 0.01);
    });
}

// Seeds whose cells are cut or stretched, which started too dense by as much: the bed felt up to 2
// % too much for three seconds, and some of the water went on moving at more than 1 %.
TEST(GroundPlacements, StillWaterInStretchedCellsStaysStill)
{
    for (const std::uint64_t seed : {104, 146, 195}) {
        SCOPED_TRACE(seed);
        const Stillness still = stillness(placement(seed, true, true), 2, 3);
        EXPECT_NEAR(still.pressure, 1, 0.005);
        EXPECT_LT(still.speed, 0.01);
    }
}

// Mean lift over its Archimedes value in the first tenth of a second; the body is held.
double early_lift(std::uint64_t seed)
{
    Scene scene = tank_with_body(seed);
    scene.bodies[0].fixed = true;
    const Filling filling = fill(scene);
    const double volume_taken =
        1.2 * 0.8 - static_cast<double>(filling.fluid.size()) * sq(scene.spacing);
    Simulation sim = make_simulation(scene, make_plan(scene, filling), filling);
    double impulse = 0;
    while (sim.clock.time < 0.1) {
        step_on(sim);
        impulse += sim.clock.dt * sim.loads.bodies[0].force.z();
    }
    return impulse / sim.clock.time / (1000 * 9.81 * volume_taken);
}

// The mean error of bodies in cells that they cut, from the first step on.
TEST(GroundPlacements, WaterBesideABodyStartsAtThePressureOfItsDepth)
{
    const int count = number_from("HYORYU_PLACEMENTS", 8);
    double error = 0;
    for (int seed = 1; seed <= count; ++seed) {
        error += std::abs(early_lift(static_cast<std::uint64_t>(seed)) - 1) / count;
    }
    EXPECT_LT(error, 0.02) << "as filled: 0.035";
}

} // namespace
} // namespace hyoryu::test_ground_placements
