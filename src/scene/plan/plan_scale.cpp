// SPDX-License-Identifier: MIT
#include "plan_scale.hpp"

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/flotation.hpp"
#include "hyoryu/scene/rigid_scene.hpp"
#include "plan_columns.hpp"
#include "plan_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

constexpr double least_reynolds = 100;
// Spacings over which the pressure of a load must spread to be seen.
constexpr double load_spacings = 4;
// A gate within this times sqrt(d/g) lets the water go as if it vanished (Lauber and Hager 1998).
constexpr double sudden = 1.25;
// Turned by less than this a body floats as it was placed.
constexpr double upright = 0.5 * std::numbers::pi / 180;
// A mesh of more triangles is not searched for the side that it turns up.
constexpr std::size_t most_triangles = 20000;

bool is_too_fine(const Shape& shape)
{
    const auto* mesh = std::get_if<MeshShape>(&shape);
    return mesh != nullptr && mesh->triangles.size() > most_triangles;
}

// Bodies of one entry, which float alike.
bool floats_like(const BodySettings& a, const BodySettings& b)
{
    return a.place.line == b.place.line && a.place.line > 0 && a.mass == b.mass &&
           a.centre_of_mass == b.centre_of_mass &&
           (a.rotation * Vec3::UnitZ()).isApprox(b.rotation * Vec3::UnitZ(), 1e-9);
}

std::string direction_name(const Vec3& up)
{
    Index axis = 0;
    const double most = up.cwiseAbs().maxCoeff(&axis);
    const std::string name = fmt::format("{}{}", up[axis] < 0 ? "-" : "+", "xyz"[axis]);
    constexpr double aligned = 0.999;
    return most > aligned ? fmt::format("its {} side up", name)
                          : fmt::format("an edge of its {} side up", name);
}

std::string way_of(const Floating& floating)
{
    const std::string after = fmt::format(", with a draft of {:.3g} m and a GM of {:.3g} m",
                                          floating.at_rest.draft, floating.at_rest.metacentre);
    if (floating.tilt < upright) {
        return "floats as it is placed";
    }
    return fmt::format("turns by {:.0f} deg and floats with {}{}",
                       floating.tilt * 180 / std::numbers::pi, direction_name(floating.at_rest.up),
                       after);
}

void list_body(const Scene& scene, std::size_t b, Plan& plan)
{
    const BodySettings& body = scene.bodies[b];
    const bool held = body.fixed || body.locks[2];
    const auto floating =
        held || is_too_fine(body.shape)
            ? std::nullopt
            : flotation(body, scene.fluid->density, scene.gravity, scene.dimensions);
    if (!floating) {
        return;
    }
    const bool turns = !(body.locks[3] && body.locks[4] && body.locks[5]);
    const double spacings = floating->as_placed.draft / scene.spacing;
    plan.floating.push_back({body.name, 1, floating->as_placed.draft, spacings,
                             floating->as_placed.metacentre,
                             turns ? way_of(*floating) : "cannot turn"});
    if (spacings < 1) {
        warn(
            scene, body.place, table_of(body, b),
            fmt::format("body \"{}\" floats with a draft of {:.2g} spacings: {:.3g} m is below the "
                        "spacing of {:.3g} m; its weight is correct, its draft is not resolved",
                        body.name, spacings, floating->as_placed.draft, scene.spacing),
            "use a smaller `particles.spacing` where the draft matters", plan);
    }
    if (floating->as_placed.metacentre < 0 && turns) {
        warn(scene, body.place, table_of(body, b),
             fmt::format("body \"{}\" will not float upright: its metacentric height is {:.3g} m; "
                         "it {}",
                         body.name, floating->as_placed.metacentre, way_of(*floating)),
             "lower the centre of mass, or start the body as it floats, unless it is meant to tip",
             plan);
    }
}

double thinnest_of(const Scene& scene)
{
    double thin = 0;
    for (const BodySettings& body : scene.bodies) {
        const Bounds box = bounds({.shape = &body.shape, .dimensions = scene.dimensions});
        Vec3 size = box.max - box.min;
        if (scene.dimensions == 2) {
            size.y() = infinity;
        }
        thin = thin > 0 ? std::min(thin, size.minCoeff()) : size.minCoeff();
    }
    return thin;
}

// The highest particle of the water in the columns that a box covers, -infinity without one [m].
double top_over(const Columns& water, const Bounds& box)
{
    const Columns::Number low = water.number_of(box.min);
    const Columns::Number high = water.number_of(box.max);
    double top = -infinity;
    for (long long i = low[0]; i <= high[0]; ++i) {
        const auto end = water.spans().upper_bound({i, high[1]});
        for (auto at = water.spans().lower_bound({i, low[1]}); at != end; ++at) {
            if (water.reaches(at->first, box.max.z())) {
                top = std::max(top, at->second.highest);
            }
        }
    }
    return top;
}

// Time from its start until a gate has risen to the water level; 0 if it is none.
double opening_time(const Motion& motion, double depth)
{
    const bool vertical =
        !motion.times.empty() &&
        std::ranges::all_of(motion.places,
                            [](const Vec3& p) { return p.head<2>().isZero(0) && p.z() >= 0; }) &&
        motion.places.back().z() > 0;
    if (!vertical) {
        return 0;
    }
    double low = motion.times.front();
    double high = motion.times.back();
    if (motion.places.back().z() < depth) {
        return high - low;
    }
    const double start = low;
    for (int n = 0; n < 60; ++n) {
        const double middle = 0.5 * (low + high);
        (displacement(motion, middle).z() < depth ? low : high) = middle;
    }
    return high - start;
}

void check_gate(const Scene& scene, const Wall& wall, double top, Plan& plan)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    const double g = scene.gravity.norm();
    if (solid == nullptr || !(g > 0)) {
        return;
    }
    const double bottom = bounds(wall, scene.dimensions).min.z();
    const double depth = top + scene.spacing / 2 - bottom;
    const double opens = depth > 0 ? opening_time(wall.motion, depth) : 0;
    const bool leaves = !wall.motion.places.empty() && wall.motion.places.back().z() >= depth;
    const double limit = depth > 0 ? sudden * std::sqrt(depth / g) : 0;
    if (opens > limit) {
        warn(scene, wall.place, "wall.motion",
             fmt::format("the gate \"{}\" takes {:.3g} s to rise {} {:.3g} m of water: a dam "
                         "break is sudden within 1.25 sqrt(d/g) = {:.3g} s",
                         wall.name, opens, leaves ? "out of" : "within", depth, limit),
             "use a faster gate, unless a slow one is intended", plan);
    }
}

} // namespace

void list_floating(const Scene& scene, Plan& plan)
{
    for (std::size_t b = 0; scene.fluid && b < scene.bodies.size(); ++b) {
        if (b > 0 && floats_like(scene.bodies[b - 1], scene.bodies[b])) {
            if (!plan.floating.empty()) {
                ++plan.floating.back().count;
            }
            continue;
        }
        list_body(scene, b, plan);
    }
}

void check_submerged(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    if (!scene.fluid || scene.bodies.empty()) {
        return;
    }
    std::size_t count = 0;
    std::size_t first = 0;
    double deepest = 0; // of the water over the first one [m]
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        const Bounds box = bounds(placed(body, scene.dimensions));
        const double over = top_over(facts.water, box) + scene.spacing / 2 - box.max.z();
        const bool held = body.fixed || body.locks[2];
        if (!(over > scene.spacing / 2) || held || is_too_fine(body.shape) ||
            !flotation(body, scene.fluid->density, scene.gravity, scene.dimensions)) {
            continue;
        }
        first = count == 0 ? b : first;
        deepest = count == 0 ? over : deepest;
        ++count;
    }
    if (count > 0) {
        const BodySettings& body = scene.bodies[first];
        warn(scene, body.place, table_of(body, first),
             fmt::format("body \"{}\"{} starts under {:.3g} m of water and is lighter than water: "
                         "it will rise rapidly",
                         body.name, count > 1 ? fmt::format(", like {} others,", count - 1) : "",
                         deepest),
             "place it at the surface or on dry ground, unless this is intended", plan);
    }
}

void list_scale(const Scene& scene, const PlanFacts& facts, double viscosity, Plan& plan)
{
    if (!plan.fluid || facts.fluid == 0) {
        return;
    }
    Plan::Scale scale;
    scale.depth = facts.deepest + scene.spacing / 2;
    scale.layers = scale.depth / scene.spacing;
    scale.thinnest = thinnest_of(scene);
    scale.speed = plan.expected_speed;
    scale.shortest_load = load_spacings * scene.spacing / plan.fluid->eos.c0;
    scale.viscosity = viscosity;
    scale.reynolds = viscosity > 0 ? scale.speed * scale.depth / viscosity : infinity;
    scale.absent = {"air: single phase, no air cushions and no entrained air"};
    if (!scene.bodies.empty()) {
        scale.absent.emplace_back("ingress: no water enters bodies, so none fills and sinks");
        scale.absent.emplace_back("breaking: bodies and walls are rigid");
    }
    scale.absent.emplace_back("erosion: the ground does not change");
    // In water thinner than half a spacing there are no eddies.
    const bool has_depth = scale.depth > 0;
    if (has_depth && scale.reynolds < least_reynolds && scene.gravity.norm() > 0) {
        warn(scene, {}, "fluid.viscosity",
             fmt::format("the effective Reynolds number u d/nu is {:.3g}: {:.3g} m/s x {:.3g} m / "
                         "{:.3g} m2/s, the viscosity of the scheme; eddies are damped",
                         scale.reynolds, scale.speed, scale.depth, viscosity),
             "use a smaller `particles.spacing` or `fluid.viscosity.alpha`", plan);
    }
    plan.scale = std::move(scale);
}

void check_waves(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    double longest = 0;
    for (const Wall& wall : scene.walls) {
        longest = std::max(longest, wall.wave.length);
    }
    for (const Sponge& sponge : scene.sponges) {
        const int axis = sponge.side / 2;
        const double length = sponge.max[axis] - sponge.min[axis];
        if (longest > length) {
            warn(scene, sponge.place, "sponge",
                 fmt::format("the sponge is {:.3g} m long, shorter than the wavelength of {:.3g} "
                             "m: much of the wave will be reflected",
                             length, longest),
                 "use a longer sponge, or a paddle with `absorb`", plan);
        }
    }
    for (const Wall& wall : scene.walls) {
        if (moves(wall.motion) && facts.fluid > 0) {
            check_gate(scene, wall, facts.z.highest, plan);
        }
    }
}

} // namespace hyoryu
