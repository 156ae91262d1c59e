// SPDX-License-Identifier: MIT
// A step of the fluid takes no memory once it has warmed up.
#include "hyoryu/core/parallel.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long long> allocations{0};

} // namespace

// Every allocation of this test program passes here; those of Eigen do not, whose dynamic matrices
// no fluid uses.
void* operator new(std::size_t size)
{
    allocations += 1;
    if (void* memory = std::malloc(size)) {
        return memory;
    }
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept // as std::stable_sort does
{
    allocations += 1;
    return std::malloc(size);
}
void operator delete(void* memory) noexcept
{
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
    std::free(memory);
}

namespace hyoryu::test_allocations {
namespace {

// By one thread: which of several is dealt a larger piece of the lists than it had before, and
// makes its room larger, is decided by what else the machine does.
TEST(Allocations, NoneInAStepOfTheFluid)
{
    set_threads(1);
    const Scene scene = parse_case(R"(
[time]
end = 10.0
[particles]
spacing = 0.05
[fluid]
[[fluid.block]]
shape = "box"
min = [0.0, 0.0, 0.0]
max = [0.6, 0.6, 0.6]
[[wall]]
shape = "basin"
min = [0.0, 0.0, 0.0]
max = [2.0, 0.6, 1.0]
open = ["+z"]
)",
                                   "test.toml");
    const Filling filling = fill(scene);
    Simulation sim = make_simulation(scene, make_plan(scene, filling), filling);
    const auto advance = [&](int steps) {
        for (int k = 0; k < steps; ++k) {
            step(sim);
            sim.clock.frame += frame_due(sim.clock, sim.scene) ? 1 : 0;
        }
    };
    advance(1500); // until the fluid has been everywhere: only its spreading takes memory
    const long long before = allocations;
    const long long builds = sim.fluid->neighbours.builds;
    advance(100);
    EXPECT_GT(sim.fluid->neighbours.builds, builds); // lists were made in these steps
    EXPECT_EQ(allocations, before);
    set_threads(0);
}

} // namespace
} // namespace hyoryu::test_allocations
