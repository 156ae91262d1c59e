// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/time_limit.hpp"

#include "hyoryu/fluid/parameters.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

std::array<TimeLimit, 3> fluid_limits(const FluidParameters& fluid, real top_speed,
                                      real top_acceleration, real nu)
{
    // The default CFL scales the other limits with it.
    const real scale = fluid.cfl / 0.6;
    const real force =
        top_acceleration > 0 ? scale * 0.25 * std::sqrt(fluid.h / top_acceleration) : infinity;
    const real viscous =
        nu > 0 ? scale * 0.125 * sq(fluid.h) / (nu * diffusion_rate(fluid.kernel)) : infinity;
    const real acoustic = fluid.cfl * fluid.h / sound_frequency(fluid.kernel);
    return {TimeLimit{"acoustic", acoustic / (fluid.eos.c0 + top_speed)}, TimeLimit{"force", force},
            TimeLimit{"viscous", viscous}};
}

TimeLimit body_limit(const FluidParameters& fluid, real body_mass, Index surface_particles,
                     real stiffness)
{
    const real wet_mass = static_cast<real>(std::max<Index>(surface_particles, 1)) * fluid.mass;
    const real crossing = fluid.h / (fluid.eos.c0 * sound_frequency(fluid.kernel));
    return {"light body", 2 * crossing * std::sqrt(body_mass / (stiffness * wet_mass))};
}

TimeLimit shortest(std::span<const TimeLimit> limits)
{
    TimeLimit least;
    for (const TimeLimit& limit : limits) {
        if (limit.dt < least.dt) {
            least = limit;
        }
    }
    return least;
}

} // namespace hyoryu
