// SPDX-License-Identifier: MIT
// One body against the ground: drops, slides, the timber. "Contact notes": reference numbers of
// independent event-driven solvers that the project computed before it had a solver.
#include "metric.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace hyoryu::bench {

namespace {

constexpr double pi = 3.14159265358979323846;

Quat turn(double degrees, const Vec3& axis)
{
    return Quat(Eigen::AngleAxisd(degrees * pi / 180, axis));
}

Solid box(const Vec3& size, double mass, const Vec3& position, const Quat& orientation)
{
    return {Solid::Form::box, size, mass, {position, orientation}};
}

// The cube of the drops: 6 cm long and wide, 5 cm high, 250 kg/m3.
const Vec3 cube_size{0.06, 0.06, 0.05};
constexpr double cube_mass = 0.045;  // [kg]
constexpr double fall_height = 0.1;  // of the lowest point [m]
constexpr double cube_bounce = 0.75; // e [1]

// The cube with its lowest point at the fall height.
Solid cube_above(const Quat& orientation)
{
    const Vec3 reach = orientation.toRotationMatrix().row(2).transpose().cwiseAbs();
    return box(cube_size, cube_mass, {0, 0, fall_height + reach.dot(cube_size) / 2}, orientation);
}

Scene drop(const std::string& name, const std::string& what, const Quat& orientation, double mu)
{
    Scene scene;
    scene.name = name;
    scene.what = what;
    scene.solids = {cube_above(orientation)};
    scene.ground.form = Ground::Form::floor;
    scene.restitution = cube_bounce;
    scene.friction = mu;
    return scene;
}

// z(t) of a flat drop: parabolas of speed e^k v_1, at rest after the Zeno time.
double bouncing_height(double time)
{
    const double rest = cube_size.z() / 2;
    double since = time - std::sqrt(2 * fall_height / g);
    if (since < 0) {
        return rest + fall_height - g * sq(time) / 2;
    }
    for (double v = cube_bounce * std::sqrt(2 * g * fall_height); v > 1e-9; v *= cube_bounce) {
        if (since < 2 * v / g) {
            return rest + v * since - g * sq(since) / 2;
        }
        since -= 2 * v / g;
    }
    return rest;
}

Scene flat_drop()
{
    Scene scene = drop("a_drop", "cube dropped flat, e = 0.75", Quat::Identity(), 0.3);
    scene.duration = 1.2;
    const double rest = cube_size.z() / 2;
    const double e2 = sq(cube_bounce);
    scene.metrics = {rms_height("rms height", 1.2, bouncing_height),
                     apex(1, 1e3 * (rest + fall_height * e2)),
                     apex(3, 1e3 * (rest + fall_height * e2 * e2 * e2)), largest_tilt()};
    return scene;
}

// The first impact of a cube tilted about y, in the x-z plane: (v_x, v_z, omega) after it, omega
// counter-clockwise. Newton's law of restitution with either no friction or none but sticking.
Vec3 tilted_impact(const Solid& cube, bool sticks)
{
    const double z = cube.start.position.z() - fall_height;
    const Vec3 corner = cube.start.orientation * Vec3(cube.size.x() / 2, 0, -cube.size.z() / 2);
    const Eigen::Vector2d r(corner.x(), -z);
    const double I = inertia(cube).y();
    Eigen::Matrix2d K; // inverse mass at the corner: v_p += K P
    K << 1 / cube.mass + sq(r.y()) / I, -r.x() * r.y() / I, -r.x() * r.y() / I,
        1 / cube.mass + sq(r.x()) / I;
    const double v = -std::sqrt(2 * g * fall_height);
    const double change = -(1 + cube_bounce) * v;
    const Eigen::Vector2d P = sticks ? Eigen::Vector2d(K.inverse() * Eigen::Vector2d(0, change))
                                     : Eigen::Vector2d(0, change / K(1, 1));
    return {P.x() / cube.mass, v + P.y() / cube.mass, (r.x() * P.y() - r.y() * P.x()) / I};
}

// At 30 degrees mu = 0.3 sticks: it needs 0.267. `until` is before the second impact.
Scene tilted_drop(double mu, double until)
{
    const std::string name = mu > 0 ? "a30_mu3" : "a30_mu0";
    Scene scene =
        drop(name, "cube tilted by 30 degrees, first impact", turn(30, Vec3::UnitY()), mu);
    scene.duration = until;
    const Vec3 after = tilted_impact(scene.solids[0], mu > 0);
    const double start = scene.solids[0].start.position.z();
    const double hit = std::sqrt(2 * fall_height / g);
    const auto height = [=](double t) {
        const double s = t - hit;
        return s < 0 ? start - g * sq(t) / 2 : start - fall_height + after.y() * s - g * sq(s) / 2;
    };
    scene.metrics = {
        at_time("v_z after", "m/s", until, after.y(),
                [=](const State& state) { return state.velocity.z() + g * (until - hit); }),
        at_time("omega after", "rad/s", until, after.z(),
                [](const State& state) { return -state.omega.y(); }),
        rms_height("rms height", until, height)};
    return scene;
}

// Contact notes: the place after 0.36 s, through three or four impacts on corners.
Scene corner_drop(double mu, const Vec3& place)
{
    const std::string name = mu > 0 ? "a_corner_mu3" : "a_corner_mu0";
    Scene scene = drop(name, "cube dropped on a corner, 3-D",
                       turn(20, Vec3::UnitX()) * turn(30, Vec3::UnitY()), mu);
    scene.duration = 0.36;
    scene.metrics = {distance_at(scene.duration, place)};
    return scene;
}

// u = u0 - mu g t; the distance is u0^2 / (2 mu g) whatever the heading.
Scene slide(const std::string& name, double heading)
{
    constexpr double u0 = 1;
    constexpr double mu = 0.2;
    Scene scene;
    scene.name = name;
    scene.what = "cube sliding to rest, mu = 0.2, heading " +
                 std::to_string(static_cast<int>(heading)) + " degrees";
    scene.solids = {box(cube_size, cube_mass, {0, 0, cube_size.z() / 2}, Quat::Identity())};
    scene.solids[0].start.velocity = turn(heading, Vec3::UnitZ()) * Vec3(u0, 0, 0);
    scene.ground.form = Ground::Form::floor;
    scene.friction = mu;
    scene.duration = 0.8;
    scene.metrics = {travel("stopping distance", 1e3 * sq(u0) / (2 * mu * g)),
                     mean_acceleration(0.1, 0.4, -mu * g)};
    return scene;
}

// A brick on a slope of 30 degrees, as gravity turned over a level floor.
Scene incline(const std::string& name, double mu, double heading, double duration)
{
    const Vec3 size{0.2, 0.1, 0.06};
    Scene scene;
    scene.name = name;
    scene.solids = {box(size, 2.4, {0, 0, size.z() / 2}, Quat::Identity())};
    scene.ground.form = Ground::Form::floor;
    const Vec3 down = turn(heading, Vec3::UnitZ()) * Vec3(std::sin(pi / 6), 0, -std::cos(pi / 6));
    scene.gravity = g * down;
    scene.friction = mu;
    scene.duration = duration;
    return scene;
}

Scene slipping_incline(const std::string& name, double mu, double heading)
{
    Scene scene = incline(name, mu, heading, 2);
    scene.what = "brick slipping down 30 degrees, heading " +
                 std::to_string(static_cast<int>(heading)) + " degrees";
    scene.metrics = {mean_acceleration(0.5, 2, g * (std::sin(pi / 6) - mu * std::cos(pi / 6)))};
    return scene;
}

Scene sticking_incline()
{
    Scene scene = incline("f_stick", 0.58, 0, 10); // it holds from mu = 0.57735
    scene.what = "brick held on 30 degrees by mu = 0.58, 10 s";
    scene.metrics = {travel("creep", 0)};
    return scene;
}

// Rolls from t = 2 v0 / (7 mu g) at 5/7 v0.
Scene skid_to_roll()
{
    constexpr double v0 = 3;
    constexpr double mu = 0.2;
    constexpr double R = 0.1;
    constexpr double rolls_from = 2 * v0 / (7 * mu * g);
    Scene scene;
    scene.name = "g_roll";
    scene.what = "skidding ball that comes to roll";
    scene.solids = {{Solid::Form::ball, Vec3::Constant(2 * R), 1, {{0, 0, R}}}};
    scene.solids[0].start.velocity = {v0, 0, 0};
    scene.ground.form = Ground::Form::floor;
    scene.friction = mu;
    const double x =
        v0 * rolls_from - mu * g * sq(rolls_from) / 2 + 5.0 / 7 * v0 * (1 - rolls_from);
    scene.metrics = {at_time("speed at the end", "m/s", 1, 5.0 / 7 * v0,
                             [](const State& state) { return state.velocity.x(); }),
                     travel("way", 1e3 * x),
                     at_time("slip at the end", "mm/s", 1, 0, [](const State& state) {
                         return 1e3 * (state.velocity.x() - R * state.omega.y());
                     })};
    return scene;
}

// A thin rod shot at a thin slab: does it stop at the surface, or pass?
Scene rod_on_slab()
{
    const Vec3 size{1.0, 0.02, 0.02};
    const Quat orientation = turn(60, Vec3::UnitY());
    const Vec3 reach = orientation.toRotationMatrix().row(2).transpose().cwiseAbs();
    Scene scene;
    scene.name = "h_rod";
    scene.what = "rod at 60 degrees, 30 m/s onto a slab of 20 mm";
    scene.solids = {box(size, 0.4, {0, 0, 0.5 + reach.dot(size) / 2}, orientation)};
    scene.solids[0].start.velocity = {0, 0, -30};
    scene.ground = {Ground::Form::slab, {4, 4, 0.02}};
    scene.restitution = 0.4;
    scene.friction = 0.3;
    scene.duration = 0.1;
    scene.metrics = {deepest_corner()};
    return scene;
}

// The pine timber, 100 x 10 x 10 cm, released at 45 degrees with its lower right edge on the floor.
// Contact notes: place of that edge and omega (counter-clockwise) at 0.3 s, before the landing; the
// right end's apex after it and the final place by the law of rounds. Engines that solve impacts
// simultaneously have apex 0 by their law, not by error.
struct TimberAnswer {
    double x_C = 0;   // at 0.3 s [m]
    double omega = 0; // at 0.3 s [rad/s]
    double apex = 0;  // of the right end [m]
    double end = 0;   // x_C at rest [m]
};

Metric right_end_apex(double exact, double landing)
{
    return {"apex of the right end", "mm", 1e3 * exact,
            [landing](const Scene&, const Trace& trace) {
                double highest = 0;
                for (const Sample& sample : trace) {
                    if (sample.time > landing) {
                        const State& state = sample.states[0];
                        const Vec3 corner = state.orientation * Vec3(0.5, 0, -0.05);
                        highest = std::max(highest, state.position.z() + corner.z());
                    }
                }
                return 1e3 * highest;
            }};
}

Scene timber(const std::string& name, double mu, const TimberAnswer& answer)
{
    const Quat orientation = turn(45, Vec3::UnitY());
    const Vec3 edge = orientation * Vec3(0.5, 0, -0.05);
    const auto x_C = [](const State& state) {
        return 1e3 * (state.position + state.orientation * Vec3(0.5, 0, -0.05)).x();
    };
    Scene scene;
    scene.name = name;
    scene.what = "timber falling from 45 degrees, e = 0.4";
    scene.solids = {box({1.0, 0.1, 0.1}, 5.2, {-edge.x(), 0, -edge.z()}, orientation)};
    scene.ground.form = Ground::Form::floor;
    scene.restitution = 0.4;
    scene.friction = mu;
    scene.metrics = {at_time("x of the right end at 0.3 s", "mm", 0.3, 1e3 * answer.x_C, x_C),
                     at_time("omega at 0.3 s", "rad/s", 0.3, answer.omega,
                             [](const State& state) { return -state.omega.y(); }),
                     right_end_apex(answer.apex, 0.3),
                     at_time("x of the right end at rest", "mm", 1, 1e3 * answer.end, x_C)};
    return scene;
}

} // namespace

std::vector<Scene> drop_scenes()
{
    return {flat_drop(), tilted_drop(0, 0.2), tilted_drop(0.3, 0.29),
            corner_drop(0, {0, 0, 0.0490477450938}),
            corner_drop(0.3, {-0.0731487496276, 0.0929944809165, 0.0493061512961})};
}

std::vector<Scene> sliding_scenes()
{
    return {slide("b_slide", 0),
            slide("b_slide45", 45),
            slipping_incline("f_slip", 0.57, 0),
            sticking_incline(),
            slipping_incline("f_slip45", 0.5, 45),
            skid_to_roll(),
            rod_on_slab()};
}

std::vector<Scene> timber_scenes()
{
    return {timber("c_mu0", 0,
                   {0.172488820942, 4.11630209578, 0.03810,
                    0.5 * (1 - std::sqrt(0.5)) + 0.05 * std::sqrt(0.5)}),
            timber("c_mu3", 0.3, {0.0988547942813, 3.70306904068, 0.03728, 0.100584543319}),
            timber("c_mu6", 0.6, {-2.81348373757e-05, 3.21288150537, 0.03754, -0.0122866878946})};
}

} // namespace hyoryu::bench
