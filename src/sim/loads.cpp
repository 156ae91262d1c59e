// SPDX-License-Identifier: MIT
#include "hyoryu/sim/loads.hpp"

#include "hyoryu/fluid/sum_units.hpp"

#include "parts.hpp"

namespace hyoryu {

void begin_loads(Simulation& sim)
{
    Loads& loads = sim.loads;
    loads.complete = false;
    const SumUnits units = sum_units(sim.fluid->parameters);
    const FixedUnit f = units.force;
    const FixedUnit t = units.torque;
    if (has_seepage(sim)) {
        cut_slip_of_films(sim.seepage, sim.poses, *sim.fluid);
    }
    if constexpr (is_built<BodyLoad>) {
        collect_loads(*sim.fluid, sim.poses, loads.of_bodies);
    } else {
        loads.of_bodies.begin(0, {f, f, f, t, t, t});
    }
    collect_wall_forces(*sim.fluid, sim.scene.walls.size(), loads.of_walls);
    collect_junctions(sim);
    loads.of_hits.begin(sim.barrier ? sim.rigid.bodies.size() : 0,
                        {f, f, f, t, t, t, fixed_unit(1)});
    if (has_seepage(sim)) {
        return_film_cuts(*sim.fluid, sim.poses, loads.of_bodies, loads.of_walls);
    }
}

void end_loads(Loads& loads, Reduction& all)
{
    const auto add = [&](auto& sums) {
        for (auto& of_owner : sums.end()) {
            all.add(of_owner.each());
        }
    };
    add(loads.of_bodies);
    add(loads.of_walls);
    if (loads.of_junctions.owners() > 0) {
        add(loads.of_junctions);
    }
    add(loads.of_hits);
}

void complete_loads(Simulation& sim)
{
    Loads& loads = sim.loads;
    loads.bodies.resize(sim.rigid.bodies.size());
    for (std::size_t b = 0; b < loads.of_bodies.owners(); ++b) {
        const auto [fx, fy, fz, tx, ty, tz] = loads.of_bodies.of(b);
        loads.bodies[b] = {Vec3(fx, fy, fz), Vec3(tx, ty, tz)};
    }
    loads.walls.resize(sim.scene.walls.size());
    for (std::size_t wall = 0; wall < loads.walls.size(); ++wall) {
        const auto [x, y, z] = loads.of_walls.of(wall);
        loads.walls[wall] = Vec3(x, y, z);
    }
    loads.at_junctions.resize(loads.of_junctions.owners());
    for (std::size_t wall = 0; wall < loads.at_junctions.size(); ++wall) {
        const auto [x, y, z] = loads.of_junctions.of(wall);
        loads.at_junctions[wall] = Vec3(x, y, z);
    }
    if (is_built<SurfaceBarrier> && sim.barrier) {
        share_hits(sim);
    }
    if (has_seepage(sim)) {
        add_joint_loads(sim.seepage, sim.poses, loads.bodies, loads.walls);
    }
    loads.complete = true;
}

void total_loads(Simulation& sim)
{
    Reduction all(sim.fluid ? comm_of(*sim.fluid) : nullptr);
    end_loads(sim.loads, all);
    all.run();
    complete_loads(sim);
}

} // namespace hyoryu
