// SPDX-License-Identifier: MIT
// Solids that roll and rock on a plane at random, coins that wobble among them: motion that
// friction hardly takes energy from, and towers whose contacts are solved roughly: neither the
// contacts nor the projection of gaps may give them any. HYORYU_MEETINGS=500 runs that many of each
// family, HYORYU_SEED is the first.
#include "dice.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyoryu::test_energy {
namespace {

using namespace test;

ContactShape rocker(int seed, Dice& dice)
{
    switch (seed % 4) {
    case 0:
        return Rod{dice.between(0.03, 0.1), dice.between(0.05, 0.3)};
    case 1:
        return Rod{dice.between(0.05, 0.1), dice.between(0.01, 0.03)}; // a coin
    case 2:
        return box_polytope({dice.between(0.1, 0.3), 0.1, dice.between(0.1, 0.3)}, 3);
    default:
        return random_hull(dice, 0.12);
    }
}

/// One solid just above the plane z = 0, aslant and turning.
Rigid rocking(int seed)
{
    Dice dice(seed);
    const double friction = dice.between(0, 0.4);
    Rigid rigid = on_floor(friction, dice.between(0.2, 1));
    const ContactShape solid = rocker(seed, dice);
    Body body = body_of(solid, dice.between(200, 900), {0, 0, 1});
    body.orientation = dice.turn();
    body.velocity = dice.within(0.3);
    body.angular_momentum = angular_momentum(body, dice.within(8));
    rigid.bodies.push_back(body);
    rigid.bodies[0].position.z() = 1.001 + overlap(rigid, 0, -1, 0);
    return rigid;
}

// The gain of energy since it was least, as a part of that at the start, with the energy of a force
// and seen from walls that move.
double gain(Rigid& rigid, double dt, const Wrench& load, const Vec3& walls)
{
    const auto now = [&](double t) {
        Body seen = rigid.bodies[0];
        seen.position -= t * walls;
        seen.velocity -= walls;
        const Vec3 weight = seen.mass.mass * rigid.settings.gravity + load.force;
        return kinetic_energy(seen) - weight.dot(seen.position);
    };
    const double start = now(0);
    double least = start;
    double most = 0;
    std::vector<Contact> log;
    for (int k = 0; k < static_cast<int>(0.6 / dt); ++k) {
        step(rigid, k * dt, dt, {&load, 1}, log);
        const double energy = now((k + 1) * dt);
        most = std::max(most, (energy - least) / start);
        least = std::min(least, energy);
    }
    return most;
}

// Each of some hundred sub-steps may gain a millionth, and a coin that is nearly flat is lifted by
// the contact tolerance, 1e-7 m, where its contact jumps along the rim.
constexpr double most_gain = 1e-4;

void expect_no_gain(const Vec3& walls, double loaded)
{
    const int first = number_from("HYORYU_SEED", 1);
    for (int seed = first; seed < first + number_from("HYORYU_MEETINGS", 40); ++seed) {
        for (const double dt : {1e-3, 5e-3}) {
            Rigid rigid = rocking(seed);
            Body& body = rigid.bodies[0];
            rigid.boundaries[0].motion.velocity = walls;
            body.velocity += walls;
            const Wrench load{loaded * body.mass.mass * rigid.settings.gravity};
            rigid.settings.gravity *= 1 - loaded;
            EXPECT_LT(gain(rigid, dt, load, walls), most_gain)
                << "HYORYU_SEED=" << seed << " dt " << dt;
        }
    }
}

TEST(Energy, NothingRocksOrRollsItselfUp)
{
    expect_no_gain(Vec3::Zero(), 0);
}

TEST(Energy, NorDoesItUnderALoadOnAFloorThatMoves)
{
    expect_no_gain({3, 1, 0.5}, 0.7);
}

/// A tower of boxes that grow heavier upwards, each turned over the one below, on a slope: to
/// locate all its impacts exceeds the budget of a step.
Rigid heavy_tower(int seed)
{
    Dice dice(seed);
    const double friction = dice.between(0, 0.8);
    Rigid rigid = on_floor(friction, dice.between(0, 0.9));
    rigid.settings.gravity = turn_about(Vec3(1, 0, 0), dice.between(0, 20)) * Vec3(0, 0, -g);
    const int levels = 6 + static_cast<int>(dice.between(0, 7));
    const double ratio = dice.between(1, 2.5);
    double density = 300;
    double height = 0;
    for (int k = 0; k < levels; ++k) {
        const Vec3 size = Vec3::Constant(0.225) + dice.within(0.075);
        const Vec3 place{dice.between(-0.02, 0.02), dice.between(-0.02, 0.02), height};
        Body body = box(size, std::min(density, 20000.0), place + 0.5 * size.z() * Vec3::UnitZ());
        body.orientation = turn_about(Vec3(0, 0, 1), dice.between(0, 360));
        rigid.bodies.push_back(body);
        height += size.z();
        density *= ratio;
    }
    return rigid;
}

// The bound of random scenes, as a part of the energy at the start, which has the height over the
// floor.
constexpr double most_rise = 1e-5;

// What a step may lift all bodies by, 1e-9 m for each of up to a hundred sub-steps, beyond what a
// sub-step may gain of the kinetic energy, a millionth each [m].
constexpr double most_lift = 1e-7;
constexpr double part_of_motion = 1e-4;

double kinetic(const Rigid& rigid)
{
    double sum = 0;
    for (const Body& body : rigid.bodies) {
        sum += kinetic_energy(body);
    }
    return sum;
}

double weight(const Rigid& rigid)
{
    double mass = 0;
    for (const Body& body : rigid.bodies) {
        mass += body.mass.mass;
    }
    return mass * rigid.settings.gravity.norm();
}

bool is_idle(const Contact& contact)
{
    return contact.kind == Contact::Kind::impact && contact.normal_impulse == 0 &&
           contact.tangential_impulse == Vec3(0, 0, 0);
}

TEST(Energy, NorDoTowersThatAreTooCostlyToLocate)
{
    const int first = number_from("HYORYU_SEED", 1);
    long long unlocated = 0;
    for (int seed = first; seed < first + number_from("HYORYU_MEETINGS", 6); ++seed) {
        for (const double dt : {2e-3, 5e-3}) {
            Rigid rigid = heavy_tower(seed);
            const double start = energy(rigid);
            double least = start;
            double rise = 0;
            double lift = 0;
            double last = start;
            const auto log = run(rigid, dt, static_cast<int>(0.1 / dt), [&](double) {
                const double now = energy(rigid);
                rise = std::max(rise, (now - least) / start);
                least = std::min(least, now);
                lift =
                    std::max(lift, (now - last - part_of_motion * kinetic(rigid)) / weight(rigid));
                last = now;
            });
            EXPECT_LT(lift, most_lift) << "HYORYU_SEED=" << seed << " dt " << dt;
            EXPECT_TRUE(std::ranges::none_of(log, is_idle)) << "a row without an impulse";
            EXPECT_LT(rise, most_rise) << "HYORYU_SEED=" << seed << " dt " << dt;
            unlocated += rigid.counters.capped_steps;
        }
    }
    EXPECT_GT(unlocated, 0);
}

} // namespace
} // namespace hyoryu::test_energy
