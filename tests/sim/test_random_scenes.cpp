// SPDX-License-Identifier: MIT
// Scenes drawn at random: whatever a scene holds, the numbers stay finite, nothing leaves the
// basin, solids do not overlap, energy does not grow and momentum closes. A scene follows from its
// seed alone; HYORYU_SCENES=1000 is the nightly size, HYORYU_SEED the first seed,
// HYORYU_SHOW=1 prints the cases.
#include "hyoryu/core/error.hpp"
#include "random_scene.hpp"
#include "runs.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cstdlib>

namespace hyoryu::test_random_scenes {
namespace {

using namespace random_scene;

double energy(const Totals& t)
{
    return t.fluid_kinetic + t.fluid_potential + t.fluid_internal + t.body_kinetic +
           t.body_potential;
}

double deepest_overlap(const Simulation& sim)
{
    double deepest = 0;
    const auto bodies = static_cast<int>(sim.rigid.bodies.size());
    for (int a = 0; a < bodies; ++a) {
        for (int b = -1; b < a; ++b) {
            deepest = std::max(deepest, overlap(sim.rigid, a, b, sim.clock.time));
        }
    }
    return deepest;
}

// Fluid beside or below the basin; what splashed over its rim is on its way out.
Index escaped(const Simulation& sim)
{
    constexpr double graze = 0.5 * spacing; // a particle is half a spacing wide
    const Rows rows = sim.fluid->particles.fluid.rows();
    const auto x = sim.fluid->particles.fluid[field::position];
    Index count = 0;
    for (Index i = rows.begin; i < rows.end; ++i) {
        const Vec3& p = x[static_cast<std::size_t>(i)];
        const bool inside = p.x() > -graze && p.x() < length + graze && p.z() > -graze;
        count += inside || p.z() > height ? 0 : 1;
    }
    return count;
}

void expect_sound(const Simulation& sim)
{
    const Totals now = totals(sim);
    const Totals& start = sim.conservation.start;
    // Everything falls: what there is to gain is potential energy over the floor, which `start`
    // holds in full. 1 % for the sums in floats and for the compression at the start.
    EXPECT_LE(energy(now), energy(start) + 0.01 * std::abs(energy(start)));
    // Half a spacing in passing, as impacts of a jam are not located in time, a tenth at rest: less
    // than the fluid can tell of a surface made of particles.
    EXPECT_LE(sim.rigid.counters.worst_penetration, 0.5 * spacing) << "solids, on the way";
    EXPECT_LE(deepest_overlap(sim), 0.1 * spacing) << "solids, at the end";
    if (sim.fluid) {
        EXPECT_EQ(escaped(sim), 0) << "particles through walls";
        EXPECT_EQ(sim.fluid->lost.count, 0);
        if (sim.fluid->parameters.formulation == FormulationKind::sph) { // MPS does not promise it
            EXPECT_LT(sim.conservation.worst_closure, 6e-8)
                << "half a unit of the last place of a float";
        }
    }
}

TEST(RandomScenes, StaySound)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_SCENES", 50);
    for (int seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE(fmt::format("HYORYU_SEED={} HYORYU_SCENES=1", seed));
        const std::string text = scene_of(static_cast<std::uint64_t>(seed));
        if (std::getenv("HYORYU_SHOW") != nullptr) {
            fmt::print("{}", text);
        }
        Simulation sim = make(text);
        try {
            while (!finished(sim.clock, sim.scene)) {
                step_on(sim);
            }
        } catch (const NumericalError& error) {
            ADD_FAILURE() << error.what();
        }
        expect_sound(sim);
    }
}

} // namespace
} // namespace hyoryu::test_random_scenes
