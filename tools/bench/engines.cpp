// SPDX-License-Identifier: MIT
#include "engine.hpp"

namespace hyoryu::bench {

std::vector<Engine> engines()
{
    std::vector<Engine> all;
    for (const auto& some : {
             hyoryu_engines(),
#ifdef HYORYU_BENCH_BULLET
             bullet_engines(),
#endif
#ifdef HYORYU_BENCH_ODE
             ode_engines(),
#endif
#ifdef HYORYU_BENCH_MUJOCO
             mujoco_engines(),
#endif
         }) {
        all.insert(all.end(), some.begin(), some.end());
    }
    return all;
}

} // namespace hyoryu::bench
