// SPDX-License-Identifier: MIT
#include "hyoryu/core/timer.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_timer {
namespace {

TEST(StageTimer, CountsTheStagesInTheOrderInWhichTheyWereMet)
{
    StageTimer timer;
    timer.begin("a");
    timer.begin("b");
    timer.begin("a");
    timer.end();
    timer.end();
    ASSERT_EQ(timer.stages().size(), 2u);
    EXPECT_EQ(timer.stages()[0].name, "a");
    EXPECT_EQ(timer.stages()[0].calls, 2);
    EXPECT_EQ(timer.stages()[1].calls, 1);
    EXPECT_GE(timer.stages()[0].seconds, 0);
}

// A run that recovers goes on with the timer of the one that failed in the middle of a stage.
TEST(StageTimer, ACopyOfARunningTimerCountsInItsOwnStages)
{
    StageTimer copy;
    {
        StageTimer timer;
        timer.begin("a");
        copy = timer;
        copy.end();
        EXPECT_EQ(timer.stages()[0].calls, 0);
    }
    EXPECT_EQ(copy.stages()[0].calls, 1);
}

} // namespace
} // namespace hyoryu::test_timer
