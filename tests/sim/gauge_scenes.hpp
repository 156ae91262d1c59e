// SPDX-License-Identifier: MIT
// Scenes with gauges of all kinds, drawn at random.
#pragma once

#include "dice.hpp"
#include "runs.hpp"

#include <fmt/format.h>

#include <array>
#include <string>

namespace hyoryu::gauge_scenes {

/// A scene of the family: water that falls beside a crate, towards a wall that may move.
struct Family {
    int dimensions;
    double spacing;
    std::string periodic; // axes, as the case file has them
    bool moving;          // whether the wall at the end moves
    std::string walls;    // free_slip or no_slip
};

inline std::string basin(const Family& f)
{
    // A periodic axis has no walls; the third axis of a basin is open above.
    const auto closed = [&](char axis) { return f.periodic.find(axis) == std::string::npos; };
    std::string open = "\"+z\"";
    for (const char axis : {'x', 'y'}) {
        open += closed(axis) ? "" : fmt::format(", \"-{0}\", \"+{0}\"", axis);
    }
    return fmt::format("[[wall]]\nname = \"basin\"\nshape = \"basin\"\nmin = [0.0, 0.0, 0.0]\n"
                       "max = [1.2, 0.4, 0.7]\nopen = [{}]\n",
                       open);
}

/// Bodies do not go through the sides of a domain.
inline bool has_body(const Family& f)
{
    return f.periodic.empty();
}

inline std::string scene(const Family& f)
{
    return fmt::format(
               "dimensions = {}\n[time]\nend = 1.0\n[particles]\nspacing = {}\n[domain]\n"
               "min = [0.0, 0.0, -0.2]\nmax = [1.2, 0.4, 1.0]\nperiodic = [{}]\n[fluid]\n"
               "walls = \"{}\"\n[fluid.viscosity]\nmodel = \"laminar\"\nkinematic = 1e-3\n"
               "[[fluid.block]]\nshape = \"box\"\nmin = [0.0, 0.0, 0.0]\nmax = [0.5, 0.4, 0.4]\n"
               "velocity = [1.5, 0.3, 0.0]\n",
               f.dimensions, f.spacing, f.periodic, f.walls) +
           basin(f) +
           fmt::format("[[wall]]\nname = \"pier\"\nshape = \"box\"\nmin = [0.8, 0.1, 0.0]\n"
                       "max = [1.0, 0.3, 0.5]\n{}",
                       f.moving ? "[wall.motion]\nvelocity = [-0.2, 0.0, 0.0]\n" : "") +
           (has_body(f) ? "[[body]]\nname = \"crate\"\nshape = \"box\"\nsize = [0.2, 0.2, 0.2]\n"
                          "density = 400.0\nposition = [0.62, 0.2, 0.11]\n"
                        : "");
}

/// Of every kind, anywhere: in the water, at its rim, in walls and above all of them.
inline std::string random_gauge(Dice& dice, int k, const Family& f)
{
    const double y = f.dimensions == 2 ? 0.0 : dice.between(0, 0.4);
    const Vec3 place{dice.between(0, 1.2), y, dice.between(0, 0.6)};
    const Vec3 way{dice.between(0.1, 1), f.dimensions == 2 ? 0.0 : dice.between(-1, 1),
                   dice.between(-1, 1)};
    const std::string at = fmt::format("at = [{}, {}, {}]\n", place.x(), place.y(), place.z());
    const std::string normal = fmt::format("normal = [{}, {}, {}]\n", way.x(), way.y(), way.z());
    const std::string head = fmt::format("[[gauge]]\nname = \"g{}\"\n", k);
    switch (k % 7) {
    case 0:
        return head + "type = \"elevation\"\n" + at;
    case 1:
        return head + "type = \"pressure\"\n" + at;
    case 2:
        return head + fmt::format("type = \"pressure\"\narea = {}\n", dice.between(0.001, 0.2)) +
               at + normal;
    case 3:
        return head + "type = \"velocity\"\n" + at;
    case 4:
        return head + "type = \"flux\"\n" + at + normal;
    case 5:
        return head + fmt::format("type = \"front\"\naxis = \"{}\"\n", "xyz"[dice.below(3)]);
    default:
        return head +
               fmt::format(
                   "type = \"force\"\non = \"{}\"\n",
                   std::array{"basin", "pier",
                              "crate"}[static_cast<std::size_t>(dice.below(has_body(f) ? 3 : 2))]);
    }
}

} // namespace hyoryu::gauge_scenes
