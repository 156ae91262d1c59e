// SPDX-License-Identifier: MIT
// Numbers of neighbours as steps of a byte: every number comes back, and what is between and behind
// them is nothing.
#include "core/list_steps.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hyoryu::test_list_steps {
namespace {

constexpr std::size_t chunks = 200; // the last one is nothing

bool is_nothing(int number)
{
    const int chunk = number / chunk_slots;
    return number % chunk_slots == 0 &&
           (chunk % padding_period == padding_period - 1 || chunk + 1 == int(chunks));
}

std::vector<int> steps_to(const std::vector<int>& numbers, int lanes)
{
    std::vector<std::uint16_t> room(numbers.begin(), numbers.end());
    room.resize(numbers.size() + steps_together);
    std::vector<std::uint8_t> steps(chunks * chunk_slots + std::size_t(lanes) + steps_together);
    const std::size_t made = write_steps(room.data(), numbers.size(), chunks, lanes, steps.data());
    return {steps.begin(), steps.begin() + std::ptrdiff_t(made)};
}

// All numbers that the steps lead to.
std::vector<int> sums(int number, const std::vector<int>& steps)
{
    std::vector<int> all;
    for (const int step : steps) {
        all.push_back(number += step);
    }
    return all;
}

using Steps = std::vector<int>;

TEST(ListSteps, AListOfNothingHasNone)
{
    EXPECT_EQ(steps_to({}, 16), Steps{});
}

TEST(ListSteps, FillUpToWholePacks)
{
    // Chunk 30 is nothing: number 240. Behind the last such, 1480, comes the last of all, 1592.
    EXPECT_EQ(steps_to({3}, 1), (Steps{0}));
    EXPECT_EQ(steps_to({3}, 4), (Steps{0, 237, 0, 0}));
    EXPECT_EQ(steps_to({3, 5, 12, 13}, 4), (Steps{0, 2, 7, 1}));
    EXPECT_EQ(steps_to({3, 5, 12, 13, 14}, 4), (Steps{0, 2, 7, 1, 1, 226, 0, 0}));
    EXPECT_EQ(steps_to({1591}, 2), (Steps{0, 1}));
    EXPECT_EQ(steps_to({1479}, 2), (Steps{0, 113}));
    EXPECT_EQ(steps_to({7}, 8).size(), 8U);
}

TEST(ListSteps, GoOverNothingWhereOneByteIsNotEnough)
{
    EXPECT_EQ(steps_to({0, 255}, 2), (Steps{0, 255}));
    EXPECT_EQ(steps_to({0, 256}, 1), (Steps{0, 240, 16}));
    EXPECT_EQ(steps_to({232, 488 - 1}, 2), (Steps{0, 255}));
    EXPECT_EQ(steps_to({232, 488 + 1}, 1), (Steps{0, 8, 249}));
    EXPECT_EQ(steps_to({233, 488 + 1}, 1), (Steps{0, 255, 1}));
    EXPECT_EQ(steps_to({0, 1500}, 1), (Steps{0, 240, 248, 248, 248, 248, 248, 20}));
    EXPECT_EQ(steps_to({0, 1500}, 4), (Steps{0, 240, 248, 248, 248, 248, 248, 20}));
}

TEST(ListSteps, AreTheSameWhereverTheWideOneStands)
{
    for (int before = 1; before <= 40; ++before) {
        Steps numbers;
        Steps expected;
        for (int k = 0; k < before; ++k) {
            numbers.push_back(k);
            expected.push_back(k == 0 ? 0 : 1);
        }
        numbers.insert(numbers.end(), {500, 501, 1000, 1001});
        const int nothing = (before - 1 + 15) / 248 * 248 + 240;
        const int wide = 500 - nothing;
        if (wide > 255) {
            expected.insert(expected.end(), {nothing - (before - 1), 248, 12, 1});
        } else {
            expected.insert(expected.end(), {nothing - (before - 1), wide, 1});
        }
        expected.insert(expected.end(), {736 - 501, 248, 16, 1});
        EXPECT_EQ(steps_to(numbers, 1), expected) << before;
    }
}

TEST(ListSteps, EveryNumberComesBackAndAllElseIsNothing)
{
    std::mt19937 random(3);
    for (int round = 0; round < 400; ++round) {
        const double share = std::exp2(-1 - round % 10);
        std::vector<int> numbers;
        for (int number = 0; number < int(chunks) * chunk_slots; ++number) {
            const int chunk = number / chunk_slots;
            if (chunk % padding_period != padding_period - 1 && chunk + 1 < int(chunks) &&
                std::uniform_real_distribution<double>(0, 1)(random) < share) {
                numbers.push_back(number);
            }
        }
        const int lanes = 2 << round % 4;
        const std::vector<int> steps = steps_to(numbers, lanes);
        EXPECT_EQ(steps.size() % std::size_t(lanes), 0U);
        std::vector<int> reached = sums(numbers.empty() ? 0 : numbers[0], steps);
        std::erase_if(reached, is_nothing);
        EXPECT_EQ(reached, numbers);
    }
}

} // namespace
} // namespace hyoryu::test_list_steps
