// SPDX-License-Identifier: MIT
#include "plan_units.hpp"

#include "plan_warnings.hpp"

#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

// Foam has 10 kg/m3; less than half of that is a ratio. Osmium has 22,590 kg/m3.
constexpr double least_density = 5, largest_density = 23'000;
constexpr double no_density = 1e-9;                     // a billionth of air
constexpr double largest_friction = 2;                  // rubber on concrete has 1
constexpr double largest_sound = 100, usual_sound = 10; // in speeds of the flow

void look_at_density(const Scene& scene, double density, const Place& place, const std::string& key,
                     Plan& plan)
{
    if (density < least_density) {
        warn(scene, place, key,
             fmt::format("{:.4g} kg/m3 is lower than the density of any solid or liquid", density),
             density * 1000 >= least_density
                 ? fmt::format("if it is a ratio to water, write {:.6g}; a `mass` is in kg",
                               density * 1000)
                 : "densities are in kg/m3, water has 1000; a `mass` is in kg",
             plan);
    } else if (density > largest_density) {
        warn(scene, place, key,
             fmt::format("{:.4g} kg/m3 is higher than the density of any material", density),
             "densities are in kg/m3, steel has 7850; a `mass` is in kg", plan);
    }
}

// Calls f(density, place, key) with that of the fluid and of each body; copies count once.
void for_each_density(const Scene& scene, const auto& f)
{
    if (scene.fluid) {
        f(scene.fluid->density, Place{}, std::string("fluid.density"));
    }
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySettings& body = scene.bodies[b];
        if (b == 0 || body.place.line != scene.bodies[b - 1].place.line) {
            f(body.density, body.place, table_of(body, b) + ".density");
        }
    }
}

void look_at_friction(const Scene& scene, Plan& plan)
{
    const double friction = scene.contact.friction;
    if (!scene.bodies.empty() && friction > largest_friction) {
        warn(scene, {}, "contact.friction",
             fmt::format("a friction coefficient of {:.4g} is unusually large", friction),
             friction < 90 ? fmt::format("if it is an angle in degrees, write its tangent, {:.3g}",
                                         std::tan(friction * std::numbers::pi / 180))
                           : "it is the ratio of the forces along and across the surface",
             plan);
    }
}

void look_at_sound(const Scene& scene, Plan& plan)
{
    const double speed = plan.expected_speed;
    const double sound = scene.fluid ? scene.fluid->sound_speed.value_or(0) : 0;
    if (speed > 0 && sound > largest_sound * speed) {
        warn(scene, {}, "fluid.sound_speed",
             fmt::format("{:.4g} m/s is {:.3g} times the largest expected speed, {:.3g} m/s: "
                         "the run takes about {:.3g} times as many steps as with the default",
                         sound, sound / speed, speed, sound / (usual_sound * speed)),
             "omit it: the default keeps the density within 1 %, and flows of water do not "
             "need the real speed of sound",
             plan);
    }
}

void look_at_spacing(const Scene& scene, Plan& plan)
{
    for (std::size_t b = 0; scene.fluid && b < scene.fluid->blocks.size(); ++b) {
        const FluidBlock& block = scene.fluid->blocks[b];
        const Bounds box = bounds(placed(block, scene.dimensions));
        Vec3 size = box.max - box.min;
        size.y() = scene.dimensions == 2 ? size.x() : size.y();
        if (size.maxCoeff() < scene.spacing) {
            return warn(scene, {}, "particles.spacing",
                        fmt::format("{:.4g} m is larger than `fluid.block[{}]`, which is {:.3g} "
                                    "m across",
                                    scene.spacing, b, size.maxCoeff()),
                        "lengths are in metres: 20 mm are 0.02, or \"20 mm\"", plan);
        }
    }
}

} // namespace

void check_densities(const Scene& scene, std::vector<Diagnostic>& errors)
{
    for_each_density(scene, [&](double density, const Place& place, const std::string& key) {
        if (density < no_density) {
            errors.push_back(diagnostic_without_line(
                scene, place, key,
                fmt::format("{:.4g} kg/m3 is out of range, expected at least {:.0e} kg/m3", density,
                            no_density),
                "densities are in kg/m3, water has 1000; a `mass` is in kg"));
        }
    });
}

void warn_about_units(const Scene& scene, Plan& plan)
{
    for_each_density(scene, [&](double density, const Place& place, const std::string& key) {
        look_at_density(scene, density, place, key, plan);
    });
    look_at_friction(scene, plan);
    look_at_sound(scene, plan);
    look_at_spacing(scene, plan);
}

} // namespace hyoryu
