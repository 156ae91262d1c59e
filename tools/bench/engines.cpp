// SPDX-License-Identifier: MIT
#include "engine.hpp"

namespace hyoryu::bench {

std::vector<Engine> engines()
{
    std::vector<Engine> all = hyoryu_engines();
    const auto add = [&all](const std::vector<Engine>& more) {
        all.insert(all.end(), more.begin(), more.end());
    };
#ifdef HYORYU_BENCH_BULLET
    add(bullet_engines());
#endif
#ifdef HYORYU_BENCH_ODE
    add(ode_engines());
#endif
#ifdef HYORYU_BENCH_MUJOCO
    add(mujoco_engines());
#endif
    return all;
}

} // namespace hyoryu::bench
