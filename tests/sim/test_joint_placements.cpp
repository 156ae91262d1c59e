// SPDX-License-Identifier: MIT
// Crates at random on ground of every kind: the joint below them bears the pressure of the water,
// whatever their size, weight, turn, place against the lattice and spacing. The witness shares
// nothing with the program: volumes by counting points, the pressure of water at rest, Archimedes.
// A scene follows from its seed alone; HYORYU_PLACEMENTS=200 is the nightly size, HYORYU_SEED the
// first seed, HYORYU_SHOW=1 prints the cases.
#include "../dice.hpp"
#include "hyoryu/core/parallel.hpp"
#include "runs.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <numbers>
#include <map>

namespace hyoryu {
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
    Vec3 size{0.4, 0.4, 0.4};   // of the crate [m]
    Vec3 foot{0, 0, 0};         // middle of its lower face, at y = 0 in two dimensions [m]
    double slope = 0, turn = 0; // of the ground, of the crate on it [rad]
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
    const std::string end = s.ground == Ground::body || s.ground == Ground::box ? "" : "";
    return fmt::format(
        "dimensions = {}\n[time]\nend = 10.0\n[particles]\nspacing = {}\n[fluid]\n"
        "[[fluid.block]]\nshape = \"box\"\nmin = {}\nmax = {}\n"
        "[[body]]\nname = \"crate\"\nshape = \"box\"\nsize = {}\ndensity = {}\nposition = {}\n{}{}\n"
        "{}[[wall]]\nname = \"sides\"\nshape = \"basin\"\nmin = {}\nmax = {}\n"
        "open = [\"-z\", \"+z\"]\n{}",
        s.dimensions, s.spacing, vector_of({s.low.x(), s.low.y(), s.bottom}),
        vector_of({s.high.x(), s.high.y(), s.level}), vector_of(s.size), s.density,
        vector_of(s.centre()), rotation_of(s.pose()), s.keys, s.rest, vector_of(s.low),
        vector_of(s.high), ground_of(s) + end);
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
    const double wanted = static_cast<double>(fluid.particles.fluid().size()) *
                          std::pow(s.spacing, s.dimensions);
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
                    (s.footing.z() > 0 &&
                     in_block(x, s.foot - Vec3(0, 0, s.footing.z() / 2), s.footing, s.pose(),
                              s.dimensions));
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

struct Mean {
    Vec3 load{0, 0, 0}, joint{0, 0, 0}, floor{0, 0, 0};
};

Mean mean_loads(Simulation& sim, double from, double to)
{
    Mean mean;
    double total = 0;
    while (sim.clock.time < to) {
        step_on(sim);
        if (sim.clock.time > from) {
            total += sim.clock.dt;
            mean.load += sim.clock.dt * sim.loads.bodies[0].force;
            for (const Wrench& w : sim.loads.bodies) mean.floor += sim.clock.dt * w.force;
            for (const Vec3& w : sim.loads.walls) mean.floor += sim.clock.dt * w;
            for (const JointLoad& load : sim.seepage.loads[0]) {
                mean.joint += sim.clock.dt * load.force;
            }
        }
    }
    mean.load /= total;
    mean.joint /= total;
    mean.floor /= total;
    return mean;
}

Standing standing(std::uint64_t seed, bool sloped)
{
    Dice dice(seed);
    Standing s;
    s.ground = static_cast<Ground>(dice.below(4));
    s.dimensions = sloped && dice.chance(0.5) ? 2 : 3;
    s.spacing = 0.05;
    if (s.dimensions == 2 && s.ground == Ground::mesh) {
        s.ground = Ground::box;
    }
    s.size = {dice.between(0.3, 0.5), dice.between(0.3, 0.5), dice.between(0.25, 0.45)};
    s.slope = sloped ? dice.between(5, 20) * std::numbers::pi / 180 : 0;
    s.turn = s.dimensions == 3 ? dice.between(0, std::numbers::pi) : 0;
    const double across = s.dimensions == 3 ? std::hypot(s.size.x(), s.size.y()) : s.size.x();
    const double beside = dice.between(0.2, 0.3);
    s.high = {across + 2 * beside, across + 2 * beside, 1.5};
    s.low = {0, 0, -0.6};
    if (s.dimensions == 2) {
        s.high.y() = 0;
    }
    s.foot = {s.high.x() / 2 + dice.between(-0.03, 0.03),
              s.dimensions == 3 ? s.high.y() / 2 + dice.between(-0.03, 0.03) : 0,
              dice.between(-0.03, 0.03)};
    if (!sloped && (s.ground == Ground::box || s.ground == Ground::body) && dice.chance(0.5)) {
        s.footing = {s.size.x() * dice.between(0.6, 1.3), s.size.y() * dice.between(0.6, 1.3),
                     dice.between(0.15, 0.3)};
    }
    s.bottom = std::min(s.ground_at(s.high.x()), s.ground_at(s.low.x()));
    const double half = s.size.x() / 2 * std::sin(s.slope);
    s.level = s.foot.z() + (sloped ? dice.between(-half, half + s.size.z())
                                   : dice.between(0.1, s.size.z() - 0.05));
    return s;
}

TEST(JointPlacements, Explore)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_PLACEMENTS", 10);
    const bool sloped = number_from("SLOPED", 0) != 0;
    const double from = number_from("FROM", 0) / 1000.0;
    const double to = number_from("TO", 50) / 1000.0;
    set_threads(1);
    for (int seed = first; seed < first + count; ++seed) {
        for (const double spacing : {0.05, 0.025}) {
            Standing s = standing(static_cast<std::uint64_t>(seed), sloped);
            s.spacing = spacing;
            s.keys = "fixed = true";
            if (std::getenv("TURN") != nullptr) {
                s.turn = number_from("TURN", 0) * std::numbers::pi / 180;
            }
            if (std::getenv("HALF") != nullptr) {
                const int d = number_from("HALF", 2);
                if (d == 2) { s.dimensions = 2; s.high.y() = 0; s.foot.y() = 0; s.turn = 0; s.high.x() += 0.3; s.size.x() *= 3; s.high.x() += 1; s.foot.x() += 0.6; }
                s.bottom = std::min(s.ground_at(s.high.x()), s.ground_at(s.low.x())); if (d == 2 && s.ground == Ground::mesh) s.ground = Ground::plane;
                s.level = s.foot.z() + s.size.x() / 2 * std::sin(s.slope) * (seed % 7 - 3) / 4.0;
            }
            const int snap = number_from("SNAP", 0);
            const auto round = [](double x) { return std::round(x / 0.1) * 0.1; };
            if (snap & 1) s.level = s.foot.z() + round(s.level - s.foot.z());
            if (snap & 2) s.size = {round(s.size.x()), round(s.size.y()), s.size.z()};
            if (snap & 4) { s.high.x() = round(s.high.x()); s.high.y() = round(s.high.y()); }
            if (snap & 8) { s.foot.x() = round(s.foot.x()); s.foot.y() = round(s.foot.y());}
            if (snap & 16) { s.level -= s.foot.z(); s.foot.z() = 0; s.bottom = 0; }
            if (std::getenv("ONE") != nullptr && spacing < 0.05) {
                break;
            }
            if (std::getenv("HYORYU_SHOW") != nullptr) {
                fmt::print("{}", text_of(s));
            }
            Simulation sim = stand(s);
            const double level = level_of(s, *sim.fluid);
            const Pressed exact = pressed(s, level);
            const Mean mean = mean_loads(sim, from, to);
            const Vec3 n = s.normal();
            if (std::getenv("PROFILE") != nullptr) {
                for (const JointLoad& l : sim.seepage.loads[0]) fmt::print("x {:.3f} z {:.3f} p {:.1f} exact {:.1f} gap {:.1e} force {:.2f}\n", l.point.x(), l.point.z(), l.pressure, 9810 * std::max(0.0, level - l.point.z()), l.gap, l.force.norm());
            }
            if (std::getenv("PROBE") != nullptr) {
                const Fluid& F = *sim.fluid;
                const Rows rows = F.particles.body();
                const auto x = F.particles[field::position];
                const auto p = F.particles[field::pressure];
                const auto w = F.particles[field::shepard_sum];
                const auto f = F.particles[field::force];
                std::map<std::pair<int,int>, std::array<double, 5>> sides;
                for (Index i = rows.begin; i < rows.end; ++i) {
                    const Vec3 own = s.pose().conjugate() * (x[size_t(i)] - s.centre());
                    for (int axis : {0, 1}) for (int side : {-1, 1}) {
                        if (side * own[axis] < s.size[axis] / 2 - 0.8 * spacing || std::abs(own[1-axis]) > s.size[1-axis]/2 - 1.5 * spacing) continue;
                        const int layer = int((own.z() + s.size.z() / 2) / spacing);
                        auto& a = sides[{layer, 2 * axis + (side + 1) / 2}];
                        a[0] += 1; a[1] += p[size_t(i)] / (9810 * (level - x[size_t(i)].z())); a[2] += w[size_t(i)] * spacing * spacing * spacing;
                        a[3] += -side * f[size_t(i)][axis]; a[4] += 9810 * (level - x[size_t(i)].z());
                    }
                }
                for (auto& [k, a] : sides) if (k.first < 5) fmt::print("layer {} side {}: p/exact {:.3f} sumW {:.4f} force {:.3f} of {:.3f} \n", k.first, k.second, a[1] / a[0], a[2] / a[0], a[3]/a[0], a[4]/a[0]);
            }
            const double unit = water_density * g * spacing * s.area(); // of one spacing of level
            const double wet = (level - s.foot.z()) ;
            fmt::print("seed {} {} dim {} dp {} size {:.3f} {:.3f} {:.3f} slope {:.1f} turn {:.0f} "
                       "footing {:.2f} {:.2f} {:.2f} level-foot {:.3f} (asked {:.3f}): joint/exact {:.4f} "
                       "err/dp {:+.3f} all: exact {:.1f} {:.1f} {:.1f} got {:.1f} {:.1f} {:.1f} z err/dp {:+.3f} weight {:.4f}\n",
                       seed, "pbmo"[int(s.ground)], s.dimensions, spacing, s.size.x(), s.size.y(), s.size.z(),
                       s.slope * 180 / 3.14159, s.turn * 180 / 3.14159, s.footing.x() / s.size.x(),
                       s.footing.y() / s.size.y(), s.footing.z(), wet, s.level - s.foot.z(),
                       mean.joint.dot(n) / exact.below.dot(n),
                       (mean.joint - exact.below).dot(n) / unit, exact.all.x(), exact.all.y(),
                       exact.all.z(), mean.load.x(), mean.load.y(), mean.load.z(),
                       (mean.load - exact.all).z() / unit, -mean.floor.z() / g / sim.fluid->parameters.mass / double(sim.fluid->particles.fluid().size()));
            std::fflush(stdout);
        }
    }
    set_threads(0);
}

} // namespace
} // namespace hyoryu
