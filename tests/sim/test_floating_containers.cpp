// SPDX-License-Identifier: MIT
// A 20-foot container of the library in water: with its cargo at the bottom it stays upright, with
// the same cargo at the top it rolls over, as the sign of the metacentric height says.
#include "dice.hpp"
#include "runs.hpp"

#include "hyoryu/scene/debris.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu::test_floating_containers {
namespace {

constexpr double level = 2.4; // [m]

BodySettings loaded_container(double load_height)
{
    const auto kinds = debris_library();
    const auto kind = std::ranges::find(kinds, "container_20ft", &DebrisKind::name);
    return debris_piece({.kind = static_cast<std::size_t>(kind - kinds.begin()),
                         .load = 12000,
                         .load_height = load_height},
                        3)
        .body;
}

// The container at its draft in a pool, rolled by an angle about its long axis.
Simulation floating(const BodySettings& body, double draft, double rolled_deg, double spacing)
{
    const Vec3 size = std::get<BoxShape>(body.shape).size;
    const Vec3 c = *body.centre_of_mass;
    const Vec3 i = *body.inertia;
    return make(fmt::format(
        "[time]\nend = 10\n[particles]\nspacing = {}\n[fluid]\n[[fluid.block]]\nshape = \"box\"\n"
        "min = [0, 0, 0]\nmax = [8, 5, {}]\n[[wall]]\nshape = \"basin\"\nmin = [0, 0, 0]\n"
        "max = [8, 5, 6]\nopen = [\"+z\"]\n[[body]]\nshape = \"box\"\nsize = [{}, {}, {}]\n"
        "mass = {}\ncenter_of_mass = [{}, {}, {}]\ninertia = [{}, {}, {}]\nposition = [4, 2.5, "
        "{}]\n"
        "rotation_deg = {{ axis = [1, 0, 0], angle = {} }}\n",
        spacing, level, size.x(), size.y(), size.z(), body.mass, c.x(), c.y(), c.z(), i.x(), i.y(),
        i.z(), level - draft + size.z() / 2 + c.z(), rolled_deg));
}

double tilt_deg(const Simulation& sim)
{
    const Vec3 up = sim.rigid.bodies[0].orientation * Vec3::UnitZ();
    return std::acos(std::clamp(up.z(), -1.0, 1.0)) * 180 / std::numbers::pi;
}

TEST(FloatingContainers, StandOrRollOverByTheirMetacentricHeight)
{
    Dice dice(81);
    for (const double spacing : {0.4, 0.35}) {
        for (const bool low : {true, false}) {
            const double share = dice.between(0.2, 0.3); // of the height, from below or from above
            const BodySettings body = loaded_container(low ? share : 1 - share);
            const Vec3 size = std::get<BoxShape>(body.shape).size;
            const double draft = body.mass / (1000 * size.x() * size.y());
            const double gm =
                sq(size.y()) / (12 * draft) + draft / 2 - (size.z() / 2 + body.centre_of_mass->z());
            ASSERT_EQ(gm > 0, low);
            Simulation sim = floating(body, draft, 5, spacing);
            const double height = sim.rigid.bodies[0].position.z();
            double most = 0;
            double heave = 0;
            while (sim.clock.time < 2.5) {
                step_on(sim);
                most = std::max(most, tilt_deg(sim));
                heave = std::max(heave, std::abs(sim.rigid.bodies[0].position.z() - height));
            }
            EXPECT_EQ(most > 90, gm < 0) << spacing << ' ' << share;
            if (gm > 0) {
                EXPECT_LT(most, 6);            // let go at 5 degrees; one for the jolt of the start
                EXPECT_LT(heave, spacing / 4); // it starts at its draft: 0.16 spacings of settling
            }
        }
    }
}

} // namespace
} // namespace hyoryu::test_floating_containers
