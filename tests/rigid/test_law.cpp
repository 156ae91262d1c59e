// SPDX-License-Identifier: MIT
// The switchable impact laws against the event solvers of the contact notes (tables (a) and (c),
// tests T5 and T8; rows of the series a_tilt10_mu3_paper, a_corner3d_mu3_paper, c_timber_*).
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

namespace hyoryu::test_law {
namespace {

using namespace test;

Rigid timber(ImpactLaw law, double mu, int dimensions)
{
    Rigid rigid = on_floor(0.4, mu, dimensions);
    rigid.settings.law = law;
    rigid.bodies.push_back(
        box(timber_size(), 520, {-0.318198051533946, 0, 0.388908729652601}, dimensions));
    rigid.bodies[0].orientation = turn_about(Vec3::UnitY(), 45);
    return rigid;
}

// Height and vertical speed of an edge in the axes of the body.
Vec3 edge(const Body& body, double x)
{
    return body.position + body.orientation * Vec3(x, 0, -0.05);
}
double edge_speed(const Body& body, double x)
{
    const Vec3 arm = body.orientation * Vec3(x, 0, -0.05);
    return (body.velocity + angular_velocity(body).cross(arm)).z();
}

struct TimberRow {
    ImpactLaw law;
    double mu, t_d;  // time of the first left-end impact [s]
    double v_c, v_d; // right and left end after it [m/s]
    double energy;   // after it [J]
    double peak;     // of the right end [m]
    double final_x;  // of the right end [m]
};
void PrintTo(const TimberRow& row, std::ostream* to)
{
    constexpr std::array names{"coupled", "paper", "simultaneous"};
    *to << names.at(static_cast<std::size_t>(row.law)) << " law, mu = " << row.mu;
}

class TimberLaw : public testing::TestWithParam<std::tuple<TimberRow, int>> {};

// In space both ends are edges of two corners, and the answer is the same.
TEST_P(TimberLaw, LeavesTheFirstImpactAsTheEventSolver)
{
    const auto& [row, dimensions] = GetParam();
    Rigid rigid = timber(row.law, row.mu, dimensions);
    const Body& body = rigid.bodies[0];
    const double before = row.t_d - 2e-6; // the table rounds to microseconds
    run(rigid, before / 4000, 4000);      // where slip turns to stick within a step is not located
    const std::vector<Contact> log = run(rigid, 1e-6, 4, {}, before);
    ASSERT_TRUE(std::any_of(log.begin(), log.end(),
                            [](const Contact& c) { return c.kind == Contact::Kind::impact; }));
    // T8; four microseconds of gravity change a speed by 4e-5
    EXPECT_NEAR(edge_speed(body, 0.5), row.v_c, 1e-4);
    EXPECT_NEAR(edge_speed(body, -0.5), row.v_d, 1e-4);
    const double width = dimensions == 2 ? 0.1 : 1; // energy per metre of width
    // friction of the step in which the slip turns is off by the first order of that step
    EXPECT_NEAR(width * energy(rigid), row.energy, 1e-4);
}

TEST_P(TimberLaw, BouncesAndSettlesAsTheEventSolver)
{
    const auto& [row, dimensions] = GetParam();
    Rigid rigid = timber(row.law, row.mu, dimensions);
    const Body& body = rigid.bodies[0];
    double peak = 0;
    run(rigid, 1e-3, 1000,
        [&, t_d = row.t_d](double t) { peak = t > t_d ? std::max(peak, edge(body, 0.5).z()) : 0; });
    EXPECT_NEAR(peak, row.peak, 0.05e-3);                   // as T7 asks for law S
    EXPECT_NEAR(edge(body, 0.5).x(), row.final_x, 0.05e-3); // likewise
}

constexpr ImpactLaw P = ImpactLaw::paper;
constexpr ImpactLaw M = ImpactLaw::simultaneous;
INSTANTIATE_TEST_SUITE_P(
    Rows, TimberLaw,
    testing::Combine(
        testing::Values(
            TimberRow{P, 0.0, 0.327424, 0.983381, 0.147555, 3.534839, 38.0978e-3, 0.181802},
            TimberRow{P, 0.3, 0.352183, 0.945943, 0.200700, 3.531858, 37.1188e-3, 0.105341},
            TimberRow{P, 0.6, 0.388742, 0.897832, 0.241510, 3.516303, 34.9824e-3, -0.004344},
            TimberRow{M, 0.0, 0.327424, 0, 1.784306, 5.316746, 0, 0.181802},
            TimberRow{M, 0.3, 0.352183, 0, 1.736976, 5.191557, 0, 0.107948},
            TimberRow{M, 0.6, 0.388742, 0, 1.733855, 5.182075, 0, -0.012367}),
        testing::Values(2, 3)));

// The tilted cube under the law of the paper gains energy at every impact after the first.
TEST(PaperLaw, FollowsTheSeriesOfTheTiltedCube)
{
    struct Row {
        double x, z, vx, vz, omega, energy; // after every 100 ms
    };
    // Series a_tilt10_mu3_paper at 0.2, 0.3 ... 0.6 s.
    constexpr std::array<Row, 5> rows{
        {{-0.0203796792, 0.0639074204, -0.391942864, 0.434133959, -37.3895802, 0.0518983939},
         {-0.0595739656, 0.0582708162, -0.391942864, -0.546866041, -37.3895802, 0.0518983939},
         {-0.0653295685, 0.0718342763, 0.0977047139, 0.189776113, 48.4290959, 0.0595616211},
         {-0.0555590971, 0.0417618876, 0.0977047139, -0.791223887, 48.4290959, 0.0595616211},
         {-0.094094658, 0.0852014974, -0.429482432, 0.100661038, -52.9723994, 0.0740849106}}};
    Rigid rigid = on_floor(0.75, 0.3, 2);
    rigid.settings.law = ImpactLaw::paper;
    rigid.bodies.push_back(box(cube_size(), 250, {0, 0, 0.129829639155}, 2));
    const Body& cube = rigid.bodies[0];
    rigid.bodies[0].orientation = turn_about(Vec3::UnitY(), 10);
    run(rigid, 1e-3, 100);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double start = 0.1 * static_cast<double>(k + 1);
        run(rigid, 1e-3, 100, {}, start);
        // errors of the time of impact grow by the spin with every bounce
        EXPECT_NEAR(cube.position.x(), rows[k].x, 1e-6);
        EXPECT_NEAR(cube.position.z(), rows[k].z, 1e-6);
        EXPECT_NEAR(cube.velocity.x(), rows[k].vx, 1e-5);
        EXPECT_NEAR(cube.velocity.z(), rows[k].vz, 1e-5);
        // a turn counter-clockwise in x-z is one about -y
        EXPECT_NEAR(-angular_velocity(cube).y(), rows[k].omega, 1e-3);
        EXPECT_NEAR(0.06 * energy(rigid), rows[k].energy, 1e-7);
    }
}

TEST(PaperLaw, FollowsTheSeriesOfTheCornerDrop)
{
    Rigid rigid = on_floor(0.75, 0.3);
    rigid.settings.law = ImpactLaw::paper;
    rigid.bodies.push_back(box(cube_size(), 250, {0, 0, 0.144700935645}));
    Body& cube = rigid.bodies[0];
    cube.orientation = turn_about(Vec3::UnitX(), 20) * turn_about(Vec3::UnitY(), 30);
    const auto spin = [&] { return Vec3(cube.orientation.conjugate() * angular_velocity(cube)); };
    run(rigid, 1e-3, 150);
    // Series a_corner3d_mu3_paper at 0.15 s and 0.375 s, one and three impacts later; the
    // tolerance is that of T4.
    EXPECT_LE((cube.velocity - Vec3(0, 0, -0.135842848)).norm(), 1e-5);
    EXPECT_LE((spin() - Vec3(-42.0486475, -32.819824, -8.53659671)).norm(), 1e-3);
    run(rigid, 1e-3, 225, {}, 0.15);
    EXPECT_LE((cube.position - Vec3(-0.0346724449, 0.0545185848, 0.06028582)).norm(), 1e-6);
    EXPECT_LE((spin() - Vec3(39.2356968, -30.3610147, -12.9909862)).norm(), 1e-3);
}

// A flat landing has no preferred corner: the mean point of the face gives the exact bounce.
TEST(PaperLaw, LandsFlatWithoutSpin)
{
    Rigid rigid = on_floor(0.75, 0.3);
    rigid.settings.law = ImpactLaw::paper;
    rigid.settings.gravity.setZero();
    rigid.bodies.push_back(box(cube_size(), 250, {0, 0, 0.026}));
    rigid.bodies[0].velocity.z() = -1.4007;
    const std::vector<Contact> log = run(rigid, 1e-3, 2);
    EXPECT_NEAR(rigid.bodies[0].velocity.z(), 0.75 * 1.4007, 1e-12);
    EXPECT_LE(angular_velocity(rigid.bodies[0]).norm(), 1e-9);
    EXPECT_EQ(log.size(), 4);
}

// A repeatable sequence of numbers in [0, 1).
double number(int k)
{
    const double x = std::sin(12.9898 * k + 78.233) * 43758.5453;
    return x - std::floor(x);
}

struct Hits {
    int gaining = 0;
    double worst = 0;        // largest gain of kinetic energy over the energy before
    double worst_ledger = 0; // largest error of the booked loss over the energy before
};

// Random hits of one corner of the cube on the floor, e 0 .. 1, mu 0 .. 1.2, without gravity.
Hits random_hits(ImpactLaw law, int count)
{
    Hits hits;
    for (int k = 0; k < count; ++k) {
        const auto r = [k](int m) { return number(20 * k + m); };
        Rigid rigid = on_floor(r(0), 1.2 * r(1), 2);
        rigid.settings.law = law;
        rigid.settings.gravity.setZero();
        Body cube = box(cube_size(), 250, {0, 0, 0}, 2);
        cube.orientation = turn_about(Vec3::UnitY(), 360 * r(2));
        double lowest = 0;
        for (const Vec3& corner : std::get<Polytope>(cube.shape).corners) {
            lowest = std::min(lowest, (cube.orientation * corner).z());
        }
        cube.position.z() = -lowest;
        cube.velocity = {4 * r(3) - 2, 0, -1 - r(4)};
        cube.angular_momentum = angular_momentum(cube, {0, 80 * r(5) - 40, 0});
        rigid.bodies.push_back(cube);
        const double before = kinetic_energy(cube);
        // so short that no second corner comes down
        const std::vector<Contact> log = run(rigid, 1e-9, 1);
        const double gain = kinetic_energy(rigid.bodies[0]) - before;
        double lost = 0;
        for (const Contact& contact : log) {
            lost += contact.energy_lost;
        }
        hits.gaining += gain > 1e-12 * before ? 1 : 0;
        hits.worst = std::max(hits.worst, gain / before);
        hits.worst_ledger = std::max(hits.worst_ledger, std::abs(gain + lost) / before);
    }
    return hits;
}

TEST(RandomHits, GainEnergyByTheLawOfThePaperOnly)
{
    constexpr int count = 2000;
    const Hits coupled = random_hits(ImpactLaw::coupled, count);
    const Hits simultaneous = random_hits(ImpactLaw::simultaneous, count);
    const Hits paper = random_hits(ImpactLaw::paper, count);
    EXPECT_LE(coupled.worst, 1e-12);
    EXPECT_LE(simultaneous.worst, 1e-12);
    // T5: at least 3 % must show it; the contact notes found 8.1 % of 20 000, up to +113 %
    EXPECT_GE(paper.gaining, 0.03 * count);
    EXPECT_GE(paper.worst, 0.3);
    // losses, or gains, are booked to round-off under every law
    EXPECT_LE(coupled.worst_ledger, 1e-12);
    EXPECT_LE(simultaneous.worst_ledger, 1e-12);
    EXPECT_LE(paper.worst_ledger, 1e-12);
    RecordProperty("paper_gaining", paper.gaining);
}

// Under the simultaneous law a blow at one end of a row of balls moves the whole row.
TEST(SimultaneousLaw, TakesRestingContactsIntoTheBlow)
{
    for (const ImpactLaw law : {ImpactLaw::coupled, ImpactLaw::simultaneous}) {
        Rigid rigid = scene(0.0, 0.0);
        rigid.settings.law = law;
        rigid.settings.gravity.setZero();
        for (int k = 0; k < 3; ++k) {
            rigid.bodies.push_back(body_of(Ball{0.05}, 1000, {0.1 * k, 0, 0}));
        }
        rigid.bodies[0].velocity.x() = 1;
        const std::vector<Contact> log = run(rigid, 1e-3, 1);
        // e = 0: one common velocity, at once or round after round
        for (const Body& body : rigid.bodies) {
            EXPECT_NEAR(body.velocity.x(), 1.0 / 3, 1e-9);
        }
        Vec3 impulse = Vec3::Zero(); // on the last ball
        for (const Contact& contact : log) {
            const Vec3 P_ab = contact.normal_impulse * contact.normal;
            impulse += contact.a == 2 ? P_ab : contact.b == 2 ? Vec3(-P_ab) : Vec3(0, 0, 0);
        }
        EXPECT_NEAR(impulse.x(), rigid.bodies[2].mass.mass / 3, 1e-9);
    }
}

} // namespace
} // namespace hyoryu::test_law
