// SPDX-License-Identifier: MIT
#include "plan_checks.hpp"

#include "hyoryu/rigid/box_tree.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan_slips.hpp"
#include "hyoryu/scene/rigid_scene.hpp"
#include "plan_covered.hpp"
#include "plan_gaps.hpp"
#include "plan_gauges.hpp"
#include "plan_leaks.hpp"
#include "plan_open.hpp"
#include "plan_thin.hpp"
#include "plan_units.hpp"
#include "plan_warnings.hpp"
#include "plan_waves.hpp"
#include "scene/filling/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hyoryu {

namespace {

// Bodies may touch; an overlap deeper than this share of their spacing is a mistake.
constexpr double allowed_overlap = 0.01;
// Largest stable CFL of the time scheme, measured on still water.
constexpr double stable_cfl = 1.2;

double thinnest(const Shape& shape, int dimensions)
{
    if (const auto* box = std::get_if<BoxShape>(&shape)) {
        return dimensions == 2 ? std::min(box->size.x(), box->size.z()) : box->size.minCoeff();
    }
    if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
        return 2 * sphere->radius;
    }
    if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
        return std::min(2 * cylinder->radius, cylinder->length);
    }
    const Bounds box = bounds({.shape = &shape, .dimensions = dimensions});
    return (box.max - box.min).minCoeff();
}

// Depth of a body in a wall that is a mesh, at least, if its middle is within or on it: contact
// looks at surfaces from outside, and a body that is farther inside touches none. 0 if it is not.
double depth_in_mesh(const BodySettings& body, const Wall& wall, int dimensions)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    if (solid == nullptr || !std::holds_alternative<MeshShape>(solid->shape)) {
        return 0;
    }
    const bool convex = !std::holds_alternative<MeshShape>(body.shape) &&
                        !std::holds_alternative<ParticleShape>(body.shape);
    const double half = convex ? thinnest(body.shape, dimensions) / 2 : 0;
    const Vec3 middle = body.position - body.rotation * body.centre_of_mass.value_or(Vec3(0, 0, 0));
    const double depth = -signed_distance(placed(*solid, dimensions), middle);
    return depth > -allowed_overlap * body.spacing ? depth + half : 0;
}

// Whether the ball about a body is clear of a wall that is made of planes: most of many bodies in a
// basin are, and need no closer look.
bool is_clear_of(const Wall& wall, const Body& body, int dimensions)
{
    return !std::holds_alternative<SolidWall>(wall.geometry) &&
           -depth_behind(wall, body.position, dimensions) > bounding_radius(body, dimensions);
}

// Pairs a < b whose bounding balls meet, in the order of the case: with up to 100,000 copies,
// testing all pairs takes too long.
std::vector<std::pair<int, int>> pairs_that_may_meet(const Rigid& rigid, int dimensions)
{
    std::vector<double> radii;
    std::vector<AlignedBox> boxes;
    for (const Body& body : rigid.bodies) {
        radii.push_back(bounding_radius(body, dimensions));
        boxes.push_back(AlignedBox{body.position, body.position}.grown(radii.back()));
    }
    const BoxTree tree = tree_over(boxes);
    std::vector<std::pair<int, int>> pairs;
    std::vector<int> near;
    for (int a = 0; a < static_cast<int>(boxes.size()); ++a) {
        find_near(tree, boxes[at(a)], near);
        for (const int b : near) {
            const Vec3 way = rigid.bodies[at(a)].position - rigid.bodies[at(b)].position;
            if (b > a && way.squaredNorm() <= sq(radii[at(a)] + radii[at(b)])) {
                pairs.emplace_back(a, b);
            }
        }
    }
    return pairs;
}

void check_overlaps(const Scene& scene, std::vector<Diagnostic>& errors)
{
    const Rigid rigid = make_rigid(scene);
    const auto bodies = static_cast<int>(rigid.bodies.size());
    const auto walls = static_cast<int>(scene.walls.size());
    const auto report = [&](int a, const std::string& other, double depth) {
        const BodySettings& body = scene.bodies[at(a)];
        errors.push_back(diagnostic_without_line(
            scene, body.place, table_of(body, at(a)),
            fmt::format("body \"{}\" overlaps {} by {:.3g} m", body.name, other, depth),
            "move it apart, or make it smaller; touching is allowed"));
    };
    for (const auto& [a, b] : pairs_that_may_meet(rigid, scene.dimensions)) {
        const double allowed = allowed_overlap * scene.bodies[at(a)].spacing;
        const double depth = overlap(rigid, a, b, 0);
        if (depth > allowed) {
            report(b, fmt::format("body \"{}\"", scene.bodies[at(a)].name), depth);
        }
    }
    for (int a = 0; a < bodies; ++a) {
        const BodySettings& body = scene.bodies[at(a)];
        for (int w = 0; w < walls; ++w) {
            const Wall& wall = scene.walls[at(w)];
            if (is_clear_of(wall, rigid.bodies[at(a)], scene.dimensions)) {
                continue;
            }
            const double depth =
                std::max(overlap(rigid, a, -1 - w, 0), depth_in_mesh(body, wall, scene.dimensions));
            if (depth > allowed_overlap * body.spacing) {
                report(a, fmt::format("wall \"{}\"", wall.name), depth);
            }
        }
    }
}

void check_step(const Scene& scene, const Plan& plan, std::vector<Diagnostic>& errors)
{
    if (!plan.fluid || !scene.time.step) {
        return;
    }
    const double limit = stable_cfl * plan.fluid->h / plan.fluid->eos.c0;
    if (*scene.time.step > limit) {
        errors.push_back(diagnostic_without_line(
            scene, {}, "time.step",
            fmt::format("{} s is longer than the stability limit of the fluid, {:.3g} s",
                        *scene.time.step, limit),
            "omit `time.step` for an adaptive step"));
    }
}

// A body that is not convex and has no lattice of its own meets others by one.
void warn_about_staircase(const Scene& scene, std::size_t b, Plan& plan)
{
    const BodySettings& body = scene.bodies[b];
    const bool mesh = std::holds_alternative<MeshShape>(body.shape);
    const bool particles = std::holds_alternative<ParticleShape>(body.shape);
    if (!mesh && !particles) {
        return;
    }
    const ContactShape shape = contact_shape(body, scene.dimensions);
    const auto* compound = std::get_if<Compound>(&shape);
    const std::size_t parts = compound != nullptr ? compound->parts.size() : 1;
    if (mesh && compound != nullptr) {
        warn(scene, body.place, table_of(body, b),
             fmt::format("body \"{}\" is not convex: for contact it consists of {} boxes of its "
                         "particle lattice, a staircase with steps of {:.3g} m",
                         body.name, parts, body.spacing),
             "a smaller `spacing` of the body gives finer steps", plan);
    }
    constexpr std::size_t many = 1000;
    if (parts > many) {
        warn(scene, body.place, table_of(body, b),
             fmt::format("body \"{}\" has {} parts for contact, which is slow", body.name, parts),
             mesh ? "a larger `spacing` of the body gives fewer parts"
                  : "particles on a lattice are merged into boxes",
             plan);
    }
}

// Whether two boxes share a place, seen from above.
bool share_a_place(const Bounds& a, const Bounds& b, int dimensions)
{
    const auto share = [&](Index axis) {
        return a.max[axis] > b.min[axis] && a.min[axis] < b.max[axis];
    };
    return share(0) && (dimensions == 2 || share(1));
}

// Bodies beside all that could carry them, which is at least a basin: the first of each table.
void warn_about_falls(const Scene& scene, Plan& plan)
{
    std::vector<Bounds> grounds;
    std::string basin;
    for (const Wall& wall : scene.walls) {
        if (std::holds_alternative<PlaneWall>(wall.geometry)) {
            return;
        }
        basin = std::holds_alternative<BasinWall>(wall.geometry) ? wall.name : basin;
        grounds.push_back(bounds(wall, scene.dimensions));
    }
    int told = -1; // line of the table
    for (std::size_t b = 0; b < scene.bodies.size() && !basin.empty(); ++b) {
        const BodySettings& body = scene.bodies[b];
        const Bounds box = bounds(placed(body, scene.dimensions));
        const bool carried = std::ranges::any_of(grounds, [&](const Bounds& ground) {
            return share_a_place(box, ground, scene.dimensions);
        });
        if (!carried && !body.fixed && falls_along_z(scene) && body.place.line != told) {
            warn(scene, body.place, table_of(body, b),
                 fmt::format("body \"{}\" lies outside of the basin \"{}\", and no wall is below "
                             "it: it will fall",
                             body.name, basin),
                 "move it into the basin; `position` is that of its centre", plan);
            told = body.place.line;
        }
    }
}

void warn_about_bodies(const Scene& scene, Plan& plan)
{
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        // Copies of one entry have one place and one warning.
        if (b > 0 && body.place.line == scene.bodies[b - 1].place.line) {
            continue;
        }
        warn_about_staircase(scene, b, plan);
        if (!scene.fluid) {
            continue;
        }
        const double across = thinnest(body.shape, scene.dimensions);
        if (across < 3 * scene.spacing * (1 - 1e-9)) {
            warn(scene, body.place, table_of(body, b),
                 fmt::format("body \"{}\" is {:.3g} m thick, less than 3 spacings ({:.3g} m): "
                             "fluid forces on it are inaccurate and water may pass through it",
                             body.name, across, 3 * scene.spacing),
                 "use a smaller `particles.spacing`", plan);
        }
    }
}

void warn_about_room(const Scene& scene, Plan& plan)
{
    if (scene.most_fluid > 0 && scene.open.empty()) {
        warn(scene, {}, "particles.most", "limits only runs with open sides, and there are none",
             "remove it", plan);
    } else if (scene.most_fluid > 0 && plan.most_fluid > scene.most_fluid) {
        warn(scene, {}, "particles.most",
             fmt::format("{} fluid particles are allowed, but with the open sides the run may "
                         "reach about {}: it would end early",
                         scene.most_fluid, plan.most_fluid),
             "increase it, or increase `particles.spacing`", plan);
    }
}

void warn_about_sound(const Scene& scene, Plan& plan)
{
    const double mach = plan.expected_speed / plan.fluid->eos.c0;
    if (mach > 0.1 * (1 + 1e-9)) {
        warn(scene, {}, "fluid.sound_speed",
             fmt::format("{:.4g} m/s is only {:.1f} times the largest expected speed ({:.3g} m/s): "
                         "densities will vary by about {:.1f} %",
                         plan.fluid->eos.c0, 1 / mach, plan.expected_speed, 100 * sq(mach)),
             fmt::format("10 times the largest expected speed is {:.3g} m/s",
                         10 * plan.expected_speed),
             plan);
    }
}

// Contact knows no hollow ball.
void warn_about_round_walls(const Scene& scene, Plan& plan)
{
    for (std::size_t w = 0; plan.rigid && w < scene.walls.size(); ++w) {
        if (std::holds_alternative<RoundWall>(scene.walls[w].geometry)) {
            warn(scene, scene.walls[w].place, table_of(scene.walls[w], w),
                 fmt::format(
                     "bodies do not collide with the round basin \"{}\" but with its bounding box",
                     scene.walls[w].name),
                 "keep bodies away from it", plan);
        }
    }
}

// Cells of the fluid are of the spacing, or one where less than one fits.
void warn_about_narrow_basins(const Scene& scene, Plan& plan)
{
    constexpr double least = 3; // spacings
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const auto* basin = std::get_if<BasinWall>(&scene.walls[w].geometry);
        for (const int axis : {0, 1}) {
            if (basin == nullptr || (scene.dimensions == 2 && axis == 1)) {
                continue;
            }
            const double across = basin->max[axis] - basin->min[axis];
            if (across < least * scene.spacing * (1 - 1e-9)) {
                warn(scene, scene.walls[w].place, table_of(scene.walls[w], w),
                     fmt::format("the basin \"{}\" is {:.3g} m wide along {}, {:.2g} spacings: the "
                                 "water in it is not resolved",
                                 scene.walls[w].name, across, "xy"[axis], across / scene.spacing),
                     fmt::format("use a `particles.spacing` of at most {:.3g} m", across / least),
                     plan);
            }
        }
    }
}

void warn_about_cfl(const Scene& scene, Plan& plan)
{
    if (!scene.time.step && scene.time.cfl > stable_cfl) {
        warn(scene, {}, "time.cfl",
             fmt::format("{:.4g} makes steps longer than the stability limit of the fluid, which "
                         "is at {:.2g}",
                         scene.time.cfl, stable_cfl),
             "omit it to use the default", plan);
    }
}

// Limits of a folder of frames and of the length of a run: larger numbers are typing mistakes.
void check_outputs(const Scene& scene, const Plan& plan, std::vector<Diagnostic>& errors)
{
    constexpr double most_frames = 1e7;
    constexpr double most_steps = 1e15; // beyond about 9e15 a double no longer counts them
    if (!(plan.frames <= most_frames)) {
        errors.push_back(diagnostic_without_line(
            scene, {}, "output.every",
            fmt::format("gives about {:.2g} frames, at most {:.0g} are allowed", plan.frames,
                        most_frames),
            fmt::format("use a larger `output.every`, for instance {:.3g}", scene.time.end / 100)));
    }
    if (!(plan.expected_steps <= most_steps)) {
        const auto least = std::ranges::min_element(plan.limits, {}, &TimeLimit::dt);
        errors.push_back(diagnostic_without_line(
            scene, {}, "time.end",
            fmt::format("with steps of {:.2g} s the run would take about {:.2g} steps, at most "
                        "{:.0g} are allowed",
                        plan.first_step, plan.expected_steps, most_steps),
            scene.time.step || least == plan.limits.end()
                ? "set an earlier `time.end`, or a longer `time.step`"
                : fmt::format("set an earlier `time.end`; the time step is short because of the {} "
                              "limit, see `hyoryu describe time.cfl`",
                              least->name)));
    }
}

void check_periods(const Scene& scene, std::vector<Diagnostic>& errors)
{
    if (!scene.domain || std::ranges::none_of(scene.domain->periodic, std::identity{})) {
        return;
    }
    if (!scene.bodies.empty()) {
        errors.push_back(diagnostic_without_line(
            scene, {}, "domain.periodic", "bodies in periodic domains are not supported",
            "remove the bodies, or replace the periodic sides by walls"));
    }
}

// A block in which a cell fits lost its particles to walls.
void check_fluid(const Scene& scene, const PlanFacts& facts, std::vector<Diagnostic>& errors)
{
    if (!scene.fluid || facts.fluid > 0 || !scene.open.empty()) {
        return;
    }
    const bool fits = std::ranges::any_of(scene.fluid->blocks, [&](const FluidBlock& block) {
        const Bounds box = bounds(placed(block, scene.dimensions));
        const Vec3 size = box.max - box.min;
        return size.x() >= scene.spacing && size.z() >= scene.spacing &&
               (scene.dimensions == 2 || size.y() >= scene.spacing);
    });
    errors.push_back(
        fits ? diagnostic_without_line(
                   scene, {}, "fluid", "all particles of the blocks lie inside walls",
                   "move the blocks in front of the walls; `normal` of a plane points to the fluid")
             : diagnostic_without_line(
                   scene, {}, "fluid",
                   fmt::format("no particle fits into the blocks at a spacing of {:.3g} m",
                               scene.spacing),
                   "decrease `particles.spacing`, or enlarge the blocks; lengths are in metres"));
}

// Water at rest a depth d below its surface has the density rho0 exp(g d / c0^2), which must stay
// a number in single precision. A speed of sound that is too slow for a flow only makes its run
// unstable, which the run tells with step, time and particle.
void check_sound(const Scene& scene, const PlanFacts& facts, const Plan& plan,
                 std::vector<Diagnostic>& errors)
{
    constexpr double most = 80; // exp(80) = 6e34 of 3e38
    if (plan.fluid && facts.deepest > 0 &&
        scene.gravity.norm() * facts.deepest > most * sq(plan.fluid->eos.c0)) {
        errors.push_back(diagnostic_without_line(
            scene, {}, "fluid.sound_speed",
            fmt::format("at {:.4g} m/s, the density would overflow below {:.3g} m of water",
                        plan.fluid->eos.c0, facts.deepest),
            fmt::format("10 times the largest expected speed is {:.3g} m/s",
                        10 * plan.expected_speed)));
    }
}

} // namespace

void check_plan(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    std::vector<Diagnostic> errors = facts.faults;
    check_overlaps(scene, errors);
    check_periods(scene, errors);
    check_step(scene, plan, errors);
    check_densities(scene, errors);
    check_sound(scene, facts, plan, errors);
    check_outputs(scene, plan, errors);
    check_gauges(scene, facts, plan, errors);
    check_open(scene, facts, plan, errors);
    if (facts.faults.empty()) { // which tell better why a block is empty
        check_fluid(scene, facts, errors);
    }
    if (scene.most_fluid > 0 && plan.counts.fluid > scene.most_fluid) {
        errors.push_back(
            diagnostic_without_line(scene, {}, "particles.most",
                                    fmt::format("the run starts with {} fluid particles, more "
                                                "than the {} that are allowed",
                                                plan.counts.fluid, scene.most_fluid),
                                    "increase it, or increase `particles.spacing`"));
    }
    if (!errors.empty()) {
        show_places(scene, errors);
        throw CaseError(errors);
    }
    warn_about_units(scene, plan);
    warn_about_slips(scene, plan);
    warn_about_thin_walls(scene, plan);
    warn_about_bodies(scene, plan);
    warn_about_falls(scene, plan);
    warn_about_round_walls(scene, plan);
    warn_about_waves(scene, facts, plan);
    if (scene.fluid) {
        warn_about_covered_walls(scene, facts, plan);
        warn_about_sound(scene, plan);
        warn_about_cfl(scene, plan);
        warn_about_narrow_basins(scene, plan);
        warn_about_room(scene, plan);
        warn_about_leaks(scene, facts, plan);
        warn_about_gaps(scene, facts, plan);
    }
}

} // namespace hyoryu
