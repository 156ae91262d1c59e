// SPDX-License-Identifier: MIT
// Bodies on the triangles of a terrain: a plane of them, in any map, is the plane.
#include "dice.hpp"
#include "runs.hpp"

#include "hyoryu/scene/rigid_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include <unistd.h>

namespace hyoryu {
namespace {

namespace fs = std::filesystem;
using Complex = std::complex<double>;

constexpr double g = 9.81; // [m/s2]

// A grid file about an origin in a map and the [[wall]] that takes it.
class TerrainContact : public testing::Test {
protected:
    TerrainContact()
    {
        const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        folder_ = fs::temp_directory_path() / (name + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    ~TerrainContact() override { fs::remove_all(folder_); }

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
        std::ofstream(folder_ / "ground.asc") << text;
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

    fs::path folder_;
};

std::vector<Contact> run(Rigid& rigid, int steps, const std::function<void(double)>& each = {})
{
    constexpr double dt = 1e-3; // [s]
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
        const Complex rise = std::polar(n % 3 == 0 ? 0 : dice.between(0, 0.25),
                                        dice.between(0, 2 * std::numbers::pi));
        write_grid(map, [&](Complex at) { return (std::conj(rise) * at).real(); });
        const double half = 35.5 * map.cell;
        const Vec3 normal = Vec3(-rise.real(), -rise.imag(), 1).normalized();
        const double friction = dice.between(0.3, 0.5); // more than the slope: it stops
        const std::string cube = sliding_cube(normal, dice.between(0, 2 * std::numbers::pi));
        Rigid triangles = scene(terrain(map, {-half, -half, half, half}), cube, 0.3, friction);
        Rigid plane = scene(
            fmt::format("shape = \"plane\"\npoint = [0, 0, 0]\nnormal = {}\n", numbers_of(normal)),
            cube, 0.3, friction);
        EXPECT_GE(std::get<MeshSurface>(triangles.boundaries[0].surface).triangles.size(), 10000U);
        std::vector<Body> path;
        run(plane, 400, [&](double) { path.push_back(plane.bodies[0]); });
        auto expected = path.begin();
        run(triangles, 400, [&](double t) {
            const Body& body = triangles.bodies[0];
            EXPECT_LE(distance_of(body, *expected++), 1e-9) << t;
            if (n % 3 == 0 && t < 1 / (friction * g)) {
                EXPECT_NEAR(body.position.head<2>().norm(), t - friction * g * t * t / 2, 1e-9);
            }
        });
        EXPECT_LE(triangles.bodies[0].velocity.norm(), 1e-6);
    }
}

} // namespace
} // namespace hyoryu
