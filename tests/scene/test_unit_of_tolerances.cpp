// SPDX-License-Identifier: MIT
// The unit in which contact takes lengths for nothing, by the bodies of the scene.
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/rigid_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace hyoryu::test_unit_of_tolerances {
namespace {

// One cube of the given edge at the given height [m].
RigidSettings settings_of(double edge, double height)
{
    return make_rigid(
               parse_case(fmt::format("[time]\nend = 1\n[particles]\nspacing = {0}\n"
                                      "[[wall]]\nshape = \"plane\"\n[[body]]\nshape = \"box\"\n"
                                      "size = [{1}, {1}, {1}]\ndensity = 500\n"
                                      "position = [0, 0, {2}]\n",
                                      edge / 5, edge, height),
                          "case.toml"))
        .settings;
}

TEST(UnitOfTolerances, IsTheMetreForBodiesOfCentimetresToTensOfMetres)
{
    for (const double edge : {0.02, 0.1, 1.0, 30.0}) {
        const RigidSettings settings = settings_of(edge, edge);
        EXPECT_EQ(settings.unit, 1) << edge;
        EXPECT_EQ(settings.contact_tolerance, RigidSettings{}.contact_tolerance);
        EXPECT_EQ(settings.resting_speed, RigidSettings{}.resting_speed);
    }
}

TEST(UnitOfTolerances, IsTheMillimetreWhereAllIsSmallAndTheKilometreWhereAllBodiesAreLarge)
{
    EXPECT_DOUBLE_EQ(settings_of(1e-4, 1e-4).unit, 1e-3);
    EXPECT_DOUBLE_EQ(settings_of(100, 100).unit, 1e3);
    EXPECT_DOUBLE_EQ(settings_of(100, 100).contact_tolerance, 1e-4);
    EXPECT_DOUBLE_EQ(settings_of(1e-4, 1e-4).resting_speed, 1e-3 * std::sqrt(1e-3));
}

// Positions of a metre have the round-off of a metre, however small the body.
TEST(UnitOfTolerances, IsTheMetreForASmallBodyFarFromTheOrigin)
{
    EXPECT_EQ(settings_of(1e-3, 2).unit, 1);
}

} // namespace
} // namespace hyoryu::test_unit_of_tolerances
