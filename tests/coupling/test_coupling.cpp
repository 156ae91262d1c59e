// SPDX-License-Identifier: MIT
// Poses place particles, pair forces load bodies: equal and opposite to what the fluid feels.
#include "hyoryu/coupling/coupling.hpp"

#include <gtest/gtest.h>

namespace hyoryu {
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
    std::vector<Wrench> loads;
    collect_loads(scene.fluid, scene.poses, scene.bodies, loads);
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

TEST(Coupling, FreeFlightTurnsAboutTheCentre)
{
    Immersed scene;
    const auto later = free_flight(scene.rigid, 0.1);
    EXPECT_NEAR((later[0].position - Vec3(0.5, 0.6, 0.5)).norm(), 0, 1e-12);
    const Vec3 turned = later[0].orientation * Vec3::UnitX();
    EXPECT_NEAR((turned - Vec3(std::cos(0.2), std::sin(0.2), 0)).norm(), 0, 1e-12);
}

} // namespace
} // namespace hyoryu
