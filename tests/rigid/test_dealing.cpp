// SPDX-License-Identifier: MIT
// Ranks that deal out the bodies come to the bits of one process: motion, log, counters, and the
// forces that the next step starts with.
#include "../thread_ranks.hpp"
#include "dice.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>

namespace hyoryu::test_dealing {
namespace {

using namespace test;

// Heaps that fall apart, into each other, over a floor and onto bodies that do not move, which they
// share; some bodies fly alone.
Rigid heaps(int seed)
{
    Dice dice(seed);
    const double friction = dice.between(0, 0.6);
    Rigid rigid = on_floor(friction, dice.between(0, 0.6));
    rigid.settings.located_work = dice.between(0, 1) < 0.5 ? 0 : 1e5;
    const int count = static_cast<int>(dice.between(2, 9));
    for (int heap = 0; heap < count; ++heap) {
        const Vec3 place{dice.between(-3, 3), dice.between(-3, 3), 0};
        const int bodies = static_cast<int>(dice.between(2, 14));
        for (int k = 0; k < bodies; ++k) {
            const Vec3 at =
                place + Vec3{dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), 0.3 + 0.35 * k};
            const double size = dice.between(0.1, 0.3);
            Body body = dice.between(0, 1) < 0.3
                            ? body_of(Ball{size / 2}, 600, at)
                            : box(Vec3(size, 0.2, dice.between(0.1, 0.3)), 600, at);
            body.orientation = dice.turn();
            body.velocity = dice.within(1.5);
            rigid.bodies.push_back(std::move(body));
        }
    }
    for (int k = static_cast<int>(dice.between(0, 4)); k > 0; --k) {
        Body table = box(Vec3(2, 2, 0.2), 600, {dice.between(-3, 3), dice.between(-3, 3), 0.15});
        table.locks.fill(true);
        rigid.bodies.push_back(std::move(table));
    }
    return rigid;
}

using Numbers = std::vector<std::uint64_t>;

void add(Numbers& numbers, double value)
{
    numbers.push_back(std::bit_cast<std::uint64_t>(value));
}

void add(Numbers& numbers, const Vec3& v)
{
    for (const double value : v) {
        add(numbers, value);
    }
}

Numbers numbers_of(const Rigid& rigid, const std::vector<Contact>& log)
{
    Numbers numbers;
    for (const Body& body : rigid.bodies) {
        add(numbers, body.position);
        add(numbers, body.velocity);
        add(numbers, body.angular_momentum);
        for (const double value : body.orientation.coeffs()) {
            add(numbers, value);
        }
    }
    for (const Contact& c : log) {
        numbers.insert(numbers.end(),
                       {static_cast<std::uint64_t>(c.kind), static_cast<std::uint64_t>(c.a),
                        static_cast<std::uint64_t>(c.b), static_cast<std::uint64_t>(c.located)});
        for (const double value : {c.time, c.approach_speed, c.normal_impulse, c.effective_mass,
                                   c.energy_lost, c.depth}) {
            add(numbers, value);
        }
        for (const Vec3& v : {c.point, c.normal, c.tangential_impulse}) {
            add(numbers, v);
        }
    }
    const RigidCounters& c = rigid.counters;
    for (const long long count :
         {c.impacts, c.rounds, c.events, c.tangential_impacts, c.capped_steps}) {
        numbers.push_back(static_cast<std::uint64_t>(count));
    }
    add(numbers, c.worst_residual);
    add(numbers, c.worst_penetration);
    const ContactStart start = contact_start(rigid);
    for (const std::array<int, 9>& feature : start.features) {
        numbers.insert(numbers.end(), feature.begin(), feature.end());
    }
    for (std::size_t k = 0; k < start.forces.size(); ++k) {
        add(numbers, start.forces[k]);
        add(numbers, start.places[k]);
        add(numbers, start.rubs[k]);
        numbers.push_back(static_cast<std::uint64_t>(start.stuck[k]));
    }
    return numbers;
}

Numbers outcome(int seed, double dt, Comm* comm)
{
    Rigid rigid = heaps(seed);
    const std::vector<Wrench> loads(rigid.bodies.size());
    std::vector<Contact> log;
    for (int k = 0; k < 150; ++k) {
        step(rigid, k * dt, dt, loads, log, comm);
    }
    return numbers_of(rigid, log);
}

// HYORYU_SCENES=300 is the nightly size, HYORYU_SEED the first seed.
TEST(Dealing, RanksComeToTheBitsOfOneProcess)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_SCENES", 12);
    long long calls = 0;
    for (int seed = first; seed < first + count; ++seed) {
        const double dt = std::array{1e-3, 4e-3, 1e-2}[static_cast<std::size_t>(seed % 3)];
        const Numbers one = outcome(seed, dt, nullptr);
        for (const int ranks : {2, 3, 5}) {
            std::vector<Numbers> many(static_cast<std::size_t>(ranks));
            test_help::on_ranks(ranks, [&](CountedComm& comm) {
                many[static_cast<std::size_t>(comm.rank())] = outcome(seed, dt, &comm);
                if (comm.rank() == 0) {
                    calls += comm.traffic().calls;
                }
            });
            for (const Numbers& numbers : many) {
                EXPECT_TRUE(numbers == one) << "HYORYU_SEED=" << seed << ", " << ranks << " ranks";
            }
        }
    }
    EXPECT_GT(calls, 50 * count) << "too little was dealt out to show anything";
}

// A body that flies, or a crate that lies alone, is not worth a message.
TEST(Dealing, LittleWorkIsNotDealtOut)
{
    test_help::on_ranks(3, [](CountedComm& comm) {
        Rigid rigid = on_floor(0.3, 0.3);
        for (int k = 0; k < 3; ++k) {
            rigid.bodies.push_back(box(Vec3::Constant(0.2), 500, {1.0 * k, 0, 0.1 + k}));
        }
        const std::vector<Wrench> loads(rigid.bodies.size());
        std::vector<Contact> log;
        for (int k = 0; k < 50; ++k) {
            step(rigid, k * 1e-3, 1e-3, loads, log, &comm);
        }
        EXPECT_EQ(comm.traffic().calls, 0);
    });
}

} // namespace
} // namespace hyoryu::test_dealing
