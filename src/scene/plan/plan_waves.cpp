// SPDX-License-Identifier: MIT
#include "plan_waves.hpp"

#include "plan_warnings.hpp"

#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

constexpr double highest = 0.78;   // height of a wave over the depth (McCowan 1894)
constexpr double steepest = 0.142; // height over length in deep water (Miche 1944)
// Accepted differences of a depth from the requested one: cells are rounded to a spacing, and the
// ground may slope.
constexpr double spacings_off = 1;
constexpr double share_off = 0.02;

void look_at_height(const Scene& scene, const Wall& wall, const std::string& key, Plan& plan)
{
    const PistonTarget& wave = wall.wave;
    if (!(wave.length > 0)) {
        return;
    }
    const std::string name = wave.period > 0 ? "height" : "solitary_height";
    const double number = 2 * std::numbers::pi / wave.length;
    const double steep = steepest * std::tanh(number * wave.depth);
    if (wave.height > highest * wave.depth) {
        warn(scene, wall.place, fmt::format("{}.piston.{}", key, name),
             fmt::format("a wave height of {:.3g} m is {:.2f} of the depth of {:.3g} m, "
                         "above the limit of {}: the wave breaks immediately",
                         wave.height, wave.height / wave.depth, wave.depth, highest),
             fmt::format("use a height below {:.3g} m, or deeper water", highest * wave.depth),
             plan);
    } else if (wave.period > 0 && wave.height > steep * wave.length) {
        warn(scene, wall.place, key + ".piston.height",
             fmt::format("a wave height of {:.3g} m is {:.3f} of the wavelength of {:.3g} "
                         "m, above the limit of {:.3f}: the wave breaks immediately",
                         wave.height, wave.height / wave.length, wave.length, steep),
             fmt::format("use a height below {:.3g} m, or a longer `period`", steep * wave.length),
             plan);
    }
}

// `before`: the heights of the particles before the face of the wall.
void look_at_depth(const Scene& scene, const Span& before, const Wall& wall, const std::string& key,
                   Plan& plan)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    const double asked = wall.wave.length > 0     ? wall.wave.depth
                         : wall.motion.absorption ? wall.motion.absorption->depth
                                                  : 0;
    if (solid == nullptr || !(asked > 0) || !scene.open.empty()) {
        return;
    }
    const double found = before.empty() ? 0 : before.highest - before.lowest + scene.spacing;
    const std::string own = key + (wall.wave.length > 0 ? ".piston.depth" : ".depth");
    if (found == 0) {
        warn(scene, wall.place, own,
             fmt::format("there is no water at the +x side of \"{}\"", wall.name),
             "a paddle generates waves along +x: the water must begin at its face", plan);
    } else if (std::abs(found - asked) > spacings_off * scene.spacing + share_off * asked) {
        warn(scene, wall.place, own,
             fmt::format("{:.3g} m, but the water in front of \"{}\" is {:.3g} m deep at "
                         "the start: the wave will not have the specified height",
                         asked, wall.name, found),
             "give the depth of the water at rest", plan);
    }
}

void look_at_sponge(const Scene& scene, const PlanFacts& facts, std::size_t k, Plan& plan)
{
    const Sponge& sponge = scene.sponges[k];
    const std::string key = fmt::format("sponge[{}]", k);
    if (!scene.fluid) {
        warn(scene, sponge.place, key, "has no effect: the scene has no fluid", "omit it", plan);
    } else if (scene.open.empty() && facts.sponge_is_wet[k] == 0) {
        warn(scene, sponge.place, key, "there is no water in the sponge at the start",
             "`min` and `max` are the corners of a box in the water, in m", plan);
    }
}

} // namespace

void warn_about_waves(const Scene& scene, const PlanFacts& facts, Plan& plan)
{
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        const Wall& wall = scene.walls[w];
        const std::string key = table_of(wall, w) + ".motion";
        look_at_height(scene, wall, key, plan);
        if (scene.fluid) {
            look_at_depth(scene, facts.before_paddle[w], wall, key, plan);
        } else if (wall.motion.absorption) {
            warn(scene, wall.place, key + ".absorb", "has no effect: the scene has no fluid",
                 "omit it", plan);
        }
    }
    for (std::size_t k = 0; k < scene.sponges.size(); ++k) {
        look_at_sponge(scene, facts, k, plan);
    }
}

} // namespace hyoryu
