// SPDX-License-Identifier: MIT
// Scales of length: with speeds and times by the root of the length (Froude) nothing else differs.
#include "scenes.hpp"
#include "surfaces.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyoryu::test_scales {
namespace {

using namespace test;

using BoundarySurface = decltype(Boundary::surface);

// A box, a rod, a ball and a second box, all tumbling, above a floor that is a plane or a mesh.
Rigid tumbling(double L, const BoundarySurface& floor)
{
    Rigid rigid = scene(0.3, 0.4);
    rigid.settings.unit = L;
    rigid.settings.contact_tolerance *= L;
    rigid.settings.resting_speed *= std::sqrt(L);
    rigid.boundaries.push_back({"floor", floor});
    rigid.bodies.push_back(box(L * Vec3(0.1, 0.1, 0.06), 500, L * Vec3(0, 0, 0.1)));
    rigid.bodies.push_back(body_of(Rod{0.03 * L, 0.2 * L}, 700, L * Vec3(0.02, 0.01, 0.22)));
    rigid.bodies.push_back(body_of(Ball{0.04 * L}, 300, L * Vec3(0.03, -0.02, 0.32)));
    rigid.bodies.push_back(box(L * Vec3(0.08, 0.05, 0.05), 900, L * Vec3(-0.02, 0.01, 0.42)));
    for (std::size_t k = 0; k < rigid.bodies.size(); ++k) {
        Body& body = rigid.bodies[k];
        body.orientation = turn_about(Vec3(1, 2, 0.5).normalized(), 20.0 * static_cast<double>(k));
        body.velocity = std::sqrt(L) * Vec3(0.2, 0.1, 0);
        body.angular_momentum = angular_momentum(body, Vec3(1, -2, 0.5) / std::sqrt(L));
    }
    return rigid;
}

// Where the bodies are after 0.3 s times the root of L, in units of L.
std::vector<Vec3> places(double L, const BoundarySurface& floor)
{
    Rigid rigid = tumbling(L, floor);
    run(rigid, 1e-3 * std::sqrt(L), 300);
    std::vector<Vec3> list;
    for (const Body& body : rigid.bodies) {
        list.emplace_back(body.position / L);
    }
    return list;
}

MeshSurface scaled(MeshSurface mesh, double L)
{
    for (Vec3& corner : mesh.corners) {
        corner *= L;
    }
    return mesh;
}

// Round-off, 1e-16 of a metre, grows by 1e4 to 3e5 in some ten impacts, as the processor rounds
// (3e-11 at most on the two that were tried). With tolerances in metres the
// places differ by 1e-6 and more.
constexpr double round_off = 1e-10;

TEST(Scales, MillimetresAndKilometresTumbleAsMetresDo)
{
    const std::vector<Vec3> metre = places(1, Plane{});
    for (const double L : {1e-3, 1e3}) {
        const std::vector<Vec3> other = places(L, Plane{});
        for (std::size_t k = 0; k < metre.size(); ++k) {
            EXPECT_LE((other[k] - metre[k]).norm(), round_off) << "body " << k << ", L = " << L;
        }
    }
}

TEST(Scales, TheyDoSoOnAMesh)
{
    const std::vector<Vec3> metre = places(1, flat_floor(0.5, 6));
    for (const double L : {1e-3, 1e3}) {
        const std::vector<Vec3> other = places(L, scaled(flat_floor(0.5, 6), L));
        for (std::size_t k = 0; k < metre.size(); ++k) {
            EXPECT_LE((other[k] - metre[k]).norm(), round_off) << "body " << k << ", L = " << L;
        }
    }
}

} // namespace
} // namespace hyoryu::test_scales
