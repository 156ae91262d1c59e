// SPDX-License-Identifier: MIT
// The inertia of the inflow into a joint: its inertance against the flow in a slot, integrated cell
// by cell, and the drop against bodies of which it does not know all that moves or holds them. The
// spread of a jump by sound against a front in a slot.
#include "../../src/coupling/joint_inflow.hpp"
#include "../../src/coupling/joint_mobility.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/coupling/seepage.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hyoryu {
namespace {

// The mean pressure below that at the rims in a slot of width `gap`, open at one or both ends,
// whose sides part with a growing speed: rho du/dt = -dp/dx, u from the volume between the closed
// end (or the middle) and the place.
double drop_in_slot(double density, double length, double gap, double growth, bool both_ends)
{
    constexpr int cells = 4000;
    const double path = both_ends ? length / 2 : length;
    const double dx = path / cells;
    double p = 0;
    double mean = 0;
    for (int k = 0; k < cells; ++k) { // from the rim inward
        const double behind = path - (k + 0.5) * dx;
        const double slope = density * growth * behind / gap;
        mean += (p + slope * dx / 2) / cells;
        p += slope * dx;
    }
    return mean;
}

TEST(JointInflow, TheInertanceIsThatOfASlot)
{
    std::mt19937 dice(3);
    std::uniform_real_distribution<double> part(0.1, 1);
    for (int k = 0; k < 20; ++k) {
        const double density = 1000 * part(dice);
        const double length = part(dice);
        const double gap = 0.1 * part(dice);
        const double growth = 30 * part(dice);
        for (const bool both : {false, true}) {
            const double rim = both ? 2 : 1; // per metre of width
            const double drop = joint_inertance(density, length / rim, gap * rim) * length * growth;
            EXPECT_NEAR(drop, drop_in_slot(density, length, gap, growth, both), 1e-6 * drop);
        }
    }
}

// A body that the joint opens, with a mass that the joint does not know: of what lies on it.
struct Lifted {
    double mobility = 0; // of the body alone [m4/kg]
    double share = 1;    // mass of the body, of all that moves
    double inertance = 0;

    double growth(double pressure) const { return mobility * share * pressure; }
};

TEST(JointInflow, TheDropOfAFreeBodyIsThereAfterAStep)
{
    std::mt19937 dice(4);
    std::uniform_real_distribution<double> decades(-3, 3);
    for (int k = 0; k < 50; ++k) {
        const Lifted body{.mobility = std::pow(10, decades(dice)),
                          .inertance = std::pow(10, decades(dice))};
        const JointResponse joint{body.inertance, body.mobility};
        const double pressure = 100;
        const double drop = inertia_drop(0, joint, body.growth(pressure), pressure);
        const double exact = pressure * (1 - 1 / (1 + body.inertance * body.mobility));
        EXPECT_NEAR(drop, exact, 1e-9 * pressure);
        const double again = body.growth(pressure - drop);
        EXPECT_NEAR(inertia_drop(drop, joint, again, pressure), exact, 1e-9 * pressure);
    }
}

// However heavy what lies on the body and however large the inertance: no oscillation, and at the
// end the drop belongs to the acceleration.
TEST(JointInflow, TheDropUnderAStackIsReachedFromBelow)
{
    std::mt19937 dice(5);
    std::uniform_real_distribution<double> part(0, 1);
    for (int k = 0; k < 50; ++k) {
        const Lifted body{.mobility = 1,
                          .share = std::pow(10, -2 * part(dice)),
                          .inertance = std::pow(10, 3 * part(dice) - 1)};
        const JointResponse joint{body.inertance, body.mobility};
        const double pressure = 100;
        double drop = 0;
        for (int step = 0; step < 3000; ++step) {
            const double next = inertia_drop(drop, joint, body.growth(pressure - drop), pressure);
            EXPECT_GE(next, drop - 1e-9);
            drop = next;
        }
        EXPECT_NEAR(drop, body.inertance * body.growth(pressure - drop), 1e-6 * pressure);
    }
}

TEST(JointInflow, TheDropStaysBetweenZeroAndThePressure)
{
    const JointResponse joint{.inertance = 10, .mobility = 1};
    EXPECT_EQ(inertia_drop(50, joint, -1e6, 100), 0);  // the body is stopped
    EXPECT_EQ(inertia_drop(50, joint, 1e6, 100), 100); // struck upward: no suction
    EXPECT_EQ(inertia_drop(50, joint, 1, 0), 0);       // dry
}

// The front of a jump at the rim of a slot runs in at the speed of sound: after the time t its mean
// has risen by the part c t / l. The model has an exponential of the same mean delay, 0.16 off, and
// ends it sooner, by growth, if the pressure was not zero: 0.31 off at most, and a little more with
// long steps.
TEST(JointInflow, AJumpSpreadsAsSoundInASlot)
{
    std::mt19937 dice(9);
    std::uniform_real_distribution<double> part(0.1, 1);
    for (int k = 0; k < 20; ++k) {
        const double length = 10 * part(dice);
        const double sound = 100 * part(dice);
        const double dt = 0.2 * part(dice) * length / sound;
        const double before = 1000 * part(dice);
        const double rims = before + 1e5 * part(dice);
        double p = before;
        for (double t = dt; t < 2 * length / sound; t += dt) {
            p = spread_by_sound(p, rims, 2 * sound * dt / length);
            const double front = before + (rims - before) * std::min(sound * t / length, 1.0);
            EXPECT_NEAR(p, front, 0.36 * (rims - before)) << t * sound / length;
        }
    }
}

TEST(JointInflow, SlowGrowthAndFallsAreFollowedAtOnce)
{
    for (const double part : {0.01, 0.1, 1.0}) {
        EXPECT_EQ(spread_by_sound(100, 100 * (1 + part), part), 100 * (1 + part));
        EXPECT_EQ(spread_by_sound(100, 3, part), 3);
        EXPECT_EQ(spread_by_sound(100, 0, part), 0);
        EXPECT_LT(spread_by_sound(100, 1e4, part), 1e4);
        EXPECT_GT(spread_by_sound(0, 1e4, part), 0) << "a dry joint fills";
    }
}

// A bar on its bottom joint of some cells beside its centre, by Newton's second law for a force A p
// at the middle of the joint: A^2 (1/M + r^2/I), with the given locks.
TEST(JointInflow, TheMobilityIsThatOfARigidBody)
{
    std::mt19937 dice(6);
    std::uniform_real_distribution<double> part(0.2, 1);
    for (int k = 0; k < 40; ++k) {
        const double mass = 10 * part(dice);
        const double moment = part(dice);
        const double area = 0.1 * part(dice); // of a cell
        const double arm = part(dice) - 0.6;  // of the middle of the joint
        Rigid rigid;
        rigid.bodies.resize(1);
        Body& body = rigid.bodies[0];
        body.mass.mass = mass;
        body.mass.inertia = moment * Mat3::Identity();
        body.locks[4] = k % 3 == 1;
        body.locks[2] = k % 3 == 2;
        BodyJoints joints;
        joints.faces.faces.push_back({.first = 0, .last = 2});
        joints.faces.cells.assign(2, {.area = area});
        joints.joined.assign(1, 1);
        for (const double side : {-0.1, 0.1}) {
            joints.nodes.push_back({.other = -1,
                                    .opening = 1,
                                    .place = Vec3(arm + side, 0, -0.5),
                                    .normal = Vec3(0, 0, -1)});
        }
        const double push = body.locks[2] ? 0 : 1 / mass;
        const double turn = body.locks[4] ? 0 : arm * arm / moment;
        const double expected = 4 * area * area * (push + turn);
        EXPECT_NEAR(joint_mobility(joints, rigid, {Pose{}}, 0, joints.faces.faces[0]), expected,
                    1e-12 * expected);
    }
}

TEST(JointInflow, ColumnsOfOtherLengthsAreRefused)
{
    Seepage seepage;
    seepage.open = {1};
    seepage.joined = {{0, 0}};
    seepage.opening = {0.0};
    seepage.pressure = {0.0};
    EXPECT_THROW(restart_joints(seepage), IoError);
    seepage.inertia = {0.0};
    EXPECT_NO_THROW(restart_joints(seepage));
}

} // namespace
} // namespace hyoryu
