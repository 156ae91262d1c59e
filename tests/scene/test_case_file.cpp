// SPDX-License-Identifier: MIT
// Good cases: what is read, which defaults are filled in, and that a written case reads back.
#include "test_case_file_support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>

namespace hyoryu::test_case_file {

namespace {

bool same_bits(double a, double b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

bool same_bits(const Vec3& a, const Vec3& b)
{
    return std::memcmp(a.data(), b.data(), 3 * sizeof(double)) == 0;
}

bool same_bits(const Quat& a, const Quat& b)
{
    return std::memcmp(a.coeffs().data(), b.coeffs().data(), 4 * sizeof(double)) == 0;
}

} // namespace

TEST(CaseFile, ReadsEveryKey)
{
    const Scene scene = parse_case(full_case, "case.toml");
    EXPECT_EQ(scene.title, "Bore with \"timbers\" against a house");
    EXPECT_EQ(scene.seed, 7u);
    EXPECT_EQ(scene.time.step, 0.001);
    EXPECT_EQ(scene.domain->max, Vec3(8, 1, 1.5));
    ASSERT_TRUE(scene.fluid);
    EXPECT_EQ(scene.fluid->sound_speed, 30.0);
    EXPECT_EQ(scene.fluid->smoothing_ratio, 1.4);
    ASSERT_EQ(scene.fluid->blocks.size(), 3u);
    EXPECT_EQ(std::get<BoxShape>(scene.fluid->blocks[0].shape).size, Vec3(1.5, 1.0, 0.8));
    EXPECT_EQ(scene.fluid->blocks[0].centre, Vec3(0.75, 0.5, 0.4));
    EXPECT_EQ(std::get<CylinderShape>(scene.fluid->blocks[2].shape).length, 0.3);
    ASSERT_EQ(scene.walls.size(), 5u);
    EXPECT_NEAR(std::get<PlaneWall>(scene.walls[0].geometry).normal.norm(), 1, 1e-15);
    const std::array<bool, 6> lid_open{false, false, false, false, false, true};
    EXPECT_EQ(std::get<BasinWall>(scene.walls[1].geometry).open, lid_open);
    EXPECT_EQ(scene.walls[3].name, "wall.4");
    ASSERT_EQ(scene.bodies.size(), 8u);
    EXPECT_TRUE(scene.bodies[6].fixed);
    EXPECT_EQ(scene.contact.law, ImpactLaw::simultaneous);
    EXPECT_EQ(scene.contact.locating_share, 0.35);
    EXPECT_FALSE(scene.contact.penalty);
    ASSERT_EQ(scene.contact.pairs.size(), 1u);
    EXPECT_EQ(scene.contact.pairs[0].stiffness, 2.4e6);
    ASSERT_EQ(scene.gauges.size(), 5u);
    EXPECT_EQ(scene.gauges[3].on, "timber.6");
    EXPECT_EQ(scene.output.fields.size(), 2u);
}

TEST(CaseFile, FillsInTheDefaults)
{
    const Scene scene = parse_case(short_case, "case.toml");
    EXPECT_EQ(scene.dimensions, 3);
    EXPECT_EQ(scene.gravity, Vec3(0, 0, -9.81));
    EXPECT_EQ(scene.time.cfl, 0.6);
    EXPECT_FALSE(scene.time.step);
    EXPECT_FALSE(scene.domain);
    EXPECT_EQ(scene.fluid->density, 1000);
    EXPECT_EQ(std::get<ArtificialViscosity>(scene.fluid->effects[slot::viscosity]).alpha, 0.02);
    EXPECT_EQ(std::get<FourtakasDiffusion>(scene.fluid->effects[slot::diffusion]).delta, 0.1);
    EXPECT_EQ(scene.fluid->smoothing_ratio, 1.5);
    EXPECT_EQ(scene.contact.restitution, 0.4);
    EXPECT_EQ(scene.contact.friction, 0.3);
    EXPECT_EQ(scene.output.every, 0.01);
    EXPECT_EQ(scene.output.checkpoint_every, 600);
}

TEST(CaseFile, WritesCopiesOutWithXFastest)
{
    const Scene scene = parse_case(full_case, "case.toml");
    EXPECT_EQ(scene.bodies[0].name, "timber.1");
    EXPECT_EQ(scene.bodies[1].name, "timber.2");
    EXPECT_EQ(scene.bodies[1].position, Vec3(3.0 + 1.2, 0.5, 0.45));
    EXPECT_EQ(scene.bodies[2].position, Vec3(3.0, 0.5 + 0.3, 0.45));
    EXPECT_EQ(scene.bodies[5].name, "timber.6");
    EXPECT_EQ(scene.bodies[6].name, "body.2");
}

TEST(CaseFile, DerivesMassOrDensityFromTheShape)
{
    const Scene scene = parse_case(full_case, "case.toml");
    EXPECT_NEAR(scene.bodies[0].mass, 5.2, 1e-12);
    EXPECT_NEAR(scene.bodies[6].density, 3.7 / (4.0 / 3.0 * std::numbers::pi * std::pow(0.13, 3)),
                1e-9);
    EXPECT_NEAR(scene.bodies[7].density, 37 / (std::numbers::pi * sq(0.13) * 0.71), 1e-9);
}

TEST(CaseFile, ReadsTwoDimensionsPerMetreOfWidth)
{
    const std::string text = R"(dimensions = 2
[time]
end = 1
[particles]
spacing = 0.1
[[body]]
shape = "box"
size = [2, 77, 0.5]
density = 500
position = [0, 3, 1]
velocity = [1, 5, 0]
rotation_deg = { angle = 90 }
[[body]]
shape = "sphere"
radius = 0.5
density = 500
position = [5, 0, 1]
[[body]]
shape = "cylinder"
radius = 0.1
length = 2
mass = "100 kg/m"
position = [9, 0, 1]
)";
    const Scene scene = parse_case(text, "case.toml");
    EXPECT_EQ(scene.bodies[0].mass, 500);
    EXPECT_EQ(scene.bodies[0].position, Vec3(0, 0, 1));
    EXPECT_EQ(scene.bodies[0].velocity, Vec3(1, 0, 0));
    EXPECT_NEAR(scene.bodies[0].rotation.y(), std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(scene.bodies[1].mass, 500 * std::numbers::pi * 0.25, 1e-10);
    EXPECT_NEAR(scene.bodies[2].density, 250, 1e-10);
    const std::string written = to_toml(scene);
    EXPECT_EQ(to_toml(parse_case(written, "case.toml")), written);
}

TEST(CaseFile, NormalsOfGaugesSurviveWriting)
{
    const std::string text = R"(
dimensions = 2
[time]
end = 1
[particles]
spacing = 0.1
[[fluid.block]]
shape = "box"
min = [0, 0, 0]
max = [1, 0, 1]
[[gauge]]
type = "flux"
at = [1, 0, 0]
normal = [1, 0, 0.5]
)"; // its unit vector, made a unit vector once more, differs in the last bit
    const std::string written = to_toml(parse_case(text, "case.toml"));
    EXPECT_EQ(to_toml(parse_case(written, "case.toml")), written);
}

TEST(CaseFile, WrittenCaseReadsBackBitByBit)
{
    const Scene scene = parse_case(full_case, "case.toml");
    const std::string written = to_toml(scene);
    const Scene again = parse_case(written, "case.toml");
    EXPECT_EQ(to_toml(again), written);
    EXPECT_EQ(again.title, scene.title);
    EXPECT_TRUE(same_bits(again.fluid->blocks[2].centre, scene.fluid->blocks[2].centre));
    EXPECT_TRUE(same_bits(again.fluid->blocks[2].rotation, scene.fluid->blocks[2].rotation));
    EXPECT_TRUE(same_bits(std::get<PlaneWall>(again.walls[0].geometry).normal,
                          std::get<PlaneWall>(scene.walls[0].geometry).normal));
    EXPECT_TRUE(same_bits(std::get<SolidWall>(again.walls[3].geometry).rotation,
                          std::get<SolidWall>(scene.walls[3].geometry).rotation));
    ASSERT_EQ(again.bodies.size(), scene.bodies.size());
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        const BodySettings& a = again.bodies[k];
        const BodySettings& b = scene.bodies[k];
        EXPECT_EQ(a.name, b.name);
        EXPECT_TRUE(same_bits(a.density, b.density) && same_bits(a.mass, b.mass)) << b.name;
        EXPECT_TRUE(same_bits(a.position, b.position) && same_bits(a.rotation, b.rotation))
            << b.name;
        EXPECT_EQ(a.locks, b.locks);
        EXPECT_EQ(a.fixed, b.fixed);
        EXPECT_EQ(a.spacing, b.spacing);
        EXPECT_EQ(a.material, b.material);
    }
    EXPECT_EQ(again.output.every, scene.output.every);
    EXPECT_EQ(again.output.fields, scene.output.fields);
}

TEST(CaseFile, PenaltyMethodIsReadAndWritten)
{
    const std::string text = short_case + "[contact]\nmethod = \"penalty\"\nrestitution = 0.75\n"
                                          "[contact.penalty]\nstiffness = \"2 kN/m\"\n"
                                          "damping = \"0.1 N s/m\"\n";
    const Scene scene = parse_case(text, "case.toml");
    ASSERT_TRUE(scene.contact.penalty);
    EXPECT_EQ(scene.contact.penalty->stiffness, 2000);
    EXPECT_EQ(scene.contact.penalty->damping, 0.1);
    EXPECT_EQ(scene.contact.penalty->step, 1e-5);
    EXPECT_EQ(scene.contact.restitution, 0.75); // kept for runs by the other method
    const std::string written = to_toml(scene);
    EXPECT_EQ(to_toml(parse_case(written, "case.toml")), written);
    // the same case by the other method, as a study runs it
    const Scene other = parse_case(short_case + "[contact]\nrestitution = 0.75\n", "case.toml",
                                   {"contact.method=\"penalty\""});
    EXPECT_TRUE(other.contact.penalty);
}

TEST(CaseFile, AwkwardNumbersSurviveWriting)
{
    // Numbers with long decimals, and a zero with a sign: each must come back with the same bits.
    std::uint64_t state = 12345;
    for (int n = 0; n < 300; ++n) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        Scene scene = parse_case(short_case, "case.toml");
        scene.gravity.x() = std::ldexp(static_cast<double>(state >> 11), n % 80 - 60);
        scene.gravity.y() = -0.0;
        const Scene again = parse_case(to_toml(scene), "case.toml");
        EXPECT_TRUE(same_bits(again.gravity, scene.gravity));
    }
}

TEST(CaseFile, OverridesReplaceAndAddKeys)
{
    const Scene scene =
        parse_case(full_case, "case.toml",
                   {"fluid.density=1025", "body[1].radius = 0.2", "time.end=\"2 min\"",
                    "particles.spacing=5 cm", "fluid.viscosity={model=\"laminar\"}",
                    "output.fields=[\"density\"]", "title=flood"});
    EXPECT_EQ(scene.fluid->density, 1025);
    EXPECT_EQ(std::get<SphereShape>(scene.bodies[6].shape).radius, 0.2);
    EXPECT_EQ(scene.time.end, 120);
    EXPECT_EQ(scene.spacing, 0.05);
    EXPECT_TRUE(std::holds_alternative<LaminarViscosity>(scene.fluid->effects[slot::viscosity]));
    EXPECT_EQ(scene.output.fields, std::vector<std::string>{"density"});
    EXPECT_EQ(scene.title, "flood");
    const Scene added = parse_case(short_case, "case.toml", {"fluid.density_diffusion.model=none"});
    EXPECT_TRUE(std::holds_alternative<Off>(added.fluid->effects[slot::diffusion]));
}

TEST(CaseFile, DiagnosticAtAPlaceShowsTheLine)
{
    const auto file = std::filesystem::path(testing::TempDir()) / "hyoryu_place.toml";
    std::ofstream(file) << full_case;
    const Scene scene = read_case(file);
    const Diagnostic diagnostic =
        diagnostic_at(scene, scene.bodies[0].place, "body[0]", "tips over");
    EXPECT_EQ(diagnostic.source, "[[body]]");
    EXPECT_EQ(diagnostic.file, file.string());
    EXPECT_EQ(diagnostic.column, 1);
    EXPECT_EQ(diagnostic.length, 8);
    std::filesystem::remove(file);
}

} // namespace hyoryu::test_case_file
