// SPDX-License-Identifier: MIT
// Bodies given by their particles: they are the solid that their cubes make up.
#include "test_case_file_support.hpp"

#include "hyoryu/scene/rigid_scene.hpp"
#include "hyoryu/scene/voxels.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

namespace hyoryu::test_particle_bodies {
namespace {

using Points = std::vector<Vec3>;

Points lattice(int nx, int ny, int nz, double d)
{
    Points points;
    for (int k = 0; k < nz; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < nx; ++i) {
                points.push_back(d * Vec3(i + 3, j - 1, k)); // anywhere: the file has no centre
            }
        }
    }
    return points;
}

class ParticleBody : public testing::Test {
protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    Scene scene_of(const Points& points, const std::string& shape, double d)
    {
        std::ofstream file(folder_ / "body.csv");
        file << "x,y,z\n";
        for (const Vec3& p : points) {
            file << fmt::format("{},{},{}\n", p.x(), p.y(), p.z());
        }
        file.close();
        return parse_case("[time]\nend = 1\n[particles]\nspacing = 0.01\n[contact]\n"
                          "restitution = 0.5\nfriction = 0.3\n[[wall]]\nshape = \"plane\"\n"
                          "[[body]]\n" +
                              shape + fmt::format("\nspacing = {}\n", d) +
                              "density = 250\nposition = [0, 0, 0.15]\n"
                              "rotation_deg = { axis = [1, 2, 0], angle = 20 }\n",
                          folder_ / "case.toml");
    }

    Rigid particles(const Points& points, double d)
    {
        return make_rigid(scene_of(points, "shape = \"particles\"\nfile = \"body.csv\"", d));
    }
    Rigid box(const Vec3& size, double d)
    {
        return make_rigid(scene_of(
            {Vec3::Zero()},
            fmt::format("shape = \"box\"\nsize = [{}, {}, {}]", size.x(), size.y(), size.z()), d));
    }

    std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                    ("hyoryu_particles_" + std::to_string(getpid()));
};

// The largest difference of places over the first bounces, and of spins; energy must not grow.
void expect_same_motion(Rigid one, Rigid other, int steps)
{
    double place = 0;
    double spin = 0;
    double gained = 0;
    double last = infinity;
    std::vector<Contact> log;
    const std::vector<Wrench> loads(1);
    for (int k = 0; k < steps; ++k) {
        step(one, 1e-3 * k, 1e-3, loads, log);
        step(other, 1e-3 * k, 1e-3, loads, log);
        const Body& a = one.bodies[0];
        const Body& b = other.bodies[0];
        place = std::max(place, (a.position - b.position).norm());
        spin = std::max(spin, (angular_velocity(a) - angular_velocity(b)).norm());
        const double E = kinetic_energy(a) + a.mass.mass * 9.81 * a.position.z();
        gained = std::max(gained, (E - last) / E);
        last = E;
    }
    EXPECT_FALSE(log.empty());
    EXPECT_LE(place, 1e-9);
    EXPECT_LE(spin, 1e-8 * 100); // of up to 100 rad/s
    EXPECT_LE(gained, 1e-8);     // gaps of 1e-9 m put right by position, at a height of 0.1 m
}

TEST_F(ParticleBody, DegenerateAggregatesAreSolids)
{
    // one cube, two and ten in a row, a plate of four: the inertia of the box they are, exactly
    for (const auto& n : {std::array{1, 1, 1}, {2, 1, 1}, {10, 1, 1}, {2, 2, 1}}) {
        const double d = 0.02;
        const Vec3 size = d * Vec3(n[0], n[1], n[2]);
        const Rigid cubes = particles(lattice(n[0], n[1], n[2], d), d);
        const Rigid solid = box(size, d);
        const MassProperties& m = cubes.bodies[0].mass;
        const double mass = 250 * size.prod();
        EXPECT_NEAR(m.mass, mass, 1e-14 * mass);
        const Vec3 squares = size.cwiseProduct(size);
        const Mat3 exact =
            (mass / 12 * (squares.sum() * Vec3::Ones() - squares)).asDiagonal().toDenseMatrix();
        EXPECT_LE((m.inertia - exact).norm(), 1e-13 * exact.norm());
        ASSERT_TRUE(std::holds_alternative<Polytope>(cubes.bodies[0].shape));
        expect_same_motion(particles(lattice(n[0], n[1], n[2], d), d), box(size, d), 300);
    }
}

TEST_F(ParticleBody, TheCubeOfTheDropsIsTheBox)
{
    // 180 particles of 1 cm: 6 x 6 x 5 cm
    expect_same_motion(particles(lattice(6, 6, 5, 0.01), 0.01), box({0.06, 0.06, 0.05}, 0.01), 300);
}

TEST_F(ParticleBody, TheHullOfAMeshIsTheBox)
{
    // a mesh of the cube with corners in the middle of its faces and edges too
    const Vec3 size(0.06, 0.06, 0.05);
    std::vector<Vec3> corners;
    for (const Vec3& p : lattice(3, 3, 3, 1)) {
        corners.emplace_back((p - Vec3(4, 0, 1)).cwiseProduct(size / 2));
    }
    Rigid hull = box(size, 0.01);
    hull.bodies[0].shape = convex_hull(corners);
    expect_same_motion(std::move(hull), box(size, 0.01), 300);
}

// An L of 0.4 x 0.2 x 0.4 m, 0.1 m thick, with one corner in the origin.
MeshShape l_mesh()
{
    MeshShape mesh;
    for (const double y : {0.0, 0.2}) {
        for (const auto& [x, z] :
             {std::pair(0.0, 0.0), {0.4, 0.0}, {0.4, 0.1}, {0.1, 0.1}, {0.1, 0.4}, {0.0, 0.4}}) {
            mesh.corners.emplace_back(x, y, z);
        }
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4},  {0, 4, 5},
                      {8, 7, 6}, {9, 8, 6}, {10, 9, 6}, {11, 10, 6}};
    for (int k = 0; k < 6; ++k) {
        const int next = (k + 1) % 6;
        mesh.triangles.push_back({k, k + 6, next + 6});
        mesh.triangles.push_back({k, next + 6, next});
    }
    return mesh;
}

TEST(MeshBody, IsTheBoxesOfItsCellsWhereItIsNotConvex)
{
    BodySettings body;
    body.shape = l_mesh();
    body.spacing = 0.05;
    const ContactShape shape = contact_shape(body, 3);
    const auto* compound = std::get_if<Compound>(&shape);
    ASSERT_NE(compound, nullptr);
    EXPECT_EQ(compound->parts.size(), 2U);
    // the lattice fits the mesh here, so that the staircase is the mesh
    const double volume_of_l = 0.2 * (0.4 * 0.1 + 0.1 * 0.3);
    EXPECT_NEAR(mass_properties(shape, 1, 3).mass, volume_of_l, 1e-12);
}

TEST(MeshBody, HasTheMassOfWhatItEnclosesWhereItIsNotConvex)
{
    Scene scene;
    scene.bodies.resize(1);
    BodySettings& body = scene.bodies[0];
    MeshShape mesh = l_mesh(); // about its centre of mass, as the reader of cases moves it
    const Vec3 centre = (0.04 * Vec3(0.2, 0.1, 0.05) + 0.03 * Vec3(0.05, 0.1, 0.25)) / 0.07;
    for (Vec3& corner : mesh.corners) {
        corner -= centre;
    }
    body.shape = mesh;
    body.spacing = 0.05;
    body.density = 250;
    body.mass = 250 * 0.2 * 0.07;
    const Rigid rigid = make_rigid(scene);
    const MassProperties parts = mass_properties(contact_shape(body, 3), 250, 3);
    EXPECT_NEAR(rigid.bodies[0].mass.mass, body.mass, 1e-12);
    EXPECT_LE((rigid.bodies[0].mass.inertia - parts.inertia).norm(), 1e-12 * parts.inertia.norm());
}

TEST_F(ParticleBody, IsACompoundWhereItIsNotConvex)
{
    Points l = lattice(4, 2, 1, 0.02);
    l.push_back(l.front() + Vec3(0, 0, 0.02));
    l.push_back(l.front() + Vec3(0, 0, 0.04));
    const Rigid rigid = particles(l, 0.02);
    const auto* compound = std::get_if<Compound>(&rigid.bodies[0].shape);
    ASSERT_NE(compound, nullptr);
    EXPECT_EQ(compound->parts.size(), 2U); // the slab and the post
    const MassProperties parts = mass_properties(*compound, 250, 3);
    EXPECT_NEAR(parts.mass, rigid.bodies[0].mass.mass, 1e-13 * parts.mass);
    EXPECT_LE((parts.inertia - rigid.bodies[0].mass.inertia).norm(), 1e-12 * parts.inertia.norm());
}

TEST_F(ParticleBody, OffTheLatticeItIsItsHullOrEveryCube)
{
    Points skew = lattice(8, 1, 1, 0.02);
    for (std::size_t k = 0; k < skew.size(); ++k) {
        skew[k].z() += 1e-4 * static_cast<double>(k % 2); // a rod that is not quite straight
    }
    EXPECT_TRUE(std::holds_alternative<Polytope>(particles(skew, 0.02).bodies[0].shape));
    skew[7].z() += 0.009; // half a cube aside
    const Rigid bent = particles(skew, 0.02);
    ASSERT_TRUE(std::holds_alternative<Compound>(bent.bodies[0].shape));
    EXPECT_EQ(std::get<Compound>(bent.bodies[0].shape).parts.size(), 8U);
}

TEST_F(ParticleBody, IsWrittenByItsFile)
{
    const Scene scene =
        scene_of(lattice(3, 2, 1, 0.02), "shape = \"particles\"\nfile = \"body.csv\"", 0.02);
    const std::string written = to_toml(scene);
    const Scene again = parse_case(written, "elsewhere.toml");
    EXPECT_EQ(to_toml(again), written);
    EXPECT_EQ(std::get<ParticleShape>(again.bodies[0].shape).points,
              std::get<ParticleShape>(scene.bodies[0].shape).points);
}

TEST(Voxels, AConvexUnionIsOneBox)
{
    const auto boxes = merged_cells(lattice(7, 5, 3, 0.1), Vec3::Constant(0.1));
    ASSERT_TRUE(boxes);
    EXPECT_EQ(boxes->size(), 1U);
    Points twice = lattice(2, 1, 1, 0.1);
    twice.push_back(twice.front());
    EXPECT_FALSE(merged_cells(twice, Vec3::Constant(0.1)));
    EXPECT_EQ(exposed_cells(lattice(3, 3, 3, 0.1), Vec3::Constant(0.1)), 26);
}

} // namespace
} // namespace hyoryu::test_particle_bodies
