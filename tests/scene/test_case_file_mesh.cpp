// SPDX-License-Identifier: MIT
// Meshes named by a case: found beside it, checked, centred for bodies.
#include "hyoryu/scene/plan_slips.hpp"
#include "test_case_file_support.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <fstream>
#include <sstream>

#ifdef HYORYU_HAS_VTK

namespace hyoryu::test_case_file_mesh {

namespace {

const std::string cube = R"(v 1 1 1
v 3 1 1
v 3 3 1
v 1 3 1
v 1 1 3
v 3 1 3
v 3 3 3
v 1 3 3
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

class CaseMesh : public testing::Test {
protected:
    void SetUp() override
    {
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / "cube.obj") << cube;
        std::ofstream(folder_ / "open.obj") << cube.substr(0, cube.size() - 10);
        std::ofstream(folder_ / "bad.stl") << "nothing";
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::vector<Diagnostic> wrong(const std::string& text) const
    {
        try {
            parse_case(text, folder_ / "case.toml");
            return {};
        } catch (const CaseError& error) {
            return error.diagnostics();
        }
    }
    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                    ("hyoryu_case_mesh_" + std::to_string(getpid()));
};

// E11: a mesh in millimetres read as metres, and one in metres shrunk to millimetres.
TEST_F(CaseMesh, E11AScaleThatIsProbablyWrongIsWarnedOf)
{
    const auto warnings = [&](const std::string& scale) {
        const Scene scene = parse_case(
            "[time]\nend = 1.0\n[particles]\nspacing = 0.05\n[[wall]]\nname = \"floor\"\n"
            "shape = \"box\"\nmin = [-2, -2, -0.5]\nmax = [2, 2, 0]\n[[body]]\n"
            "name = \"crate\"\nshape = \"mesh\"\nfile = \"cube.obj\"\ndensity = 500\n"
            "position = [0, 0, 3]\nscale = " +
                scale + "\n",
            folder_ / "case.toml");
        Plan plan;
        warn_about_slips(scene, plan);
        std::string text;
        for (const Diagnostic& slip : plan.warnings) {
            text += slip.key + ": " + slip.what + "; " + slip.hint + "\n";
        }
        return text;
    };
    EXPECT_EQ(warnings("1.0").find("scale"), std::string::npos) << warnings("1.0");
    for (const auto& [scale, words] :
         {std::pair("0.001", "less than the spacing of 0.05 m"),
          std::pair("1000", "3.46e+03 m across, the rest of the scene")}) {
        const std::string text = warnings(scale);
        EXPECT_NE(text.find("body[0].scale"), std::string::npos) << text;
        EXPECT_NE(text.find(words), std::string::npos) << text;
        EXPECT_NE(text.find("check `scale`"), std::string::npos) << text;
    }
}

std::string body_of(const std::string& file)
{
    return short_case + "[[body]]\nshape = \"mesh\"\nfile = \"" + file +
           "\"\nscale = 0.5\ndensity = 500\nposition = [5, 0, 0]\n";
}

} // namespace

TEST_F(CaseMesh, OfABodyIsGivenAboutItsCentreOfMass)
{
    const Scene scene = parse_case(body_of("cube.obj"), folder_ / "case.toml");
    const auto& mesh = std::get<MeshShape>(scene.bodies[0].shape);
    EXPECT_NEAR(scene.bodies[0].mass, 500, 1e-9);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& corner : mesh.corners) {
        sum += corner;
        EXPECT_NEAR(corner.cwiseAbs().maxCoeff(), 0.5, 1e-12);
    }
    EXPECT_NEAR(sum.norm(), 0, 1e-12);
}

TEST_F(CaseMesh, OfAWallStaysWhereItsFileSays)
{
    const Scene scene = parse_case(short_case + "[[wall]]\nshape = \"mesh\"\nfile = \"cube.obj\"\n",
                                   folder_ / "case.toml");
    const auto& solid = std::get<SolidWall>(scene.walls[0].geometry);
    EXPECT_EQ(solid.centre, Vec3(0, 0, 0));
    EXPECT_EQ(std::get<MeshShape>(solid.shape).corners[0], Vec3(1, 1, 1));
}

TEST_F(CaseMesh, IsWrittenWithItsFullPathAndReadsBack)
{
    const Scene scene = parse_case(body_of("cube.obj"), folder_ / "case.toml");
    const std::string written = to_toml(scene);
    const Scene again = parse_case(written, "elsewhere.toml");
    EXPECT_EQ(to_toml(again), written);
    EXPECT_EQ(std::get<MeshShape>(again.bodies[0].shape).corners,
              std::get<MeshShape>(scene.bodies[0].shape).corners);
}

TEST_F(CaseMesh, ThatIsMissingDamagedOrOpenIsToldAtItsKey)
{
    for (const auto& [file, what] :
         std::vector<std::pair<std::string, std::string>>{{"none.obj", "does not exist"},
                                                          {"bad.stl", "is not an STL file"},
                                                          {"open.obj", "4 open edges"}}) {
        const auto all = wrong(body_of(file));
        ASSERT_EQ(all.size(), 1u) << file;
        EXPECT_EQ(all[0].key, "body[0].file");
        EXPECT_EQ(all[0].line, short_lines + 3);
        EXPECT_EQ(all[0].column, 8);
        EXPECT_NE(all[0].what.find(what), std::string::npos) << all[0].what;
    }
}

// The reader rounds to 24 bits: a cube somewhere on a map is refused where that is more than a
// hundredth of the spacing, whatever it is part of.
TEST_F(CaseMesh, OfMapCoordinatesIsRefusedBeforeItIsRounded)
{
    const auto cube_at = [&](double x, double y) {
        std::ofstream file(folder_ / "map.obj");
        std::istringstream lines(cube);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::string kind;
            std::array<double, 3> n{};
            if (words >> kind && kind == "v" && words >> n[0] >> n[1] >> n[2]) {
                line = fmt::format("v {} {} {}", n[0] + x, n[1] + y, n[2]);
            }
            file << line << '\n';
        }
    };
    const auto walls = [&](double spacing) {
        return wrong(fmt::format("[time]\nend = 1.0\n[particles]\nspacing = {}\n[[wall]]\nshape = "
                                 "\"mesh\"\nfile = \"map.obj\"\n[[body]]\nshape = \"sphere\"\n"
                                 "radius = 9\ndensity = 500\nposition = [0, 0, 90]\n",
                                 spacing));
    };
    for (const auto& [x, y] : {std::pair(378450.3, 4072310.7), std::pair(-4072310.7, 0.0)}) {
        cube_at(x, y);
        for (const double spacing : {0.1, 2.0}) {
            const auto all = walls(spacing);
            ASSERT_EQ(all.size(), 1u) << spacing;
            EXPECT_EQ(all[0].key, "wall[0].file");
            EXPECT_NE(all[0].what.find("rounded by up to 0.24 m"), std::string::npos)
                << all[0].what;
            EXPECT_NE(all[0].hint.find("`position`"), std::string::npos) << all[0].hint;
        }
    }
    cube_at(9e7, 9e7); // numbers in single precision are 8 m apart there
    ASSERT_EQ(walls(0.1).size(), 1u);
    EXPECT_NE(walls(0.1)[0].what.find("single precision"), std::string::npos) << walls(0.1)[0].what;
    cube_at(1500, -900); // 0.09 mm
    EXPECT_EQ(walls(0.1).size(), 0u);
    EXPECT_EQ(walls(0.005).size(), 1u);
}

TEST_F(CaseMesh, InTwoDimensionsIsNotThereYet)
{
    EXPECT_EQ(wrong("dimensions = 2\n" + body_of("cube.obj"))[0].key, "body[0].shape");
}

} // namespace hyoryu::test_case_file_mesh

#endif
