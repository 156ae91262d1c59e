// SPDX-License-Identifier: MIT
// Scenes with open sides for tests.
#pragma once

#include "hyoryu/core/types.hpp"

#include <fmt/format.h>

#include <string>

namespace hyoryu {

/// A reach of a channel between two open sides. The near side, at x = `from`, opens into +x.
struct Reach {
    int dimensions = 2;
    double spacing = 0.05;
    double from = 0, length = 1.5, width = 0.4, depth = 0.4; // [m]
    double velocity = 0;                                     // of the water at the start [m/s]
    std::string near = "kind = \"absorb\"\n";
    std::string far = "kind = \"absorb\"\n";
    std::string of_fluid; // keys of [fluid]
    bool turned = false;  // the near side is that of the largest x, and all velocities turn
};

inline std::string case_of(const Reach& r)
{
    const double y = r.dimensions == 3 ? r.width : 0;
    const double to = r.from + r.length;
    const auto window = [&](const char* name, bool low, const std::string& keys) {
        const double x = low ? r.from : to;
        return fmt::format("[[open]]\nname = \"{}\"\nmin = [{}, 0.0, 0.0]\nmax = [{}, {}, 1.0]\n"
                           "into = \"{}x\"\n{}",
                           name, x, x, y, low ? '+' : '-', keys);
    };
    return fmt::format(
               "dimensions = {}\n[time]\nend = 100.0\n[particles]\nspacing = {}\n[fluid]\n{}"
               "[fluid.viscosity]\nmodel = \"artificial\"\nalpha = 0.02\n"
               "[[fluid.block]]\nshape = \"box\"\nmin = [{}, 0.0, 0.0]\nmax = [{}, {}, {}]\n"
               "velocity = [{}, 0.0, 0.0]\n[[wall]]\nname = \"bed\"\nshape = \"basin\"\n"
               "min = [{}, 0.0, 0.0]\nmax = [{}, {}, 1.0]\nopen = [\"-x\", \"+x\", \"+z\"]\n",
               r.dimensions, r.spacing, r.of_fluid, r.from, to, y, r.depth,
               r.turned ? -r.velocity : r.velocity, r.from, to, y) +
           window("near", !r.turned, r.near) + window("far", r.turned, r.far);
}

inline std::string inflow(double level, double velocity)
{
    return fmt::format("kind = \"inflow\"\nlevel = {}\nvelocity = {}\n", level, velocity);
}

} // namespace hyoryu
