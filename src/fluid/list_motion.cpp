// SPDX-License-Identifier: MIT
// How far particles have moved since the lists were made.
#include "lists.hpp"

#include <algorithm>

namespace hyoryu {

const Tiles& measured_walls(const Fluid& fluid)
{
    return fluid.moving_walls ? fluid.neighbours.wall : fluid.fixed_walls.candidates;
}

void measure_walls(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    if (fluid.moving_walls) {
        bound_motion(n.wall, fluid.particles.wall[field::position], n.wall_motion.box);
    } else {
        n.wall_motion.box.assign(measured_walls(fluid).tile.size(), {Vec3(0, 0, 0), Vec3(0, 0, 0)});
    }
}

namespace {

// Largest displacement of particles in tiles next to fixed walls, for scenes that also have moving
// walls: tiles of walls that do not exist yet are missing in the lists of touching tiles.
real motion_beside_fixed_walls(const Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const Tiles& walls = fluid.fixed_walls.candidates;
    real most = 0;
    const auto look = [&](const Tiles& tiles, const std::vector<DisplacementBox>& boxes) {
        for (std::size_t t = 0; t < tiles.tile.size(); ++t) {
            const real way = boxes[t].low.cwiseAbs().cwiseMax(boxes[t].high.cwiseAbs()).norm();
            if (way > most) {
                tiles.lattice.for_beside(tiles.tile[t], [&](std::uint64_t number, const auto&) {
                    most = walls.find(number) >= 0 ? way : most;
                });
            }
        }
    };
    look(n.fluid, n.fluid_motion.box);
    look(n.body, n.body_motion.box);
    if (const Ghosts* const g = fluid.ghosts.get()) {
        look(g->fluid.tiles, g->fluid.motion.box);
        look(g->body.tiles, g->body.motion.box);
    }
    return most;
}

// Adds the motion between own tiles and ghosts. A pair of two ranks is measured by at least one of
// them: a pair with walls by the rank that owns the walls.
void add_motion_of_ghosts(Fluid& fluid, Displacement& motion)
{
    FluidNeighbours& n = fluid.neighbours;
    Ghosts& g = *fluid.ghosts;
    DisplacementSpace& f = g.fluid.motion;
    DisplacementSpace& b = g.body.motion;
    motion.fluid = std::max(motion.fluid, relative_motion(f.box, n.fluid_motion.box, f.fluid));
    motion.solid = std::max({motion.solid, relative_motion(f.box, n.wall_motion.box, f.wall),
                             relative_motion(f.box, n.body_motion.box, f.body),
                             relative_motion(b.box, n.wall_motion.box, b.wall),
                             relative_motion(b.box, n.body_motion.box, b.body)});
}

} // namespace

real measure_own(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    const Particles& particles = fluid.particles;
    return std::max(bound_motion(n.fluid, particles.fluid[field::position], n.fluid_motion.box),
                    bound_motion(n.body, particles.body[field::position], n.body_motion.box));
}

// The displacement boxes of ghosts were received with their positions.
Displacement measure(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    DisplacementSpace& f = n.fluid_motion;
    DisplacementSpace& w = n.wall_motion;
    DisplacementSpace& b = n.body_motion;
    Displacement motion;
    motion.absolute = fluid.ghosts ? fluid.ghosts->moved : measure_own(fluid);
    if (fluid.moving_walls || n.steps == 1) { // fixed walls stay where they are
        measure_walls(fluid);
        for (const DisplacementBox& box : w.box) {
            motion.absolute =
                std::max(motion.absolute, box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs()).norm());
        }
    }
    motion.fluid = relative_motion(f.box, f.box, f.fluid);
    motion.solid =
        std::max({relative_motion(f.box, w.box, f.wall), relative_motion(f.box, b.box, f.body),
                  relative_motion(b.box, w.box, b.wall), relative_motion(b.box, b.box, b.body)});
    if (fluid.ghosts) {
        add_motion_of_ghosts(fluid, motion);
    }
    if (fluid.moving_walls) {
        motion.solid = std::max(motion.solid, motion_beside_fixed_walls(fluid));
    }
    std::array most{motion.fluid, motion.solid, motion.absolute};
    largest_of_all(comm_of(fluid), most);
    return {most[0], most[1], most[2]};
}

} // namespace hyoryu
