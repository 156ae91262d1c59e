// SPDX-License-Identifier: MIT
// Mesh files: good ones, open ones, and ones that are damaged on purpose.
#include "hyoryu/geometry/mesh.hpp"

#include "hyoryu/core/error.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

namespace hyoryu::test_mesh {

namespace {

const std::array<Vec3, 4> tetrahedron = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0),
                                         Vec3(0, 0, 3)};
const std::vector<std::array<int, 3>> outward = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string text_stl(std::vector<std::array<int, 3>> triangles)
{
    std::string text = "solid tetrahedron\n";
    for (const auto& triangle : triangles) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const int k : triangle) {
            const Vec3& corner = tetrahedron[static_cast<std::size_t>(k)];
            text += "  vertex " + std::to_string(corner.x()) + " " + std::to_string(corner.y()) +
                    " " + std::to_string(corner.z()) + "\n";
        }
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid tetrahedron\n";
}

std::string binary_stl(std::uint32_t count, const std::vector<std::array<int, 3>>& triangles)
{
    std::string bytes(80, ' ');
    bytes.append(reinterpret_cast<const char*>(&count), 4);
    for (const auto& triangle : triangles) {
        bytes.append(12, '\0');
        for (const int k : triangle) {
            const Eigen::Vector3f corner = tetrahedron[static_cast<std::size_t>(k)].cast<float>();
            bytes.append(reinterpret_cast<const char*>(corner.data()), 12);
        }
        bytes.append(2, '\0');
    }
    return bytes;
}

std::string obj(const std::vector<std::array<int, 3>>& triangles)
{
    std::string text = "# a tetrahedron\n";
    for (const Vec3& v : tetrahedron) {
        text += "v " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
                std::to_string(v.z()) + "\n";
    }
    for (const auto& t : triangles) {
        text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
                std::to_string(t[2] + 1) + "\n";
    }
    return text;
}

/// A file of that name and content, gone at the end of the test.
class MeshFile : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const std::string& content)
    {
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

private:
    std::filesystem::path folder_ =
        std::filesystem::path(testing::TempDir()) /
        ("hyoryu_mesh_" +
         std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
};

/// Why reading fails; empty if it does not.
std::string refusal(const std::filesystem::path& file)
{
    try {
        read_mesh(file, 1);
        return {};
    } catch (const IoError& error) {
        return error.what();
    }
}

} // namespace

TEST(Closure, OfATetrahedronIsGiven)
{
    const Mesh mesh{{tetrahedron.begin(), tetrahedron.end()}, outward};
    EXPECT_EQ(closure_fault(mesh), "");
}

TEST(Closure, FaultsAreNamed)
{
    Mesh mesh{{tetrahedron.begin(), tetrahedron.end()}, outward};
    mesh.triangles.pop_back();
    EXPECT_EQ(closure_fault(mesh), "3 open edges");
    mesh.triangles.push_back({1, 3, 2});
    EXPECT_NE(closure_fault(mesh).find("opposite orientations at 3 edges"), std::string::npos);
    mesh.triangles = outward;
    mesh.triangles.insert(mesh.triangles.end(), outward.begin(), outward.end());
    EXPECT_NE(closure_fault(mesh).find("more than two triangles"), std::string::npos);
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
    EXPECT_EQ(closure_fault(mesh), "its volume is zero");
    EXPECT_EQ(closure_fault({}), "it has no triangles");
}

TEST(Solid, PropertiesOfATetrahedronAreThoseOfTheBooks)
{
    const SolidProperties solid =
        solid_properties({{tetrahedron.begin(), tetrahedron.end()}, outward});
    EXPECT_NEAR(solid.volume, 1, 1e-14);
    EXPECT_NEAR((solid.centroid - Vec3(0.25, 0.5, 0.75)).norm(), 0, 1e-14);
    // Integral of x^2 about the centroid of a right tetrahedron with edge a: 3 a^2 V / 80.
    EXPECT_NEAR(solid.second_moment(0, 0), 3.0 / 80, 1e-14);
    EXPECT_NEAR(solid.second_moment(2, 2), 27.0 / 80, 1e-14);
    // Of x y: -a b V / 80.
    EXPECT_NEAR(solid.second_moment(0, 1), -2.0 / 80, 1e-14);
}

TEST_F(MeshFile, OfAnUnknownKindOrMissingIsRefused)
{
    EXPECT_NE(refusal("no_such_file.stl").find("does not exist"), std::string::npos);
    EXPECT_NE(refusal(write("a.ply", "ply\n")).find(".stl or .obj"), std::string::npos);
    EXPECT_NE(refusal(write("a.stl", "")).find("is empty"), std::string::npos);
    EXPECT_NE(refusal(testing::TempDir()).find("cannot be read"), std::string::npos);
}

TEST_F(MeshFile, WithAHostileTriangleCountIsRefused)
{
    EXPECT_NE(refusal(write("a.stl", binary_stl(4000000000u, outward))).find("4000000000"),
              std::string::npos);
    EXPECT_NE(refusal(write("b.stl", binary_stl(4, outward).substr(0, 200))).find("truncated"),
              std::string::npos);
    EXPECT_NE(refusal(write("c.stl", "solid \xff\xff" + std::string(300, '\xee'))), "");
}

#ifdef HYORYU_HAS_VTK

TEST_F(MeshFile, OfEachKindGivesTheSameSolid)
{
    for (const auto& file :
         {write("t.stl", text_stl(outward)), write("b.STL", binary_stl(4, outward)),
          write("o.obj", obj(outward))}) {
        const Mesh mesh = read_mesh(file, 2);
        EXPECT_EQ(mesh.corners.size(), 4u) << file;
        EXPECT_EQ(mesh.triangles.size(), 4u) << file;
        EXPECT_EQ(closure_fault(mesh), "") << file;
        EXPECT_NEAR(solid_properties(mesh).volume, 8, 1e-6) << file;
    }
}

TEST_F(MeshFile, InsideOutIsTurned)
{
    std::vector<std::array<int, 3>> inward = outward;
    for (auto& triangle : inward) {
        std::swap(triangle[0], triangle[1]);
    }
    EXPECT_NEAR(solid_properties(read_mesh(write("a.stl", binary_stl(4, inward)), 1)).volume, 1,
                1e-6);
}

TEST_F(MeshFile, OpenIsReadAndToldByClosure)
{
    EXPECT_EQ(closure_fault(read_mesh(write("a.obj", obj({outward[0], outward[1]})), 1)),
              "4 open edges");
}

TEST_F(MeshFile, OfGarbageIsRefusedInSilence)
{
    testing::internal::CaptureStderr();
    EXPECT_NE(refusal(write("a.stl", "solid\nfacet nonsense\nvertex a b c\n")), "");
    EXPECT_NE(refusal(write("b.stl", text_stl(outward).substr(0, 150))), "");
    EXPECT_NE(refusal(write("c.obj", "v 1 2\nf 1 2 3\nf 9 9 9\n")), "");
    EXPECT_NE(refusal(write("d.obj", std::string(1000, '\0'))), "");
    EXPECT_NE(refusal(write("e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n")), "");
    EXPECT_NE(refusal(write("i.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2/ 3\n")), "");
    EXPECT_NE(refusal(write("f.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), "");
    EXPECT_NE(refusal(write("h.obj", "v 0 0 1e999\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).find("line 1"),
              std::string::npos);
    EXPECT_NE(refusal(write("g.stl", "solid binary" + binary_stl(4, outward).substr(12) + "x")),
              "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// One corner far away would make one of all others when corners are merged.
TEST_F(MeshFile, WithACornerOutOfRangeIsRefused)
{
    for (const std::string far : {"1e30", "-1e12", "3e8"}) {
        std::string text = text_stl(outward);
        text.replace(text.find("1.000000"), 8, far);
        const std::string why = refusal(write("a.stl", text));
        EXPECT_NE(why.find("out of range"), std::string::npos) << far << ": " << why;
        EXPECT_NE(why.find("`scale`"), std::string::npos) << why;
    }
    const auto file = write("b.obj", "v 1e12 0 0\nv 0 1e12 0\nv 0 0 1e12\nv 0 0 0\nf 1 2 3\n"
                                     "f 1 4 2\nf 2 4 3\nf 3 4 1\n");
    EXPECT_NEAR(solid_properties(read_mesh(file, 1e-12)).volume, 1.0 / 6, 1e-6);
}

TEST_F(MeshFile, OfTextThatVtkTakesForBinaryIsRefused)
{
    std::string name; // more of it than the twentieth part of 256 bytes that VTK lets pass
    for (int k = 0; k < 5; ++k) {
        name += "\u6f02";
    }
    const std::string text = text_stl(outward);
    EXPECT_NE(refusal(write("a.stl", "solid " + name + text.substr(5))).find("plain name"),
              std::string::npos);
    EXPECT_EQ(refusal(write("b.stl", "solid \u6f02" + text.substr(5))), "");
}

TEST_F(MeshFile, BinaryWithATextualHeaderIsRead)
{
    const auto file = write("a.stl", "solid made by a program" + binary_stl(4, outward).substr(23));
    EXPECT_NEAR(solid_properties(read_mesh(file, 1)).volume, 1, 1e-6);
}

#endif

} // namespace hyoryu::test_mesh
