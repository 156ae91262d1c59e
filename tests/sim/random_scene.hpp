// SPDX-License-Identifier: MIT
// Scenes drawn at random: a basin with or without fluid, and bodies of any place, shape, density
// and motion. A scene follows from its seed alone.
#pragma once

#include "../dice.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace hyoryu::random_scene {

inline constexpr double spacing = 0.04;
inline constexpr double length = 2.0;
inline constexpr double height = 1.2;
inline constexpr double pitch = 0.4; // of the places where bodies start: none overlaps another

// One draw a statement: the order of arguments is the compiler's.
inline std::string fluid_of(Dice& dice, double width)
{
    const char* formulation = dice.chance(0.2) ? "mps" : "sph";
    const double alpha = dice.between(0.01, 0.1);
    const double depth = dice.between(0.2, 0.6);
    const double speed = dice.chance(0.3) ? dice.between(0, 1.5) : 0;
    return fmt::format("[fluid]\nformulation = \"{}\"\n[fluid.viscosity]\nalpha = {}\n"
                       "[[fluid.block]]\nshape = \"box\"\nmin = [0, 0, 0]\n"
                       "max = [{}, 0, {}]\nvelocity = [{}, 0, 0]\n",
                       formulation, alpha, width, depth, speed);
}

inline std::string shape_of(Dice& dice)
{
    const double least = 3 * spacing;
    const double most = pitch / 1.5; // its diagonal stays within its place
    const double a = dice.between(least, most);
    const double b = dice.between(least, most);
    return dice.chance(0.5) ? fmt::format("shape = \"box\"\nsize = [{}, 1, {}]\n", a, b)
                            : fmt::format("shape = \"sphere\"\nradius = {}\n", 0.5 * a);
}

inline std::string body_of(Dice& dice, int k, double x, double z)
{
    const std::string shape = shape_of(dice);
    const double density = std::pow(10.0, dice.between(1.7, 3.7));
    const double angle = dice.between(0, 360);
    const double vx = dice.between(-2, 2);
    const double vz = dice.between(-2, 2);
    const double spin = dice.between(-10, 10);
    return fmt::format("[[body]]\nname = \"body{}\"\n{}density = {}\nposition = [{}, 0, {}]\n"
                       "rotation_deg = {{ axis = [0, 1, 0], angle = {} }}\n"
                       "velocity = [{}, 0, {}]\nangular_velocity = [0, {}, 0]\n",
                       k, shape, density, x, z, angle, vx, vz, spin);
}

inline std::string bodies_of(Dice& dice, double first)
{
    std::string text;
    int count = 0;
    for (double z = 0.5 * pitch; z < height; z += pitch) {
        for (double x = first + 0.5 * pitch; x <= length - 0.5 * pitch; x += pitch) {
            text += dice.chance(0.5) ? body_of(dice, count++, x, z) : "";
        }
    }
    return text;
}

inline std::string scene_of(std::uint64_t seed)
{
    Dice dice(seed);
    const double width = dice.between(0.3, 0.9);
    const bool wet = dice.chance(0.8);
    const double restitution = dice.between(0, 0.8);
    const double friction = dice.between(0, 0.8);
    std::string text = fmt::format("title = \"scene {}\"\ndimensions = 2\n[time]\nend = 0.4\n"
                                   "[particles]\nspacing = {}\n[contact]\nrestitution = {}\n"
                                   "friction = {}\n[output]\nevery = 0.1\n[[wall]]\n"
                                   "name = \"basin\"\nshape = \"basin\"\nmin = [0, 0, 0]\n"
                                   "max = [{}, 0, {}]\nopen = [\"+z\"]\n",
                                   seed, spacing, restitution, friction, length, height);
    text += wet ? fluid_of(dice, width) : "";
    return text + bodies_of(dice, wet ? width : 0);
}

} // namespace hyoryu::random_scene
