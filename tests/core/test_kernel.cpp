// SPDX-License-Identifier: MIT
// The kernels by sums over lattices that are made here: normalised on the lattice, isotropic among
// strained particles, and how fast sound and diffusion run between them.
#include "dice.hpp"
#include "hyoryu/core/kernel.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hyoryu::test_kernel {
namespace {

// Places of a lattice but for the origin, one a unit of volume. `cell`: its edges are the columns.
std::vector<Vec3> lattice(const Mat3& cell, int dimensions, int reach)
{
    const Mat3 edges = cell / std::pow(std::abs(cell.determinant()), 1.0 / dimensions);
    std::vector<Vec3> places;
    const int reach_y = dimensions == 2 ? 0 : reach;
    for (int i = -reach; i <= reach; ++i) {
        for (int j = -reach_y; j <= reach_y; ++j) {
            for (int k = -reach; k <= reach; ++k) {
                Vec3 place = edges * Vec3(i, j, k);
                place.y() = dimensions == 2 ? 0 : place.y();
                if (i != 0 || j != 0 || k != 0) {
                    places.push_back(place);
                }
            }
        }
    }
    return places;
}

// The cells of square and hexagonal lattices, and of simple, face-centred and body-centred cubic
// ones; of one of y = 1 in two dimensions.
std::vector<Mat3> cells(int dimensions)
{
    Mat3 hexagonal = Mat3::Identity();
    hexagonal.col(2) = Vec3(0.5, 0, std::sqrt(0.75));
    Mat3 faces;
    faces << 0, 1, 1, 1, 0, 1, 1, 1, 0;
    Mat3 bodies;
    bodies << -1, 1, 1, 1, -1, 1, 1, 1, -1;
    return dimensions == 2 ? std::vector<Mat3>{Mat3::Identity(), hexagonal}
                           : std::vector<Mat3>{Mat3::Identity(), faces, bodies};
}

Mat3 turned(int dimensions, Dice& dice)
{
    const double angle = dice.between(-std::numbers::pi, std::numbers::pi);
    const Vec3 axis =
        dimensions == 2 ? Vec3::UnitY()
                        : Vec3{dice.between(-1, 1), dice.between(-1, 1), dice.between(-1, 1) + 0.01}
                              .normalized();
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

// (M_zz - M_xx) / (2 s) of the moments M = -sum F r r^T, of a lattice that is stretched by exp(s)
// along x and shortened by as much along z: what resists the strain.
double resistance(const Kernel& kernel, const std::vector<Vec3>& places, double s)
{
    double difference = 0;
    for (const Vec3& place : places) {
        const Vec3 r(std::exp(s) * place.x(), place.y(), std::exp(-s) * place.z());
        difference += kernel(Vec<real>{r.x(), r.y(), r.z()}).f * (sq(r.x()) - sq(r.z()));
    }
    return difference / (2 * s);
}

TEST(Kernel, IsOneAndLinearOnItsLattice)
{
    Dice dice(4711);
    for (int draw = 0; draw < 20; ++draw) {
        for (const int dimensions : {2, 3}) {
            for (const KernelShape shape : {KernelShape::wendland, KernelShape::isotropic}) {
                const real dp = dice.between(0.01, 2);
                const Kernel kernel = make_kernel(dice.between(1.2, 2) * dp, dp, dimensions, shape);
                const real cell = std::pow(dp, dimensions);
                real one = kernel(Vec<real>{0, 0, 0}).w * cell;
                real moment = 0;
                for (const Vec3& p : lattice(Mat3::Identity(), dimensions, 4)) {
                    const auto pair = kernel(Vec<real>{dp * p.x(), dp * p.y(), dp * p.z()});
                    one += pair.w * cell;
                    moment -= pair.f * sq(dp * p.x()) * cell;
                }
                EXPECT_NEAR(one, 1, 1e-13);
                EXPECT_NEAR(moment, 1, 1e-13);
            }
        }
    }
}

// The means of both kernels are the same, and both only repel, to the support and no farther.
TEST(Kernel, TakesTheSameMeansInBothShapesAndRepels)
{
    Dice dice(11);
    for (int draw = 0; draw < 200; ++draw) {
        const int dimensions = draw % 2 == 0 ? 2 : 3;
        const real h = dice.between(1.2, 2);
        const Kernel plain = make_kernel(h, 1, dimensions);
        const Kernel even = make_kernel(h, 1, dimensions, KernelShape::isotropic);
        const real distance = dice.between(0, 2.2 * h);
        const Vec<real> r{distance, 0, 0};
        EXPECT_EQ(plain(r).w, even(r).w);
        if (distance < 2 * h) {
            EXPECT_LT(even(r).f, 0);
        } else {
            EXPECT_EQ(even(r).f, 0);
        }
    }
}

// As its formula says: F over that of Wendland is a polynomial of b, but for the two scales.
TEST(Kernel, HasTheShapeOfItsFormula)
{
    Dice dice(12);
    for (int draw = 0; draw < 100; ++draw) {
        const int dimensions = draw % 2 == 0 ? 2 : 3;
        const real h = dice.between(1.2, 2);
        const Kernel plain = make_kernel(h, 1, dimensions);
        const Kernel even = make_kernel(h, 1, dimensions, KernelShape::isotropic);
        const auto ratio = [&](real b) { // of both at a place, over what the formula has there
            const Vec<real> r{0, 0, 2 * h * (1 - b)};
            return even(r).f / plain(r).f /
                   (1 - 6 * b + 23.4 * b * b - 31.1 * b * b * b + 13.9 * std::pow(b, 4));
        };
        EXPECT_NEAR(ratio(dice.between(0.1, 1)) / ratio(1), 1, 1e-9);
    }
}

// The Fourier transform of W with W' = F r, by partial integration, at the wave number k.
double transform(const Kernel& kernel, int dimensions, double k)
{
    constexpr int steps = 1500; // of the midpoint rule, exact to 1e-6 of the transform at k = 0
    const double step = kernel.support / steps;
    double sum = 0;
    for (int n = 0; n < steps; ++n) {
        const double r = (n + 0.5) * step;
        const double x = k * r;
        const double wave = dimensions == 2 ? r * r * std::cyl_bessel_j(1, x)
                                            : 2 * r * r * r * std::sph_bessel(1, x);
        sum -= kernel(Vec<real>{r, 0, 0}).f * wave * step;
    }
    return 2 * std::numbers::pi * sum / k;
}

// Particles under a kernel with a Fourier transform below zero form pairs (Dehnen & Aly 2012). That
// of Wendland's is positive; ours has at least half of it. The shape decides: one smoothing length
// stands for all. Beyond k h = 30 the transforms are no larger than the error of the sum, 1e-6.
TEST(Kernel, HasNoNegativeFourierTransform)
{
    for (const int dimensions : {2, 3}) {
        const Kernel plain = make_kernel(1.5, 1, dimensions);
        const Kernel even = make_kernel(1.5, 1, dimensions, KernelShape::isotropic);
        for (double kh = 0.25; kh < 30; kh += 0.25) {
            EXPECT_GT(transform(even, dimensions, kh / 1.5),
                      transform(plain, dimensions, kh / 1.5) / 2 - 1e-6)
                << dimensions << " " << kh;
        }
    }
}

// Lattices of every kind, drawn orientations, strains to 0.2 and smoothing lengths about the
// default of 1.5 spacings. Water starts on square and cubic ones, which resist 0.3 times as much as
// with Wendland's kernel: half is asked. Other lattices yield where those resist, 0.7 to 0.95 times
// as much. No resistance is beyond 0.04: 0.05 is asked. There is no theory for these bounds.
TEST(Kernel, StaysIsotropicAmongStrainedParticles)
{
    Dice dice(20261127);
    for (const int dimensions : {2, 3}) {
        for (const Mat3& cell : cells(dimensions)) {
            const std::vector<Vec3> upright = lattice(cell, dimensions, dimensions == 2 ? 9 : 7);
            double squares[2] = {0, 0};
            double worst = 0;
            constexpr int draws = 60;
            for (int draw = 0; draw < draws; ++draw) {
                const Mat3 turn = turned(dimensions, dice);
                std::vector<Vec3> places;
                for (const Vec3& p : upright) {
                    places.push_back(turn * p);
                }
                const double s = dice.between(0.02, 0.2) * (draw % 2 == 0 ? 1 : -1);
                const real h = dice.between(1.4, 1.6);
                const double plain = resistance(make_kernel(h, 1, dimensions), places, s);
                const double even =
                    resistance(make_kernel(h, 1, dimensions, KernelShape::isotropic), places, s);
                squares[0] += sq(plain);
                squares[1] += sq(even);
                worst = std::max(worst, std::abs(even));
            }
            const double share = cell.isIdentity() ? 0.5 : 1;
            EXPECT_LT(std::sqrt(squares[1]), share * std::sqrt(squares[0])) << dimensions;
            EXPECT_LT(worst, 0.05) << dimensions;
        }
    }
}

// The waves of the lattice whose pressure answers the most, and whose differences diffuse the
// fastest, by all wave vectors along drawn ways.
struct Answers {
    double sound = 0;
    double diffusion = 0;
};

Answers answers(const Kernel& kernel, int dimensions, Dice& dice)
{
    const std::vector<Vec3> places = lattice(Mat3::Identity(), dimensions, 4);
    Answers most;
    for (int way = 0; way < 12; ++way) {
        const Mat3 turn = way == 0 ? Mat3(Mat3::Identity()) : turned(dimensions, dice);
        const Vec3 along = turn.col(0);
        for (double k = 0.1; k < 4.5; k += 0.05) {
            Vec3 sound = Vec3::Zero();
            double diffusion = 0;
            for (const Vec3& p : places) {
                const double f = kernel(Vec<real>{p.x(), p.y(), p.z()}).f;
                sound += f * std::sin(k * along.dot(p)) * p;
                diffusion -= 2 * f * (1 - std::cos(k * along.dot(p)));
            }
            most.sound = std::max(most.sound, sound.norm());
            most.diffusion = std::max(most.diffusion, diffusion);
        }
    }
    return most;
}

TEST(Kernel, AsksForStepsByTheFastestWaveOfItsLattice)
{
    Dice dice(5);
    for (int draw = 0; draw < 16; ++draw) {
        const int dimensions = draw % 2 == 0 ? 2 : 3;
        const real h = draw < 2 ? 1.5 : dice.between(1.2, 2);
        const Answers plain = answers(make_kernel(h, 1, dimensions), dimensions, dice);
        const Answers even =
            answers(make_kernel(h, 1, dimensions, KernelShape::isotropic), dimensions, dice);
        const double sound = even.sound / plain.sound;
        const double diffusion = even.diffusion / plain.diffusion;
        // Steps of 0.05 in the wave number and twelve ways find the maximum within 0.3 %; over the
        // smoothing lengths the ratio varies by 1 %, that of diffusion between 1.09 and 1.14. In
        // three dimensions it is 1.058 at 1.5, on the side of shorter steps.
        EXPECT_NEAR(sound, sound_frequency(KernelShape::isotropic), h == 1.5 ? 0.008 : 0.015) << h;
        EXPECT_LT(diffusion, diffusion_rate(KernelShape::isotropic) + 0.01) << h;
        EXPECT_GT(diffusion, diffusion_rate(KernelShape::isotropic) - 0.06) << h;
    }
}

} // namespace
} // namespace hyoryu::test_kernel
