// SPDX-License-Identifier: MIT
// Crates at random on ground of every kind: the joint below them bears the pressure of the water,
// whatever their size, weight, turn, place against the lattice and spacing. The witness shares
// nothing with the program: volumes by counting points, the pressure of water at rest, Archimedes.
// A scene follows from its seed alone; HYORYU_PLACEMENTS=40 is the nightly size, with a fine
// spacing and settled water, HYORYU_SEED the first seed, HYORYU_SHOW=1 prints the cases.
#include "placements.hpp"
#include "runs.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>

namespace hyoryu::test_joint_placements {
namespace {

enum class Ground { plane, box, mesh, body };
constexpr double water_density = 1000;
constexpr double g = 9.81;

// A crate on ground that falls along +x through a place below the middle of the crate, in a tank
// with upright sides.
struct Standing {
    Ground ground = Ground::plane;
    int dimensions = 3;
    double spacing = 0.05;
    Vec3 size{0.4, 0.4, 0.4};          // of the crate [m]
    Vec3 foot{0, 0, 0};                // middle of its lower face, at y = 0 in two dimensions [m]
    double slope = 0, turn = 0;        // of the ground, of the crate on it [rad]
    Vec3 low{0, 0, -1}, high{1, 1, 2}; // of the tank [m]
    Vec3 footing{0, 0, 0}; // size of a block that the crate stands on, over level ground; else none
    double bottom = 0;     // of the water in the case [m]
    double level = 0.5;    // of the water asked for [m]
    double density = 500;  // [kg/m3]
    std::string keys;      // of the crate
    std::string rest;

    Quat tilt() const { return Quat(Eigen::AngleAxisd(slope, Vec3::UnitY())); }
    Quat pose() const { return tilt() * Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ())); }
    Vec3 normal() const { return tilt() * Vec3::UnitZ(); }
    Vec3 centre() const { return foot + size.z() / 2 * normal(); }
    double area() const { return size.x() * (dimensions == 3 ? size.y() : 1); }
    double ground_at(double x) const
    {
        return foot.z() - footing.z() - (x - foot.x()) * std::tan(slope);
    }
};

std::string rotation_of(const Quat& q)
{
    const Eigen::AngleAxisd turn(q);
    return fmt::format("rotation_deg = {{ axis = [{}, {}, {}], angle = {} }}\n", turn.axis().x(),
                       turn.axis().y(), turn.axis().z(), turn.angle() * 180 / std::numbers::pi);
}

std::string vector_of(const Vec3& v)
{
    return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

// A block whose upper face has its middle at a place.
std::string block_below(const char* table, const Vec3& top, const Vec3& size, const Quat& q)
{
    const Vec3 centre = top - q * Vec3(0, 0, size.z() / 2);
    const bool body = std::string(table) == "body";
    return fmt::format("[[{}]]\nname = \"ground\"\nshape = \"box\"\nsize = {}\nposition = {}\n{}{}",
                       table, vector_of(size), vector_of(centre), rotation_of(q),
                       body ? "density = 2000\nfixed = true\n" : "");
}

std::string ground_of(const Standing& s)
{
    const Vec3 below = s.foot - Vec3(0, 0, s.footing.z());
    const char* table = s.ground == Ground::body ? "body" : "wall";
    std::string text;
    if (s.ground == Ground::plane || s.footing.z() > 0) {
        text = fmt::format("[[wall]]\nname = \"plane\"\nshape = \"plane\"\npoint = {}\n"
                           "normal = {}\n",
                           vector_of(below), vector_of(s.normal()));
    }
    if (s.footing.z() > 0) {
        return text + block_below(table, s.foot, s.footing, s.pose());
    }
    if (s.ground != Ground::plane) {
        const Vec3 wide = 2.5 * (s.high - s.low);
        text += block_below(table, s.foot, Vec3(wide.x(), wide.y(), 0.5), s.tilt());
    }
    return text;
}

std::string text_of(const Standing& s)
{
    return fmt::format("dimensions = {}\n[time]\nend = 10.0\n[particles]\nspacing = {}\n[fluid]\n"
                       "[[fluid.block]]\nshape = \"box\"\nmin = {}\nmax = {}\n"
                       "[[body]]\nname = \"crate\"\nshape = \"box\"\nsize = {}\ndensity = "
                       "{}\nposition = {}\n{}{}\n"
                       "{}[[wall]]\nname = \"sides\"\nshape = \"basin\"\nmin = {}\nmax = {}\n"
                       "open = [\"-z\", \"+z\"]\n{}",
                       s.dimensions, s.spacing, vector_of({s.low.x(), s.low.y(), s.bottom}),
                       vector_of({s.high.x(), s.high.y(), s.level}), vector_of(s.size), s.density,
                       vector_of(s.centre()), rotation_of(s.pose()), s.keys, s.rest,
                       vector_of(s.low), vector_of(s.high), ground_of(s));
}

// Closed triangles of a slope that reaches beyond the tank, in place of the block of the ground.
MeshShape prism_below(const Standing& s)
{
    MeshShape prism;
    for (const double y : {s.low.y() - 0.5, s.high.y() + 0.5}) {
        for (const double x : {s.low.x() - 0.5, s.high.x() + 0.5}) {
            prism.corners.emplace_back(x, y, s.low.z() - 0.5);
            prism.corners.emplace_back(x, y, s.ground_at(x));
        }
    }
    prism.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 7, 6}, {4, 5, 7}, {0, 6, 2}, {0, 4, 6},
                       {1, 7, 5}, {1, 3, 7}, {0, 5, 4}, {0, 1, 5}, {2, 7, 3}, {2, 6, 7}};
    return prism;
}

Simulation stand(const Standing& s)
{
    Scene scene = parse_case(text_of(s), "test.toml");
    if (s.ground == Ground::mesh) {
        for (Wall& wall : scene.walls) {
            if (wall.name == "ground") {
                std::get<SolidWall>(wall.geometry) = {prism_below(s), Vec3(0, 0, 0),
                                                      Quat::Identity()};
            }
        }
    }
    const Filling filling = fill(scene);
    return make_simulation(scene, make_plan(scene, filling), filling);
}

bool in_block(const Vec3& x, const Vec3& centre, const Vec3& size, const Quat& q, int dimensions)
{
    const Vec3 own = q.conjugate() * (x - centre);
    return std::abs(own.x()) < size.x() / 2 && std::abs(own.z()) < size.z() / 2 &&
           (dimensions == 2 || std::abs(own.y()) < size.y() / 2);
}

// The level at which as much water as there is stands in the tank [m].
double level_of(const Standing& s, const Fluid& fluid)
{
    const int nx = 200;
    const int ny = s.dimensions == 3 ? 100 : 1;
    const int nz = 400;
    const double wanted =
        static_cast<double>(fluid.particles.fluid.size()) * fluid.parameters.mass / water_density;
    const double from = std::min(s.ground_at(s.high.x()), s.ground_at(s.low.x()));
    const double to = s.level + 0.2;
    const Vec3 cell((s.high.x() - s.low.x()) / nx, (s.high.y() - s.low.y()) / ny, (to - from) / nz);
    const double volume = cell.x() * cell.z() * (s.dimensions == 3 ? cell.y() : 1);
    double total = 0;
    for (int k = 0; k < nz; ++k) {
        int count = 0;
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < nx; ++i) {
                const Vec3 x(s.low.x() + (i + 0.5) * cell.x(),
                             s.dimensions == 3 ? s.low.y() + (j + 0.5) * cell.y() : 0,
                             from + (k + 0.5) * cell.z());
                const bool solid =
                    x.z() < s.ground_at(x.x()) ||
                    in_block(x, s.centre(), s.size, s.pose(), s.dimensions) ||
                    (s.footing.z() > 0 && in_block(x, s.foot - Vec3(0, 0, s.footing.z() / 2),
                                                   s.footing, s.pose(), s.dimensions));
                count += solid ? 0 : 1;
            }
        }
        const double layer = count * volume;
        if (total + layer >= wanted) {
            return from + (k + (wanted - total) / layer) * cell.z();
        }
        total += layer;
    }
    return to;
}

// Force of water at rest on the crate [N]: on the face below and on all faces.
struct Pressed {
    Vec3 below{0, 0, 0}, all{0, 0, 0};
};

Pressed pressed(const Standing& s, double level)
{
    const int n = 200;
    Pressed result;
    const Vec3 half = s.size / 2;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == 1 && s.dimensions == 2) {
            continue;
        }
        const int a = (axis + 1) % 3;
        const int b = (axis + 2) % 3;
        const double area = (s.dimensions == 2 && a == 1 ? 1 : s.size[a]) *
                            (s.dimensions == 2 && b == 1 ? 1 : s.size[b]) / n / n;
        for (const double side : {-1.0, 1.0}) {
            Vec3 total = Vec3::Zero();
            for (int i = 0; i < n * n; ++i) {
                Vec3 own = Vec3::Zero();
                own[axis] = side * half[axis];
                own[a] = half[a] * (2 * (i % n + 0.5) / n - 1);
                own[b] = half[b] * (2 * (i / n + 0.5) / n - 1);
                if (s.dimensions == 2) {
                    own.y() = 0;
                }
                const Vec3 x = s.centre() + s.pose() * own;
                const double p = water_density * g * std::max(level - x.z(), 0.0);
                total -= p * area * side * (s.pose() * Vec3::Unit(axis));
            }
            result.all += total;
            if (axis == 2 && side < 0) {
                result.below = total;
            }
        }
    }
    return result;
}

// Mean of the force of the joint on the crate between two times [N].
Vec3 joint_force(Simulation& sim, double from, double to)
{
    Vec3 mean = Vec3::Zero();
    double total = 0;
    while (sim.clock.time < to) {
        step_on(sim);
        total += sim.clock.time > from ? sim.clock.dt : 0;
        for (std::size_t b = 0; sim.clock.time > from && b < sim.seepage.loads.size(); ++b) {
            for (const JointLoad& load :
                 sim.seepage.loads[b]) { // the smaller body brings the cells
                const double side = b == 0 ? 1 : (load.other == 0 ? -1 : 0);
                mean += side * sim.clock.dt * load.force;
            }
        }
    }
    return mean / total;
}

// A crate on level ground in a tank with 4 to 6 spacings of water beside it.
Standing on_level_ground(std::uint64_t seed, double spacing)
{
    Dice dice(seed);
    Standing s;
    s.ground = static_cast<Ground>(seed % 4);
    s.spacing = spacing;
    s.size = {dice.between(0.3, 0.5), dice.between(0.3, 0.5), dice.between(0.25, 0.45)};
    s.turn = dice.between(0, std::numbers::pi);
    const double across = std::hypot(s.size.x(), s.size.y()) + 2 * dice.between(0.2, 0.3);
    s.high = {across, across, 1.5};
    s.low = {0, 0, -0.6};
    s.foot = {across / 2 + dice.between(-0.03, 0.03), across / 2 + dice.between(-0.03, 0.03),
              dice.between(-0.03, 0.03)};
    if (s.ground == Ground::body) { // it reaches to no wall
        s.footing = {s.size.x() + dice.between(0.1, 0.2), s.size.y() + dice.between(0.1, 0.2),
                     dice.between(0.15, 0.3)};
    }
    s.bottom = s.foot.z() - s.footing.z();
    s.level = s.foot.z() + dice.between(0.5, 0.9) * s.size.z();
    return s;
}

double level_over_foot(const Standing& s)
{
    const Simulation sim = stand(s);
    return level_of(s, *sim.fluid) - s.foot.z();
}

// How far the keel has risen after a while, if the level is so many spacings above the draft [dp].
double rise(Standing s, double level, double over)
{
    s.density = water_density * (level - over * s.spacing) / s.size.z();
    Simulation sim = stand(s);
    while (sim.clock.time < 0.3) {
        step_on(sim);
    }
    EXPECT_LE(sim.conservation.worst_closure, 6e-8) << "half a unit of the last place of a float";
    return (sim.rigid.bodies[0].position - s.centre()).z() / s.spacing;
}

std::vector<double> spacings(int usual)
{
    return number_from("HYORYU_PLACEMENTS", usual) > usual ? std::vector{0.08, 0.05, 0.025}
                                                           : std::vector{0.08, 0.06};
}

void show(const Standing& s)
{
    if (std::getenv("HYORYU_SHOW") != nullptr) {
        fmt::print("{}", text_of(s));
    }
}

// Half a spacing above the draft it floats up, half a spacing below it stays: water that does not
// fit the lattice beside it starts in a packing that is at rest. As filled it pressed up to an
// eighth harder than by its depth, which lifted a crate of twelve spacings by 0.3.
TEST(JointPlacements, ACrateLiftsAtItsDraftWithinHalfASpacing)
{
    for_seeds(4, [](std::uint64_t seed) {
        for (const double spacing : spacings(4)) {
            const Standing s = on_level_ground(seed, spacing);
            show(s);
            const double level = level_over_foot(s);
            EXPECT_GT(rise(s, level, 0.5), 0.25) << "spacing " << spacing;
            EXPECT_LT(rise(s, level, -0.5), 0.1) << "spacing " << spacing;
        }
    });
}

// Tank, crate and level of whole spacings at any height, so that nothing has to settle.
TEST(JointPlacements, AHeldCrateFeelsTheDepthOfTheWater)
{
    for_seeds(4, [](std::uint64_t seed) {
        for (const double spacing : spacings(4)) {
            Standing s = on_level_ground(seed, spacing);
            const auto whole = [&](double x) { return std::round(x / 2 / spacing) * 2 * spacing; };
            s.size = {whole(s.size.x()), whole(s.size.y()), s.size.z()};
            s.high = {whole(s.high.x()), whole(s.high.y()), s.high.z()};
            s.foot = {s.high.x() / 2, s.high.y() / 2, s.foot.z()};
            s.level = s.foot.z() + whole(s.level - s.foot.z());
            s.footing = {whole(s.footing.x()), whole(s.footing.y()), whole(s.footing.z())};
            s.bottom = s.foot.z() - s.footing.z();
            s.turn = 0;
            s.keys = "fixed = true";
            show(s);
            Simulation sim = stand(s);
            const double level = level_of(s, *sim.fluid);
            const double exact = pressed(s, level).below.z();
            const double layer = water_density * g * spacing * s.area();
            EXPECT_NEAR((joint_force(sim, 0.02, 0.06).z() - exact) / layer, 0, 0.25)
                << "spacing " << spacing << " level " << level - s.foot.z();
        }
    });
}

// Turned at random, once the water has settled.
TEST(JointPlacements, AHeldCrateFeelsTheDepthOfWaterThatHasSettled)
{
    if (number_from("HYORYU_PLACEMENTS", 1) == 1) {
        GTEST_SKIP() << "a second of water each: HYORYU_PLACEMENTS=40";
    }
    for_seeds(1, [](std::uint64_t seed) {
        Standing s = on_level_ground(seed, 0.05);
        s.keys = "fixed = true";
        show(s);
        Simulation sim = stand(s);
        const double exact = pressed(s, level_of(s, *sim.fluid)).below.z();
        const double layer = water_density * g * s.spacing * s.area();
        EXPECT_NEAR((joint_force(sim, 1.0, 1.2).z() - exact) / layer, 0, 0.3);
    });
}

// A crate that is held on a slope, the water line across its lower face; four times as long in two
// dimensions.
Standing on_slope(std::uint64_t seed, int dimensions, double spacing)
{
    Dice dice(seed);
    Standing s;
    s.dimensions = dimensions;
    s.ground = static_cast<Ground>(seed % (dimensions == 3 ? 3 : 2));
    s.spacing = spacing;
    const double length = dimensions == 3 ? 0.8 : 1.5;
    s.size = {dice.between(0.7 * length, length), dice.between(0.3, 0.5), dice.between(0.25, 0.45)};
    s.slope = dice.between(8, 20) * std::numbers::pi / 180;
    s.turn = dimensions == 3 ? dice.between(0, std::numbers::pi) : 0;
    const double across = (dimensions == 3 ? std::hypot(s.size.x(), s.size.y()) : s.size.x()) +
                          2 * dice.between(0.25, 0.35);
    s.high = {across, dimensions == 3 ? across : 0, 2};
    s.low = {0, 0, -0.8};
    s.foot = {across / 2, dimensions == 3 ? across / 2 : 0, dice.between(-0.03, 0.03)};
    s.bottom = s.ground_at(s.high.x());
    s.level = s.foot.z() + s.size.x() / 2 * std::sin(s.slope) * dice.between(-0.5, 0.1);
    s.keys = "fixed = true";
    return s;
}

// Below the level that the rim at the foot shows the pressure grows with depth, above it is none:
// air gives no water to what lies below it.
TEST(JointPlacements, AJointOnASlopeIsFullToItsWaterLine)
{
    for_seeds(4, [](std::uint64_t seed) {
        for (const double spacing : spacings(4)) {
            const Standing s = on_slope(seed, 2, spacing);
            show(s);
            Simulation sim = stand(s);
            while (sim.clock.time < 0.05) {
                step_on(sim);
            }
            const auto head = [](const JointLoad& load) {
                return load.pressure / (water_density * g);
            };
            const auto& loads = sim.seepage.loads[0];
            const auto foot = std::ranges::min_element(
                loads, {}, [](const JointLoad& load) { return load.point.z(); });
            ASSERT_NE(foot, loads.end());
            const double level = foot->point.z() + head(*foot);
            EXPECT_LT(level, s.foot.z() + s.size.x() / 2 * std::sin(s.slope)) << "half wet";
            for (const JointLoad& load : loads) {
                EXPECT_NEAR(head(load), std::max(level - load.point.z(), 0.0), 1e-6 * s.size.x());
            }
        }
    });
}

// In space water comes in from the sides, too. Within a fifth of a layer over the whole face.
TEST(JointPlacements, AHalfWetCrateOnASlopeFeelsTheWaterBelowItsLine)
{
    for_seeds(2, [](std::uint64_t seed) {
        for (const double spacing : spacings(4)) {
            const Standing s = on_slope(seed, 3, spacing);
            show(s);
            Simulation sim = stand(s);
            const Vec3 exact = pressed(s, level_of(s, *sim.fluid)).below;
            const double layer = water_density * g * spacing * s.area();
            EXPECT_NEAR((joint_force(sim, 0.02, 0.06) - exact).dot(s.normal()) / layer, 0, 0.2)
                << "spacing " << spacing;
        }
    });
}

} // namespace
} // namespace hyoryu::test_joint_placements
