// SPDX-License-Identifier: MIT
// Poses place particles, pair forces load bodies: equal and opposite to what the fluid feels.
#include "hyoryu/coupling/coupling.hpp"

#include "../dice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace hyoryu::test_coupling {
namespace {

// A lattice of fluid with a body of 4 x 4 x 4 particles in its middle.
struct Immersed {
    Fluid fluid;
    Rigid rigid;
    BodyParticles bodies;
    std::vector<Pose> poses;

    explicit Immersed(Precision precision = Precision::single_precision)
    {
        constexpr real dp = 0.1;
        FluidParameters& f = fluid.parameters;
        f = {.eos = {1000, 30}, .spacing = dp, .h = 1.5 * dp, .mass = 1};
        f.precision = precision;
        fluid.kernel = make_kernel(f.h, dp, 3);
        std::vector<Vec3> water;
        for (int k = 0; k < 1000; ++k) {
            const Vec3 p = dp * (Vec3(k % 10, k / 10 % 10, k / 100) + Vec3::Constant(0.5));
            if ((p - Vec3::Constant(0.5)).cwiseAbs().maxCoeff() < 0.2) {
                bodies.points.push_back(p - Vec3::Constant(0.5));
            } else {
                water.push_back(p);
            }
        }
        bodies.of.push_back({0, static_cast<Index>(bodies.points.size())});
        allocate(fluid, static_cast<Index>(water.size()), 0, bodies.of[0].end);
        std::copy(water.begin(), water.end(), fluid.particles.fluid[field::position].begin());
        for (std::size_t i = 0; i < water.size(); ++i) {
            fluid.particles.fluid[field::density][i] = 1000 + 0.3 * static_cast<real>(i % 11);
            fluid.particles.fluid[field::velocity][i] = {0.1 * static_cast<real>(i % 3), 0, -0.2};
        }
        fluid.body_particle_mass = {1.0};
        Body body;
        body.shape = box_polytope({0.4, 0.4, 0.4}, 3);
        body.mass = mass_properties(body.shape, 500, 3);
        body.position = Vec3::Constant(0.5);
        body.velocity = {0, 1, 0};
        body.angular_momentum = angular_momentum(body, {0, 0, 2});
        rigid.bodies.push_back(body);
        poses = free_flight(rigid, 0);
        place_bodies(rigid, poses, bodies, fluid);
        update_neighbours(fluid);
        update_pressure(fluid);
        update_forces(fluid, 1e-3);
    }
};

std::vector<Wrench> loads_on_bodies(const Fluid& fluid, const std::vector<Pose>& poses)
{
    OwnerSums<6> sums;
    collect_loads(fluid, poses, sums);
    sums.end();
    std::vector<Wrench> loads;
    for (std::size_t b = 0; b < sums.owners(); ++b) {
        const auto [fx, fy, fz, tx, ty, tz] = sums.of(b);
        loads.push_back({Vec3(fx, fy, fz), Vec3(tx, ty, tz)});
    }
    return loads;
}

std::vector<Vec3> forces_on_walls(const Fluid& fluid, std::size_t walls)
{
    OwnerSums<3> sums;
    collect_wall_forces(fluid, walls, sums);
    sums.end();
    std::vector<Vec3> forces;
    for (std::size_t wall = 0; wall < walls; ++wall) {
        const auto [x, y, z] = sums.of(wall);
        forces.emplace_back(x, y, z);
    }
    return forces;
}

TEST(Coupling, ParticlesMoveWithTheirBody)
{
    Immersed scene;
    const Store& store = scene.fluid.particles.body;
    ASSERT_EQ(store.size(), 64);
    for (Index k = 0; k < store.size(); ++k) {
        const Vec3 r = store[field::position][k] - Vec3::Constant(0.5);
        const Vec3 expected = Vec3(0, 1, 0) + Vec3(0, 0, 2).cross(r);
        EXPECT_NEAR((store[field::velocity][k] - expected).norm(), 0, 1e-12);
    }
}

// Pair forces are equal and opposite bit for bit. What is left is the rounding of their sums over
// the neighbours of a particle, a hundred terms, which over a thousand particles is at random.
struct Closure {
    Precision precision;
    double bound; // of the sums over the scale of the forces
};
void PrintTo(const Closure& closure, std::ostream* to)
{
    *to << name(closure.precision);
}
class Reaction : public testing::TestWithParam<Closure> {};

TEST_P(Reaction, TheLoadIsTheReactionOfTheFluid)
{
    const auto [precision, bound] = GetParam();
    Immersed scene(precision);
    const std::vector<Wrench> loads = loads_on_bodies(scene.fluid, scene.poses);
    Vec3 on_fluid = Vec3::Zero();
    Vec3 torque_on_fluid = Vec3::Zero();
    real scale = 0;
    const Rows rows = scene.fluid.particles.fluid.rows();
    for (Index i = rows.begin; i < rows.end; ++i) {
        const Vec3& f = scene.fluid.particles.fluid[field::force][static_cast<std::size_t>(i)];
        const Vec3& x = scene.fluid.particles.fluid[field::position][static_cast<std::size_t>(i)];
        on_fluid += f;
        torque_on_fluid += (x - Vec3::Constant(0.5)).cross(f);
        scale += f.norm();
    }
    EXPECT_GT(loads[0].force.norm(), 0);
    EXPECT_NEAR((on_fluid + loads[0].force).norm() / scale, 0, bound);
    EXPECT_NEAR((torque_on_fluid + loads[0].torque).norm() / scale, 0, bound);
}

INSTANTIATE_TEST_SUITE_P(Coupling, Reaction,
                         testing::Values(Closure{Precision::single_precision, 1e-8},
                                         Closure{Precision::double_precision, 1e-14}));

// Points in a box with owners in patches, forces of many sizes on them, sorted into tiles.
Fluid loaded_solids(Dice& dice, double spacing, Index walls, Index bodies)
{
    constexpr int count = 3000;
    Fluid fluid;
    fluid.parameters = {.eos = {1000, 30}, .spacing = spacing, .h = 1.5 * spacing, .mass = 1};
    fluid.kernel = make_kernel(fluid.parameters.h, spacing, 3);
    allocate(fluid, 1, count, count);
    fluid.body_particle_mass.assign(static_cast<std::size_t>(bodies), 1.0);
    const double size = 20 * spacing;
    for_solids(fluid.particles, [&](Store& store) {
        const bool body = &store == &fluid.particles.body;
        for (Index k = 0; k < store.size(); ++k) {
            const double x = dice.between(0, size);
            const double y = dice.between(0, size);
            store[field::position][k] = {x, y, dice.between(0, size)};
            const auto owner =
                static_cast<std::int32_t>(x / size * static_cast<double>(body ? bodies : walls));
            store.owner()[k] = body ? owner : -1 - owner;
        }
    });
    update_neighbours(fluid);
    for_solids(fluid.particles, [&](Store& store) {
        for (Vec3& force : store[field::force]) {
            const double scale = std::pow(10.0, dice.between(-12, 3));
            const double x = dice.between(-scale, scale);
            const double y = dice.between(-scale, scale);
            force = {x, y, dice.between(-scale, scale)};
        }
    });
    FluidNeighbours& n = fluid.neighbours; // forces act on walls that water is near
    n.wet_walls.resize(static_cast<std::size_t>(n.wall.tiles()));
    std::iota(n.wet_walls.begin(), n.wet_walls.end(), 0);
    return fluid;
}

TEST(Coupling, LoadsAreTheSerialSumsForAnyNumberOfThreads)
{
    for (int seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        Dice dice(static_cast<std::uint64_t>(seed));
        const Index owners = 1 + dice.below(9);
        const Fluid fluid = loaded_solids(dice, seed % 2 == 0 ? 0.1 : 0.02, owners, owners);
        std::vector<Pose> poses(static_cast<std::size_t>(owners));
        std::vector<Wrench> expected(poses.size());
        std::vector<Vec3> expected_on_walls(poses.size(), Vec3(0, 0, 0));
        const Store& body = fluid.particles.body;
        const Store& wall = fluid.particles.wall;
        for (Index k = 0; k < body.size(); ++k) { // the same number of either
            const Vec3& f = body[field::force][k];
            Wrench& load = expected[static_cast<std::size_t>(body.owner()[k])];
            load.force += f;
            load.torque += body[field::position][k].cross(f);
            expected_on_walls[static_cast<std::size_t>(-1 - wall.owner()[k])] +=
                wall[field::force][k];
        }
        std::vector<Wrench> first;
        std::vector<Vec3> first_on_walls;
        for (const int threads : {1, 2, 3, 4}) {
            set_threads(threads);
            const std::vector<Wrench> loads = loads_on_bodies(fluid, poses);
            const std::vector<Vec3> on_walls = forces_on_walls(fluid, poses.size());
            first = threads == 1 ? loads : first;
            first_on_walls = threads == 1 ? on_walls : first_on_walls;
            for (std::size_t b = 0; b < poses.size(); ++b) {
                // Rounding of 3000 terms below 1000 N, at arms below 4 m.
                EXPECT_NEAR((loads[b].force - expected[b].force).norm(), 0, 1e-7);
                EXPECT_NEAR((loads[b].torque - expected[b].torque).norm(), 0, 4e-7);
                EXPECT_NEAR((on_walls[b] - expected_on_walls[b]).norm(), 0, 1e-7);
                EXPECT_EQ(loads[b].force, first[b].force);
                EXPECT_EQ(loads[b].torque, first[b].torque);
                EXPECT_EQ(on_walls[b], first_on_walls[b]);
            }
        }
        set_threads(0);
    }
}

// A force that is lost is told by the load: it is not a number.
TEST(Coupling, ALoadOfForcesThatAreNotFiniteIsNotFinite)
{
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity, 1e200}) {
        Dice dice(7);
        Fluid fluid = loaded_solids(dice, 0.05, 3, 3);
        fluid.particles.body[field::force][17].y() = bad;
        fluid.particles.wall[field::force][18].z() = bad;
        const auto body = static_cast<std::size_t>(fluid.particles.body.owner()[17]);
        const auto wall = static_cast<std::size_t>(-1 - fluid.particles.wall.owner()[18]);
        const std::vector<Wrench> loads = loads_on_bodies(fluid, std::vector<Pose>(3));
        const std::vector<Vec3> on_walls = forces_on_walls(fluid, 3);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(std::isfinite(loads[k].force.y()), k != body) << bad;
            EXPECT_EQ(loads[k].torque.allFinite(), k != body) << bad;
            EXPECT_TRUE(std::isfinite(loads[k].force.x())) << bad;
            EXPECT_EQ(on_walls[k].allFinite(), k != wall) << bad;
        }
    }
}

TEST(Coupling, FreeFlightTurnsAboutTheCentre)
{
    Immersed scene;
    const auto later = free_flight(scene.rigid, 0.1);
    EXPECT_NEAR((later[0].position - Vec3(0.5, 0.6, 0.5)).norm(), 0, 1e-12);
    const Vec3 turned = later[0].orientation * Vec3::UnitX();
    EXPECT_NEAR((turned - Vec3(std::cos(0.2), std::sin(0.2), 0)).norm(), 0, 1e-12);
}

} // namespace
} // namespace hyoryu::test_coupling
