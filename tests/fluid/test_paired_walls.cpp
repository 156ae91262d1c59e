// SPDX-License-Identifier: MIT
// The paired continuity at solids: the work of their pressure against the change of the
// compression, the loops against sums over all pairs, motions that compress nothing.
#include "dice.hpp"
#include "hyoryu/fluid/fluid.hpp"
#include "hyoryu/fluid/paired_walls.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <vector>

namespace hyoryu::test_paired_walls {
namespace {

struct Cloud {
    int dimensions = 3;
    real spacing = 0.1;
    Precision precision = Precision::double_precision;
    KernelShape kernel = KernelShape::wendland;
    bool paired = true;
};

struct Places {
    std::vector<Vec3> fluid;
    std::vector<Vec3> wall;
    std::vector<Vec3> body;
};

Fluid make_fluid(const Cloud& cloud, const Places& places)
{
    Fluid fluid;
    const real dp = cloud.spacing;
    FluidParameters& f = fluid.parameters;
    f = {.dimensions = cloud.dimensions, .eos = {1000, 30}, .spacing = dp, .h = 1.5 * dp};
    f.mass = 1000 * std::pow(dp, cloud.dimensions);
    f.precision = cloud.precision;
    f.kernel = cloud.kernel;
    f.gravity.setZero();
    fluid.kernel = make_kernel(f.h, dp, cloud.dimensions, cloud.kernel);
    if (cloud.paired) {
        fluid.effects[slot::wall_continuity] = PairedWalls{};
    }
    allocate(fluid, std::ssize(places.fluid), std::ssize(places.wall), std::ssize(places.body));
    fluid.body_particle_mass = {f.mass};
    Particles& p = fluid.particles;
    std::ranges::copy(places.fluid, p.fluid[field::position].begin());
    std::ranges::copy(places.wall, p.wall[field::position].begin());
    std::ranges::copy(places.body, p.body[field::position].begin());
    std::ranges::fill(p.wall.owner(), -1);
    std::ranges::fill(p.body.owner(), 0);
    std::ranges::fill(p.fluid[field::density], 1005);
    return fluid;
}

Vec3 draw(Dice& dice, int dimensions, real most)
{
    const real x = dice.between(-most, most);
    const real y = dice.between(-most, most);
    return Vec3(x, dimensions == 2 ? 0 : y, dice.between(-most, most));
}

// A jittered lattice with walls below and at one side and a body in the far corner.
Places corner(const Cloud& cloud, Dice& dice)
{
    const bool plane = cloud.dimensions == 2;
    const int edge = plane ? 22 : 11;
    Places places;
    for (int k = 0; k < edge * edge * (plane ? 1 : edge); ++k) {
        const Vec3 lattice(k % edge, k / edge / edge, k / edge % edge);
        const Vec3 place =
            cloud.spacing * (lattice + draw(dice, cloud.dimensions, 0.1)) + Vec3(0.3, 0.2, -0.4);
        const bool wall = lattice.x() < 3 || lattice.z() < 3;
        const bool body = lattice.x() > edge - 4 && lattice.z() > edge - 4;
        (wall ? places.wall : body ? places.body : places.fluid).push_back(place);
    }
    return places;
}

void give_velocities(Fluid& fluid, Dice& dice)
{
    for (Store* store : {&fluid.particles.fluid, &fluid.particles.wall, &fluid.particles.body}) {
        for (Vec3& v : (*store)[field::velocity]) {
            v = draw(dice, fluid.parameters.dimensions, 1);
        }
    }
}

// Forces without the backstop, which has no impulse in an endless step, and rates.
void evaluate(Fluid& fluid)
{
    update_neighbours(fluid);
    update_pressure(fluid);
    update_forces(fluid, 1e30);
    update_rates(fluid);
}

// f(cloud, dice) for drawn spacings in two and three dimensions, with both kernels.
void for_clouds(const auto& f)
{
    Dice dice(static_cast<std::uint64_t>(number_from("HYORYU_SEED", 21)));
    for (const KernelShape kernel : {KernelShape::wendland, KernelShape::isotropic}) {
        for (const int dimensions : {2, 3, 2, 3}) {
            Cloud cloud{.dimensions = dimensions, .spacing = dice.between(0.005, 2)};
            cloud.kernel = kernel;
            SCOPED_TRACE(testing::Message() << dimensions << "-D, spacing " << cloud.spacing);
            f(cloud, dice);
        }
    }
}

// The part of the mean motion along the surface; `full` is (sum W)(sum W N^2).
real left_out(const Vec3& motion, const Vec3& G, const Vec3& normals, real full)
{
    const Vec3 n = normals.normalized();
    const Vec3 along = G - n * n.dot(G);
    return full > 0 ? std::min(1.0, 4 * normals.dot(normals) / full) * motion.dot(along) : 0;
}

// All under pressure: the power of all pressures and the rate of the compression energy add up to
// the power of the part that is left out, of the mean motion along the surfaces.
TEST(PairedWalls, WorkOfThePressureIsTheChangeOfTheCompression)
{
    for_clouds([](const Cloud& cloud, Dice& dice) {
        Fluid fluid = make_fluid(cloud, corner(cloud, dice));
        for (real& rho : fluid.particles.fluid[field::density]) {
            rho = 1010 + dice.between(-5, 5);
        }
        give_velocities(fluid, dice);
        evaluate(fluid);
        real sum = 0;
        real scale = 0;
        real paired = 0;
        const auto add = [&](real power) {
            sum += power;
            scale += std::abs(power);
        };
        const Store& p = fluid.particles.fluid;
        for (Index i = 0; i < p.size(); ++i) {
            const real energy = p[field::pressure][i] * p[field::volume][i] / p[field::density][i];
            add(p[field::velocity][i].dot(p[field::force][i]));
            add(energy * p[field::density_rate][i]);
            paired += std::abs(p[field::pressure][i] * p[field::paired_rate][i]);
        }
        for (const Store* s : {&fluid.particles.wall, &fluid.particles.body}) {
            for (Index j = 0; j < s->size(); ++j) {
                add((*s)[field::velocity][j].dot((*s)[field::force][j]));
                const real S = (*s)[field::shepard_sum][j];
                if (S > 0) {
                    const Vec3 G = (*s)[field::gradient_sum][j];
                    const Vec3 motion = (*s)[field::velocity][j] - (*s)[field::velocity_sum][j] / S;
                    const real pV = (*s)[field::volume][j] * (*s)[field::pressure][j];
                    add(pV * left_out(motion, G, (*s)[field::normal_sum][j],
                                      S * (*s)[field::normal_squares][j]));
                }
            }
        }
        EXPECT_GT(paired, 0.02 * scale);         // else the test is of the plain continuity
        EXPECT_LT(std::abs(sum), 1e-12 * scale); // some thousand sums of some hundred terms
    });
}

// One solid particle for the sums over all pairs.
struct Before {
    Vec3 place;
    real volume = 0;
    real compression = 0; // D/S
};

// D/S of the rows of a store of solids, from sums over all fluid.
void add_compressions(std::vector<Before>& found, const Store& s, const Store& p,
                      const std::vector<Vec3>& normals, const Kernel& kernel)
{
    for (Index j = 0; j < s.size(); ++j) {
        const Vec3 x = s[field::position][j];
        const Vec3 u = s[field::velocity][j];
        real D = 0;
        real S = 0;
        Vec3 G = Vec3::Zero();
        Vec3 v = Vec3::Zero();
        Vec3 n = Vec3::Zero();
        real squares = 0;
        for (Index i = 0; i < p.size(); ++i) {
            const Vec3 r = x - p[field::position][i];
            if (r.norm() >= kernel.support) {
                continue;
            }
            const Pair<real> pair = kernel(Vec<real>{r.x(), r.y(), r.z()});
            S += pair.w;
            v += pair.w * p[field::velocity][i];
            n += pair.w * normals[at(i)];
            squares += pair.w * normals[at(i)].squaredNorm();
            const bool pressed = p[field::gap][i] == 0 && p[field::pressure][i] > 0;
            if (pressed && s[field::pressure][j] > 0) {
                const Vec3 part = p[field::volume][i] * pair.f * r;
                G += part;
                D += (u - p[field::velocity][i]).dot(part);
            }
        }
        if (S > 0) {
            D -= left_out(u - v / S, G, n, S * squares);
            found.push_back({x, s[field::volume][j], D / S});
        }
    }
}

TEST(PairedWalls, LoopsEqualSumsOverAllPairs)
{
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
        for_clouds([&](Cloud cloud, Dice& dice) {
            cloud.precision = precision;
            Fluid fluid = make_fluid(cloud, corner(cloud, dice));
            Store& p = fluid.particles.fluid;
            for (Index i = 0; i < p.size(); ++i) {
                p[field::density][i] = 1002 + dice.between(-4, 4);
                p[field::gap][i] = dice.chance(0.2) ? 1e3 : 0;
            }
            give_velocities(fluid, dice);
            update_neighbours(fluid);
            update_pressure(fluid);
            const Store pressed = p; // in the order of the tiles, gaps as in the forces
            update_rates(fluid);
            const Particles& all = fluid.particles;
            std::vector<Vec3> normals(at(p.size()), Vec3::Zero());
            for (Index i = 0; i < p.size(); ++i) {
                for (const Store* s : {&all.wall, &all.body}) {
                    for (Index j = 0; j < s->size(); ++j) {
                        const Vec3 r = p[field::position][i] - (*s)[field::position][j];
                        if (r.norm() < fluid.kernel.support) {
                            const real f = fluid.kernel(Vec<real>{r.x(), r.y(), r.z()}).f;
                            normals[at(i)] += (*s)[field::volume][j] * f * r;
                        }
                    }
                }
            }
            std::vector<Before> before;
            add_compressions(before, all.wall, pressed, normals, fluid.kernel);
            add_compressions(before, all.body, pressed, normals, fluid.kernel);
            std::vector<real> rates;
            for (Index i = 0; i < p.size(); ++i) {
                real rate = 0;
                for (const Before& solid : before) {
                    const Vec3 r = p[field::position][i] - solid.place;
                    if (r.norm() < fluid.kernel.support) {
                        rate += solid.volume * solid.compression *
                                fluid.kernel(Vec<real>{r.x(), r.y(), r.z()}).w;
                    }
                }
                rates.push_back(rate);
            }
            const real largest = std::ranges::max(rates);
            ASSERT_GT(largest, 0);
            // Single precision: records in units of 1e-6 spacings, some hundred terms each; double:
            // the same number of roundings.
            const real tolerance = precision == Precision::single_precision ? 1e-4 : 1e-11;
            for (Index i = 0; i < p.size(); ++i) {
                EXPECT_NEAR(p[field::paired_rate][i], rates[at(i)], tolerance * largest);
            }
        });
    }
}

// A block of fluid on a long wall, both on one lattice, turned by any angle.
struct Turned {
    Places places;
    Mat3 turn;
};
Turned block_on_wall(const Cloud& cloud, Dice& dice)
{
    const bool plane = cloud.dimensions == 2;
    const Vec3 axis = plane ? Vec3(0, 1, 0) : draw(dice, 3, 1).normalized();
    Turned made{{}, Mat3(Eigen::AngleAxis<real>(dice.between(0, 6), axis))};
    const int wide = 5 + dice.below(6);
    const int deep = plane ? 0 : 1 + dice.below(5);
    const int high = 2 + dice.below(8);
    const int beyond = 5;
    for (int x = -beyond; x < wide + beyond; ++x) {
        for (int y = plane ? 0 : -beyond; y <= (plane ? 0 : deep + beyond); ++y) {
            for (int z = -3; z < high; ++z) {
                const Vec3 place = made.turn * Vec3(cloud.spacing * Vec3(x, y, z + 0.5));
                const bool inside = x >= 0 && x < wide && y >= 0 && y <= deep;
                if (z < 0) {
                    made.places.wall.push_back(place);
                } else if (inside) {
                    made.places.fluid.push_back(place);
                }
            }
        }
    }
    return made;
}

// Sums of V R/rho over the fluid, R the plain and the paired rate due to solids, and the largest
// paired one.
struct Taken {
    real plain = 0;
    real paired = 0;
    real largest = 0;
};
Taken taken(Fluid& fluid, const Vec3& velocity)
{
    std::ranges::fill(fluid.particles.fluid[field::velocity], velocity);
    evaluate(fluid);
    const Store& p = fluid.particles.fluid;
    Taken sum;
    for (Index i = 0; i < p.size(); ++i) {
        const real all = p[field::volume][i] * p[field::solid_rate][i] / p[field::density][i];
        sum.plain += all - p[field::paired_rate][i];
        sum.paired += p[field::paired_rate][i];
        sum.largest = std::max(sum.largest, std::abs(p[field::paired_rate][i]));
    }
    return sum;
}

// Exact by symmetry and by the adjoint; the tolerances are of rounding, some hundred terms.
TEST(PairedWalls, WaterThatSlidesIsNotCompressedAndWaterThatApproachesIsByTheSameAgain)
{
    for_clouds([](const Cloud& cloud, Dice& dice) {
        const Turned made = block_on_wall(cloud, dice);
        Fluid fluid = make_fluid(cloud, made.places);
        const Vec3 along{dice.between(-1, 1), cloud.dimensions == 2 ? 0 : dice.between(-1, 1), 0};
        const Taken approach = taken(fluid, made.turn * Vec3(0, 0, -0.7));
        EXPECT_GT(approach.plain, 0);
        EXPECT_NEAR(approach.paired, approach.plain, 1e-11 * approach.plain);
        const Taken slide = taken(fluid, made.turn * along);
        EXPECT_LT(slide.largest, 1e-11 * approach.largest);
        const Taken leave = taken(fluid, made.turn * Vec3(0.7 * along + Vec3(0, 0, 0.7)));
        EXPECT_NEAR(leave.paired, -approach.paired, 1e-11 * approach.plain);
    });
}

// Velocities four times as large round alike; some hundred terms.
TEST(PairedWalls, AVelocityOfAllChangesNothing)
{
    for_clouds([](const Cloud& cloud, Dice& dice) {
        Fluid fluid = make_fluid(cloud, corner(cloud, dice));
        give_velocities(fluid, dice);
        evaluate(fluid);
        const Store before = fluid.particles.fluid;
        const Vec3 wind = draw(dice, cloud.dimensions, 3);
        for (Store* s : {&fluid.particles.fluid, &fluid.particles.wall, &fluid.particles.body}) {
            for (Vec3& v : (*s)[field::velocity]) {
                v += wind;
            }
        }
        update_rates(fluid);
        const auto rate = fluid.particles.fluid[field::paired_rate];
        const real largest = std::ranges::max(rate);
        ASSERT_GT(largest, 0);
        for (Index i = 0; i < before.size(); ++i) {
            EXPECT_NEAR(rate[i], before[field::paired_rate][i], 1e-11 * largest);
        }
    });
}

TEST(PairedWalls, AbsentHasNoColumnAndNoRecords)
{
    Dice dice(1);
    const Cloud plain{.paired = false};
    Fluid fluid = make_fluid(plain, corner(plain, dice));
    evaluate(fluid);
    const Particles& p = fluid.particles;
    EXPECT_FALSE(p.fluid.has(field::wall_normal) || p.fluid.has(field::paired_rate));
    for (const Store* s : {&p.wall, &p.body}) {
        EXPECT_FALSE(s->has(field::wall_compression) || s->has(field::normal_sum) ||
                     s->has(field::gradient_sum) || s->has(field::velocity_sum));
    }
    std::visit([](const auto& data) { EXPECT_EQ(data.wide.bytes(), 0U); }, fluid.pair_data);
    Places alone;
    alone.fluid = corner(plain, dice).fluid;
    Fluid water = make_fluid({}, alone);
    evaluate(water);
    EXPECT_FALSE(water.particles.fluid.has(field::paired_rate));
}

} // namespace
} // namespace hyoryu::test_paired_walls
