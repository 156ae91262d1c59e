// SPDX-License-Identifier: MIT
// Bodies made of several convex parts: the same motion as the solid they are, no contacts at the
// seams within, and every pair of shapes at rest.
#include "scenes.hpp"
#include "surfaces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hyoryu::test_compound {
namespace {

using namespace test;

Polytope box_at(const Vec3& low, const Vec3& high)
{
    Polytope polytope = box_polytope(high - low, 3);
    for (Vec3& corner : polytope.corners) {
        corner += (low + high) / 2;
    }
    return polytope;
}

// About the centre of mass of equal densities.
Compound centred(std::vector<std::pair<Vec3, Vec3>> boxes)
{
    Vec3 centre = Vec3::Zero();
    double volume = 0;
    for (const auto& [low, high] : boxes) {
        const double v = (high - low).prod();
        centre += v * (low + high) / 2;
        volume += v;
    }
    Compound compound;
    for (const auto& [low, high] : boxes) {
        compound.parts.push_back(box_at(low - centre / volume, high - centre / volume));
    }
    return compound;
}

// A box cut into pieces that do not line up.
Compound cut_box(const Vec3& size)
{
    const Vec3 h = size / 2;
    return centred({{-h, {0.1 * h.x(), h.y(), 0.3 * h.z()}},
                    {{0.1 * h.x(), -h.y(), -h.z()}, {h.x(), -0.2 * h.y(), 0.3 * h.z()}},
                    {{0.1 * h.x(), -0.2 * h.y(), -h.z()}, {h.x(), h.y(), 0.3 * h.z()}},
                    {{-h.x(), -h.y(), 0.3 * h.z()}, h}});
}

Compound l_shape()
{
    return centred({{{0, 0, 0}, {0.4, 0.2, 0.1}}, {{0, 0, 0.1}, {0.1, 0.2, 0.4}}});
}

Compound u_shape()
{
    return centred({{{0, 0, 0}, {0.1, 0.2, 0.3}},
                    {{0.1, 0, 0.2}, {0.3, 0.2, 0.3}},
                    {{0.3, 0, 0}, {0.4, 0.2, 0.3}}});
}

double distance_of(const Body& a, const Body& b)
{
    return (a.position - b.position).norm() +
           (a.orientation.toRotationMatrix() - b.orientation.toRotationMatrix()).norm();
}

TEST(Compound, HasTheMassOfItsParts)
{
    const MassProperties whole = mass_properties(box_polytope({0.4, 0.3, 0.2}, 3), 700, 3);
    const MassProperties cut = mass_properties(cut_box({0.4, 0.3, 0.2}), 700, 3);
    EXPECT_NEAR(cut.mass, whole.mass, 1e-13 * whole.mass);
    EXPECT_LE((cut.inertia - whole.inertia).norm(), 1e-13 * whole.inertia.norm());
}

TEST(Compound, CutBoxMovesAsTheWholeOne)
{
    // bounces on a plane, on a box and on a mesh, and slides over them; seams make no difference
    for (int ground = 0; ground < 3; ++ground) {
        for (const double tilt : {0.0, 20.0}) {
            Rigid whole = scene(0.5, 0.2);
            if (ground == 0) {
                whole.boundaries.push_back({"floor", Plane{}});
            } else if (ground == 1) {
                whole.boundaries.push_back(
                    {"box", Obstacle{box_polytope({4, 4, 1}, 3), {0, 0, -0.5}}});
            } else {
                whole.boundaries.push_back({"mesh", flat_floor(2, 30)});
            }
            Rigid cut = scene(0.5, 0.2);
            cut.boundaries = whole.boundaries;
            const Vec3 size(0.4, 0.3, 0.2);
            Body body = box(size, 500, {0, 0, tilt > 0 ? 0.35 : 0.1});
            body.orientation = turn_about(Vec3(1, 2, 0).normalized(), tilt);
            body.velocity = {1, 0.3, 0};
            whole.bodies.push_back(body);
            body.shape = cut_box(size);
            cut.bodies.push_back(body);
            double worst = 0;
            for (int k = 0; k < 300; ++k) {
                run(whole, 1e-3, 1, {}, 1e-3 * k);
                run(cut, 1e-3, 1, {}, 1e-3 * k);
                worst = std::max(worst, distance_of(whole.bodies[0], cut.bodies[0]));
            }
            // round-off of impulses that are spread over more contacts
            EXPECT_LE(worst, 1e-8) << ground << " " << tilt;
        }
    }
}

// A body that slides over a ground, after 0.6 s.
Body slid(const ContactShape& ground, const ContactShape& shape)
{
    Rigid rigid = scene(0.5, 0.1);
    rigid.boundaries.push_back({"ground", Obstacle{ground}});
    rigid.bodies.push_back(body_of(shape, 500, {-0.8, 0, 0.1}));
    rigid.bodies[0].velocity = {1.5, 0.2, 0};
    run(rigid, 1e-3, 600);
    return rigid.bodies[0];
}

TEST(Compound, NothingCatchesAtSeams)
{
    // slabs with flush tops; the box starts flush with a seam
    Compound slabs;
    for (int k = 0; k < 20; ++k) {
        slabs.parts.push_back(box_at({-1 + 0.1 * k, -1, -0.1}, {-0.9 + 0.1 * k, 1, 0}));
    }
    const Polytope flat = box_at({-1, -1, -0.1}, {1, 1, 0});
    for (const ContactShape& shape :
         {ContactShape(box_polytope({0.2, 0.2, 0.2}, 3)), ContactShape(Ball{0.1})}) {
        EXPECT_LE(distance_of(slid(flat, shape), slid(slabs, shape)), 1e-8) << shape.index();
    }
}

TEST(Compound, LandsFlatWithTheReboundOfItsMaterial)
{
    for (const Compound& shape : {l_shape(), u_shape()}) {
        for (const bool on_box : {false, true}) {
            Rigid rigid = scene(0.5, 0.3);
            if (on_box) {
                rigid.bodies.push_back(box({2, 2, 0.2}, 500, {0, 0, -0.1}));
                rigid.bodies[0].locks.fill(true);
            } else {
                rigid.boundaries.push_back({"floor", Plane{}});
            }
            double low = 0;
            for (const Polytope& part : shape.parts) {
                for (const Vec3& corner : part.corners) {
                    low = std::min(low, corner.z());
                }
            }
            rigid.bodies.push_back(body_of(shape, 500, {0, 0, 0.1 - low}));
            run(rigid, 1e-3, 200);
            const Body& body = rigid.bodies.back();
            const double v = std::sqrt(2 * g * 0.1);
            // one flat landing: v+ = e v, no spin
            EXPECT_NEAR(body.velocity.z(), 0.5 * v - g * (0.2 - v / g), 1e-9);
            EXPECT_LE(angular_velocity(body).norm(), 1e-9);
        }
    }
}

TEST(Compound, UShapeStraddlesABeam)
{
    // the beam fits between the legs; its top carries the bridge
    Rigid rigid = scene(0.0, 0.3);
    rigid.bodies.push_back(box({0.18, 1, 0.4}, 500, {0, 0, 0.2}));
    rigid.bodies[0].locks.fill(true);
    const Compound u = u_shape();
    double bridge = infinity;
    for (const Vec3& corner : u.parts[1].corners) {
        bridge = std::min(bridge, corner.z());
    }
    rigid.bodies.push_back(body_of(u, 500, {0, 0, 0.4 - bridge + 0.05}));
    run(rigid, 1e-3, 500);
    EXPECT_NEAR(rigid.bodies[1].position.z(), 0.4 - bridge, 1e-6);
    EXPECT_LE(rigid.bodies[1].velocity.norm(), 1e-6);
    EXPECT_LE(overlap(rigid, 0, 1, 0), 1e-6);
}

TEST(Compound, HooksOntoAnother)
{
    // two L shapes, one upside down over the other, pulled apart: the hooks meet and hold
    Rigid rigid = scene(0.0, 0.0);
    rigid.settings.gravity.setZero();
    rigid.bodies.push_back(body_of(l_shape(), 500, {0, 0, 0}));
    rigid.bodies[0].locks.fill(true);
    rigid.bodies.push_back(body_of(l_shape(), 500, {0.3, 0, 0.25}));
    rigid.bodies[1].orientation = turn_about(Vec3::UnitY(), 180);
    rigid.bodies[1].locks = {false, true, true, true, true, true};
    ASSERT_LE(overlap(rigid, 0, 1, 0), 0);
    rigid.bodies[1].velocity = {-1, 0, 0};
    run(rigid, 1e-3, 500);
    EXPECT_NEAR(rigid.bodies[1].velocity.x(), 0, 1e-9);
    EXPECT_LE(overlap(rigid, 0, 1, 0), 1e-6);
    EXPECT_GE(rigid.bodies[1].position.x(), -0.3);
}

// Every shape of a body on everything it can meet.
std::vector<std::pair<std::string, ContactShape>> shapes()
{
    std::vector<Vec3> cloud;
    for (int k = 0; k < 24; ++k) {
        const double z = -1 + 2 * (k + 0.5) / 24;
        const double r = std::sqrt(1 - z * z);
        cloud.emplace_back(0.15 * r * std::cos(2.4 * k), 0.12 * r * std::sin(2.4 * k), 0.1 * z);
    }
    return {{"ball", Ball{0.1}},
            {"rod", Rod{0.08, 0.4}},
            {"box", box_polytope({0.3, 0.2, 0.15}, 3)},
            {"hull", convex_hull(cloud)},
            {"compound", l_shape()}};
}

std::vector<Boundary> grounds()
{
    return {{"plane", Plane{}},
            {"basin", Basin{{-1, -1, 0}, {1, 1, 3}, {}}},
            {"box wall", Obstacle{box_polytope({3, 3, 0.4}, 3), {0, 0, -0.2}}},
            {"cylinder wall", Obstacle{Rod{0.5, 2}, {0, 0, -0.5}}},
            {"sphere wall", Obstacle{Ball{1.0}, {0, 0, -1}}},
            {"mesh wall", flat_floor(1.5, 15)},
            {"mesh spike", spike(0.5, 0.2), 0, {Vec3::Zero(), {}, {}}}};
}

double weight(const Rigid& rigid)
{
    double sum = 0;
    for (const Body& body : rigid.bodies) {
        sum += body.locks[0] ? 0 : body.mass.mass * g;
    }
    return sum;
}

// How far the momentum of any body changed by more than the log and gravity say [m/s].
double open_ledger(const Rigid& rigid, const std::vector<Body>& before,
                   const std::vector<Contact>& log, double dt)
{
    double worst = 0;
    for (std::size_t m = 0; m < before.size(); ++m) {
        const Body& now = rigid.bodies[m];
        Vec3 sum = dt * now.mass.mass * rigid.settings.gravity;
        for (const Contact& c : log) {
            const Vec3 P = c.normal_impulse * c.normal + c.tangential_impulse;
            const int own = static_cast<int>(m);
            sum += (c.a == own ? 1 : c.b == own ? -1 : 0) * P;
        }
        const Vec3 change = now.mass.mass * (now.velocity - before[m].velocity);
        worst = std::max(worst, (change - sum).norm() / now.mass.mass);
    }
    return worst;
}

void expect_gentle(Rigid& rigid, int steps, const std::string& name)
{
    double last = energy(rigid);
    double gained = 0;
    double worst = 0;
    const std::vector<Wrench> loads(rigid.bodies.size());
    for (int k = 0; k < steps; ++k) {
        const std::vector<Body> before = rigid.bodies;
        std::vector<Contact> log;
        step(rigid, k * 1e-3, 1e-3, loads, log);
        worst = std::max(worst, open_ledger(rigid, before, log, 1e-3));
        const double E = energy(rigid);
        gained = std::max(gained, E - last);
        last = E;
    }
    for (const Body& body : rigid.bodies) {
        EXPECT_TRUE(body.position.allFinite()) << name;
    }
    EXPECT_LE(worst, 1e-12) << name;
    // Rolling contacts leave the surface to second order in the step and are put back by position.
    EXPECT_LE(gained, 1e-5 * weight(rigid)) << name;
    EXPECT_LE(rigid.counters.worst_penetration, 1e-5) << name;
}

// What moves has less energy than lifts it by the round-off of positions.
void expect_rest(const Rigid& rigid, const std::string& name)
{
    double moving = 0;
    for (const Body& body : rigid.bodies) {
        moving += kinetic_energy(body);
    }
    EXPECT_LE(moving, 1e-15 * weight(rigid)) << name;
}

// Rolling may go on for ever; sliding and rocking have ended when nothing takes energy any more.
void expect_rolling_at_most(Rigid& rigid, int steps, const std::string& name)
{
    const double before = energy(rigid);
    run(rigid, 1e-3, 100, {}, 1e-3 * steps);
    EXPECT_NEAR(energy(rigid), before, 1e-8 * weight(rigid)) << name;
}

bool is_round(const ContactShape& shape)
{
    return std::holds_alternative<Ball>(shape) || std::holds_alternative<Rod>(shape);
}

TEST(Matrix, EveryShapeOnEveryGround)
{
    for (const auto& [name, shape] : shapes()) {
        for (const Boundary& ground : grounds()) {
            Rigid rigid = scene(0.3, 0.4);
            rigid.boundaries.push_back(ground);
            rigid.bodies.push_back(body_of(shape, 500, {0.02, 0.01, 0.4}));
            rigid.bodies[0].orientation = turn_about(Vec3(1, 2, 3).normalized(), 10);
            const std::string pair = name + " on " + ground.name;
            expect_gentle(rigid, 2000, pair);
            const bool level = std::holds_alternative<Plane>(ground.surface) ||
                               std::holds_alternative<Basin>(ground.surface) ||
                               ground.name == "box wall" || ground.name == "mesh wall";
            if (level) { // round shapes have no sideways push here that would set them rolling
                expect_rest(rigid, pair);
            }
        }
    }
}

TEST(Matrix, EveryShapeOnEveryShape)
{
    constexpr int steps = 4000;
    for (const auto& [lower, below] : shapes()) {
        for (const auto& [upper, above] : shapes()) {
            Rigid rigid = on_floor(0.3, 0.4);
            rigid.bodies.push_back(body_of(below, 700, {0, 0, 0.3}));
            rigid.bodies.push_back(body_of(above, 500, {0.03, 0.02, 0.8}));
            rigid.bodies[1].orientation = turn_about(Vec3(1, 2, 3).normalized(), 10);
            const std::string pair = upper + " on " + lower;
            expect_gentle(rigid, steps, pair);
            if (is_round(below) || is_round(above)) {
                expect_rolling_at_most(rigid, steps, pair);
            } else {
                expect_rest(rigid, pair);
            }
        }
    }
}

} // namespace
} // namespace hyoryu::test_compound
