// SPDX-License-Identifier: MIT
// Bodies on the triangles of a terrain and against buildings: a plane of triangles, in any map, is
// the plane, a fine parabola loses what its creases take, and a prism is the box.
#include "dice.hpp"
#include "own_folder.hpp"
#include "runs.hpp"

#include "hyoryu/scene/rigid_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

namespace hyoryu::test_terrain_contact {
namespace {

namespace fs = std::filesystem;
using Complex = std::complex<double>;

constexpr double g = 9.81; // [m/s2]

// A grid file about an origin in a map and the [[wall]] that takes it.
class TerrainContact : public testing::Test {
protected:
    // The map lies within kilometres of its zero: places there are exact to 1e-12 m, and so is the
    // plane that the heights are taken from.
    struct Map {
        Complex origin; // easting + i northing [m]
        double azimuth_deg = 90;
        double cell = 0.02;         // of the grid and of the surface [m]
        double west = 1, south = 1; // of the origin, which the grid covers [m]
        double east = 1, north = 1;
    };

    // Heights at the places of the case, x + i y.
    void write_grid(const Map& map, const std::function<double(Complex)>& ground) const
    {
        const int columns = static_cast<int>(std::lround((map.west + map.east) / map.cell)) + 1;
        const int rows = static_cast<int>(std::lround((map.south + map.north) / map.cell)) + 1;
        const Complex first = map.origin - Complex(map.west, map.south);
        std::string text =
            fmt::format("ncols {}\nnrows {}\nxllcenter {}\nyllcenter {}\ncellsize {}\n", columns,
                        rows, first.real(), first.imag(), map.cell);
        const Complex turn = std::polar(1.0, (map.azimuth_deg - 90) * std::numbers::pi / 180);
        for (int j = rows - 1; j >= 0; --j) {
            for (int i = 0; i < columns; ++i) {
                const Complex place = first + Complex(i * map.cell, j * map.cell);
                text += fmt::format("{} ", ground((place - map.origin) * turn));
            }
            text += '\n';
        }
        folder_.put("ground.asc", text);
    }

    static std::string terrain(const Map& map, const std::array<double, 4>& extent)
    {
        return fmt::format("shape = \"terrain\"\nfile = \"ground.asc\"\norigin = [{}, {}]\n"
                           "azimuth_deg = {}\nextent = [{}, {}, {}, {}]\nresolution = {}\n",
                           map.origin.real(), map.origin.imag(), map.azimuth_deg, extent[0],
                           extent[1], extent[2], extent[3], map.cell);
    }

    Rigid scene(const std::string& wall, const std::string& body, double restitution,
                double friction) const
    {
        const std::string text =
            fmt::format("[time]\nend = 1\nstep = 0.001\n[particles]\nspacing = 0.01\n[contact]\n"
                        "restitution = {}\nfriction = {}\n[[wall]]\n{}[[body]]\n{}",
                        restitution, friction, wall, body);
        return make_rigid(parse_case(text, folder_ / "case.toml"));
    }

    // Rectangles in the coordinates of the case, by two corners each: "b", "c" and so on.
    void write_footprints(const std::vector<std::pair<Vec3, Vec3>>& rectangles) const
    {
        std::vector<std::string> features;
        for (const auto& [low, high] : rectangles) {
            features.push_back(fmt::format(
                "{{\"type\": \"Feature\", \"properties\": {{\"id\": \"{4}\"}}, \"geometry\": "
                "{{\"type\": \"Polygon\", \"coordinates\": [[[{0}, {1}], [{2}, {1}], [{2}, {3}], "
                "[{0}, {3}], [{0}, {1}]]]}}}}",
                low.x(), low.y(), high.x(), high.y(), static_cast<char>('b' + features.size())));
        }
        std::ofstream(folder_ / "b.geojson") << fmt::format(
            "{{\"type\": \"FeatureCollection\", \"features\": [{}]}}", fmt::join(features, ", "));
    }

    Simulation simulate(const std::string& text) const
    {
        const Scene scene = parse_case(text, folder_ / "case.toml");
        const Filling filling = fill(scene);
        return make_simulation(scene, make_plan(scene, filling), filling);
    }

    OwnFolder folder_;
};

std::vector<Contact> run(Rigid& rigid, int steps, double dt,
                         const std::function<void(double)>& each = {})
{
    const std::vector<Wrench> none(rigid.bodies.size());
    std::vector<Contact> log;
    for (int k = 0; k < steps; ++k) {
        step(rigid, k * dt, dt, none, log);
        if (each) {
            each((k + 1) * dt);
        }
    }
    return log;
}

double distance_of(const Body& a, const Body& b)
{
    return (a.position - b.position).norm() +
           (a.orientation.toRotationMatrix() - b.orientation.toRotationMatrix()).norm();
}

std::string numbers_of(const Vec3& v)
{
    return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

// The cube of the paper, flat on a plane through the origin, turned about its normal, at 1 m/s
// along its own x axis.
std::string sliding_cube(const Vec3& normal, double heading)
{
    const Quat turn = Quat::FromTwoVectors(Vec3::UnitZ(), normal) *
                      Quat(Eigen::AngleAxisd(heading, Vec3::UnitZ()));
    return fmt::format("shape = \"box\"\nsize = [0.06, 0.06, 0.05]\ndensity = 250\n"
                       "position = {}\nrotation = [{}, {}, {}, {}]\nvelocity = {}\n",
                       numbers_of(0.025 * normal), turn.w(), turn.x(), turn.y(), turn.z(),
                       numbers_of(turn * Vec3::UnitX()));
}

// A cube that slides in any direction over a plane of 10,000 triangles in any map, level or not: as
// on a wall that is a plane, and where the ground is level by u t - mu g t^2 / 2.
TEST_F(TerrainContact, ABoxSlidesOverAPlaneOfTrianglesAsOverAPlane)
{
    Dice dice(71);
    for (int n = 0; n < 9; ++n) {
        SCOPED_TRACE(n);
        Map map{{dice.between(-1e3, 1e3), dice.between(-1e3, 1e3)}, dice.between(-180, 360)};
        map.cell = n % 2 == 0 ? 0.02 : 0.03;
        map.west = map.south = map.east = map.north = 75 * map.cell;
        const double slope = n % 3 == 0 ? 0 : dice.between(0, 0.25);
        const Complex rise = std::polar(slope, dice.between(0, 2 * std::numbers::pi));
        write_grid(map, [&](Complex at) { return (std::conj(rise) * at).real(); });
        const double half = 35.5 * map.cell;
        const Vec3 normal = Vec3(-rise.real(), -rise.imag(), 1).normalized();
        // So much more than the slope that it stops within 0.35 s.
        const double friction = slope + dice.between(0.3, 0.5);
        const std::string cube = sliding_cube(normal, dice.between(0, 2 * std::numbers::pi));
        Rigid triangles = scene(terrain(map, {-half, -half, half, half}), cube, 0.3, friction);
        Rigid plane = scene(
            fmt::format("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = {}\n", numbers_of(normal)),
            cube, 0.3, friction);
        EXPECT_GE(std::get<MeshSurface>(triangles.boundaries[0].surface).triangles.size(), 10000U);
        std::vector<Body> path;
        run(plane, 400, 1e-3, [&](double) { path.push_back(plane.bodies[0]); });
        auto expected = path.begin();
        run(triangles, 400, 1e-3, [&](double t) {
            const Body& body = triangles.bodies[0];
            EXPECT_LE(distance_of(body, *expected++), 1e-9) << t;
            if (n % 3 == 0 && t < 1 / (friction * g)) {
                EXPECT_NEAR(body.position.head<2>().norm(), t - friction * g * t * t / 2, 1e-9);
            }
        });
        EXPECT_LE(triangles.bodies[0].velocity.norm(), 1e-6);
    }
}

// A ball over 1,000 cells of z = k x^2, a valley or a hill, sliding without friction or rolling,
// restitution 0. At a crease between two facets the velocity turns by 2 k times a cell, and the
// part of it across the next facet may be lost: in all 1,000 (2 k cell)^2 of the kinetic energy,
// 6e-9 and less. Steps of a quarter of a cell follow the slope to 7e-7. An edge met from the side
// would take more, and its normal would be steeper than the parabola.
TEST_F(TerrainContact, ABallOverAThousandCellsOfAParabolaKeepsItsEnergy)
{
    Dice dice(72);
    for (int n = 0; n < 4; ++n) {
        SCOPED_TRACE(n);
        const bool rolls = n % 2 == 0;
        const double k = (n < 2 ? 1 : -1) * dice.between(5e-4, 1.25e-3); // [1/m]
        constexpr double r = 0.005;
        constexpr double half = 0.5; // of the path [m]
        Map map{{dice.between(500, 1e3), dice.between(500, 1e3)}, 90.0 * dice.below(4), 0.001};
        const bool to_east = std::fmod(map.azimuth_deg, 180) != 0;
        map.west = map.east = to_east ? 0.55 : 0.02;
        map.south = map.north = to_east ? 0.02 : 0.55;
        write_grid(map, [&](Complex at) { return k * sq(at.real()); });
        // From the middle of a facet, along it.
        const double x = -half - map.cell / 2;
        const Vec3 normal = Vec3(-2 * k * x, 0, 1).normalized();
        const double speed = dice.between(2, 3);
        const Vec3 start = Vec3(x, 0, k * (sq(x) + sq(map.cell / 2))) + r * normal;
        const std::string body = fmt::format(
            "shape = \"sphere\"\nradius = {}\ndensity = 500\nposition = {}\nvelocity = {}\n"
            "angular_velocity = [0, {}, 0]\n",
            r, numbers_of(start), numbers_of(speed * Vec3(normal.z(), 0, -normal.x())),
            rolls ? speed / r : 0);
        Rigid rigid = scene(terrain(map, {-0.54, -0.01, 0.54, 0.01}), body, 0, rolls ? 0.5 : 0);
        const Body& ball = rigid.bodies[0];
        const auto energy = [&] {
            return kinetic_energy(ball) + ball.mass.mass * g * ball.position.z();
        };
        const double before = energy();
        const double kinetic = kinetic_energy(ball);
        double steepest = 0;
        while (ball.position.x() < half + map.cell / 2) {
            for (const Contact& contact : run(rigid, 10, 1e-4)) {
                steepest = std::max(steepest, std::abs(contact.normal.x()));
            }
        }
        EXPECT_LE(std::abs(energy() - before), 1e-6 * kinetic);
        EXPECT_LE(steepest, 2 * std::abs(k) * (half + 0.02)); // where it stops
        EXPECT_LE(std::abs(ball.position.y()), 1e-12);
    }
}

// Bodies thrown against a building from its footprint and against the same box: the same blows.
TEST_F(TerrainContact, APrismIsTheBox)
{
    Dice dice(73);
    for (int n = 0; n < 8; ++n) {
        SCOPED_TRACE(n);
        const Vec3 low{dice.between(0.5, 1), dice.between(-1, -0.5), 0};
        const Vec3 high =
            low + Vec3{dice.between(0.5, 1), dice.between(1, 2), dice.between(0.5, 1)};
        write_footprints({{low, high}});
        const Vec3 spin{dice.between(-2, 2), dice.between(-2, 2), dice.between(-2, 2)};
        const Vec3 place{0, dice.between(-0.2, 0.2), dice.between(0.2, 0.4)};
        const Vec3 speed{dice.between(3, 5), dice.between(-1, 1), dice.between(0, 1)};
        const std::string body = fmt::format(
            "shape = \"box\"\nsize = [0.3, 0.2, 0.1]\ndensity = 600\nposition = {}\nvelocity = "
            "{}\nangular_velocity = {}\n",
            numbers_of(place), numbers_of(speed), numbers_of(spin));
        const std::string ground = "shape = \"plane\"\n";
        Rigid prism = scene(
            ground + fmt::format("[[buildings]]\nfile = \"b.geojson\"\nheight = {}\n", high.z()),
            body, 0.4, 0.3);
        Rigid box =
            scene(ground + fmt::format("[[wall]]\nshape = \"box\"\nmin = {}\nmax = {}\n",
                                       numbers_of(low - Vec3(0, 0, 0.03)), numbers_of(high)),
                  body, 0.4, 0.3);
        const auto blows = [](const std::vector<Contact>& log) {
            Vec3 sum(0, 0, 0);
            for (const Contact& c : log) {
                if (c.b == -2) {
                    sum += c.normal_impulse * c.normal + c.tangential_impulse;
                }
            }
            return sum;
        };
        const Vec3 a = blows(run(prism, 400, 1e-3));
        const Vec3 b = blows(run(box, 400, 1e-3));
        EXPECT_GT(b.norm(), 0);
        EXPECT_LE((a - b).norm(), 1e-6 * b.norm());
    }
}

// A column of water 0.4 m high in a tank 1.2 m long, with more in its way.
std::string dam_break(double spacing, const std::string& more)
{
    return fmt::format(
        "[time]\nend = 1\n[particles]\nspacing = {}\n[fluid]\n[[fluid.block]]\nshape "
        "= \"box\"\nmin = [0, 0, 0]\nmax = [0.4, 0.4, 0.4]\n[[wall]]\nshape = "
        "\"basin\"\nmin = [0, 0, 0]\nmax = [1.2, 0.4, 1]\nopen = [\"+z\"]\n{}",
        spacing, more);
}

// Water that runs against the building and against the box: the same push, until round-off grows,
// where both have the same particles. Below the floor the building is a lattice that its surface
// cuts, while of the box and the floor the nearer one has each place: in a third of the draws a few
// particles two spacings deep differ, and the impulse by at most 0.15 % (18 draws).
// The sides are multiples of the spacing: else the rows of a box are evenly stretched or pressed,
// those of a mesh begin half a spacing below the surface, and the forces differ by up to 0.8 %.
TEST_F(TerrainContact, WaterPushesThePrismAsTheBox)
{
    Dice dice(74);
    for (int draw = 0; draw < 6; ++draw) {
        const double spacing = draw % 2 == 0 ? 0.05 : 0.04;
        SCOPED_TRACE(fmt::format("draw {}, spacing {}", draw, spacing));
        const Vec3 low{dice.between(0.65, 0.75), dice.between(0.05, 0.1), 0};
        const Vec3 size = spacing * Vec3{5.0 + dice.below(3), 4.0 + dice.below(2), 10};
        const Vec3 high = low + size;
        write_footprints({{low, high}});
        const auto text = [&](const std::string& wall) {
            return dam_break(spacing, wall + "[[gauge]]\nname = \"push\"\ntype = \"force\"\non = "
                                             "\"b\"\n");
        };
        Simulation prism = simulate(text("[[buildings]]\nfile = \"b.geojson\"\nheight = " +
                                         fmt::format("{}", high.z()) + "\nname = \"id\"\n"));
        Simulation box = simulate(
            text(fmt::format("[[wall]]\nname = \"b\"\nshape = \"box\"\nmin = {}\nmax = {}\n",
                             numbers_of(low - Vec3(0, 0, 3 * spacing)), numbers_of(high))));
        const Index different = prism.plan.counts.wall - box.plan.counts.wall;
        EXPECT_LE(std::abs(different), 20); // of several thousand
        Vec3 pushed(0, 0, 0), expected(0, 0, 0);
        while (box.clock.time < 0.3) {
            step_on(prism);
            step_on(box);
            pushed = prism.gauges.forces[0].fluid_impulse;
            expected = box.gauges.forces[0].fluid_impulse;
            if (different == 0 && box.clock.time < 0.2) {
                EXPECT_LE((pushed - expected).norm(), 1e-6 * expected.norm()) << box.clock.time;
            }
        }
        EXPECT_LE((pushed - expected).norm(), 5e-3 * expected.norm());
        EXPECT_GT(expected.x(), 3); // [N s]
    }
}

// Two buildings that overlap, and the one of their outline: the same particles, the same push.
// Where they overlap each has rows of particles of its own, of which those inside the other are
// left out.
TEST_F(TerrainContact, BuildingsThatOverlapArePushedAsOne)
{
    Dice dice(75);
    for (const double spacing : {0.05, 0.04}) {
        const Vec3 low{dice.between(0.65, 0.75), dice.between(0.05, 0.1), 0};
        const Vec3 high = low + spacing * Vec3(5, 5 + dice.below(2), 10);
        const auto along = [&](double y) { return low.y() + y * (high.y() - low.y()); };
        const Vec3 first(high.x(), along(dice.between(0.5, 0.7)), high.z());
        const Vec3 second(low.x(), along(dice.between(0.3, 0.5)), low.z());
        const auto text = [&](const std::string& gauges) {
            return dam_break(spacing,
                             fmt::format("[[buildings]]\nfile = \"b.geojson\"\nheight = {}\nname "
                                         "= \"id\"\n{}",
                                         high.z(), gauges));
        };
        const auto gauge = [](char name) {
            return fmt::format("[[gauge]]\nname = \"on_{0}\"\ntype = \"force\"\non = \"{0}\"\n",
                               name);
        };
        write_footprints({{low, high}});
        Simulation one = simulate(text(gauge('b')));
        write_footprints({{low, first}, {second, high}});
        Simulation two = simulate(text(gauge('b') + gauge('c')));
        while (one.clock.time < 0.4) {
            step_on(one);
            step_on(two);
        }
        const Vec3 whole = one.gauges.forces[0].fluid_impulse;
        const Vec3 parts = two.gauges.forces[0].fluid_impulse + two.gauges.forces[1].fluid_impulse;
        EXPECT_GT(whole.x(), 3); // [N s]
        EXPECT_NEAR(parts.x(), whole.x(), 0.05 * whole.x()) << "paths of particles part at once";
        EXPECT_GT(two.gauges.forces[0].fluid_impulse.x(), 0.2 * whole.x());
        EXPECT_GT(two.gauges.forces[1].fluid_impulse.x(), 0.2 * whole.x());
    }
}

} // namespace
} // namespace hyoryu::test_terrain_contact
