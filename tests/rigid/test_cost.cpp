// SPDX-License-Identifier: MIT
// What rests or slides steadily is planned in one pass: the work of a step, counted in updates of
// rows, which is the same on any machine.
#include "scenes.hpp"

#include "rigid/motion/sub_step.hpp"

#include <gtest/gtest.h>

namespace hyoryu::test_cost {
namespace {

using namespace test;

// The four corners of a box, planned once, and three looks at its pair: where the step begins, for
// an event, and where it ends.
constexpr double one_pass = 4 * plan_work + 3 * look_work;

// Work of the step that follows `steps` of a box with that speed along the floor.
double work_of_last_step(double speed, int steps)
{
    Rigid rigid = on_floor(0, 0.3);
    Body body = box({0.3, 0.2, 0.1}, 700, {0, 0, 0.05});
    body.velocity = {0.8 * speed, 0.6 * speed, 0};
    rigid.bodies.push_back(body);
    run(rigid, 1e-3, steps + 1, [](double) {});
    return rigid.memory->work;
}

TEST(Cost, ABoxAtRestIsPlannedOnce)
{
    EXPECT_LE(work_of_last_step(0, 10), one_pass);
}

TEST(Cost, ABoxThatSlidesSteadilyIsPlannedOnceAndNotSolvedAnew)
{
    EXPECT_LE(work_of_last_step(1, 10), one_pass);
}

} // namespace
} // namespace hyoryu::test_cost
