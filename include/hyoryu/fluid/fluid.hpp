// SPDX-License-Identifier: MIT
// The fluid: its state and the stages of a step. The state is particle columns, neighbour lists and
// the active effects. Each stage evaluates its effects in one sweep over the pairs of a list.
#pragma once

#include "hyoryu/core/timer.hpp"
#include "hyoryu/fluid/fixed_walls.hpp"
#include "hyoryu/fluid/ghosts.hpp"
#include "hyoryu/fluid/list_schedule.hpp"
#include "hyoryu/fluid/pair_loops.hpp"
#include "hyoryu/fluid/parameters.hpp"
#include "hyoryu/fluid/time_limit.hpp"

#include <vector>

namespace hyoryu {

/// Neighbour lists of every pair kind that the scene has, and when they were made.
struct FluidNeighbours {
    Tiles fluid, wall, body;
    PairList fluid_fluid;
    PairList fluid_solid;
    PairList wall_fluid;
    PairList body_fluid;
    PairList body_solid; // particles of different solids, for the pressure in thin films
    PairList wall_body;
    Skins skins;         // of the lists
    long long steps = 0; // since they were made
    DisplacementSpace fluid_motion, wall_motion, body_motion;
    std::vector<std::int32_t> wet_walls; // tiles of walls of which a particle is in any list
    SortSpace space;
    std::vector<std::uint8_t> met;      // by slot: whether it is in any list
    std::vector<std::uint8_t> wet_body; // by point of bodies: whether fluid is near
    std::vector<std::int32_t> owner;    // of solid particles, by slot
    long long builds = 0;
    EntryCounts entries;
    Index visits = 0; // list entries that the sweeps of one step go over
};

/// Data of the pair loops in their precision.
template <class Real>
struct PairData {
    RecordMemory common; // the common records
    RecordMemory wide;   // records of the last pass with more fields
    Index slots = 0;
    std::vector<RecordMemory> local; // records of one block, by thread

    template <class List = Stored>
    Records<List, Real> records()
    {
        return {std::is_same_v<List, Stored> ? common : wide, slots};
    }
};

/// A body particle behind a joint: the part of its film forces along the normal of the joint that
/// the joint replaces. What acts along the joint stays: it is that of the fluid at the rim.
struct FilmCut {
    Index row = 0;
    int face = 0;         // of the body
    int other = 0;        // opposite: a body, or -1 - (index of the boundary)
    bool beside = false;  // the joint is beside the particle: nothing lies opposite
    real part = 0;        // [1]
    real pressure = 0;    // in the joint [Pa]
    Vec3 normal{0, 0, 1}; // of the face, outward
    // Force that the particle did not get, and that the other side gives back [N]; 0 where the
    // particle belongs to another process.
    Vec3 removed{0, 0, 0};
};

/// Sums over the particles that left the domain and were removed from the run.
struct LostParticles {
    Index count = 0;
    Vec3 momentum{0, 0, 0}; // [kg m/s]
    real energy = 0;        // kinetic + potential [J]
    Vec3 force{0, 0, 0};    // viscous, of those of this step: the others' still answer it [N]
};

struct Fluid {
    FluidParameters parameters;
    InstructionSet instruction_set = widest_instruction_set();
    FluidEffects effects;
    Particles particles;
    FixedWalls fixed_walls; // whose particles exist where fluid is near
    Kernel kernel;          // of all pairs in SPH; in MPS of those with solids, and of gauges
    MpsKernel mps_kernel;   // of the pairs of fluid in MPS
    FluidNeighbours neighbours;
    std::variant<PairData<float>, PairData<double>> pair_data; // as the precision says
    Vec3 domain_min{-infinity, -infinity, -infinity};
    Vec3 domain_max{infinity, infinity, infinity};
    Vec3 period{0, 0, 0}; // from domain_min on; 0 along an axis that does not repeat itself [m]
    LostParticles lost;
    bool moving_walls = false; // the caller places their particles, which takes new grids
    std::vector<real> body_particle_mass; // rho0 x volume of a particle of each body [kg]
    /// Where joints carry the pressure between solids, body by body, in the order of the numbers
    /// of the particles; empty while no body has a joint.
    std::vector<FilmCut> film_cuts;
    std::unique_ptr<Ghosts> ghosts; // of other processes; null where this one has the whole case
};

/// Whether friction acts between the fluid and solids.
bool sticks_to_solids(const Fluid& fluid);

/// Whether there are walls, with rows or without, or bodies.
bool has_solids(const Fluid& fluid);

/// Makes the columns that the active effects need, and no others, for the given numbers of
/// particles, and the data of the pair loops in the chosen precision. Particles of solids displace
/// a cube of the spacing until they are given another mass. Fixed walls, which get rows when fluid
/// comes near, must be set before.
void allocate(Fluid& fluid, Index fluid_count, Index wall_count, Index body_count);

// The stages of a step of length dt, in the order of the position-Verlet split: one geometry serves
// the pressure loop and the velocity loop (Zhang, Rezavand & Hu 2020, without the dual time step).

/// rho += dt R, x += dt v of the fluid; stretching by solids goes to its gap (fluid/parting).
void drift(Fluid& fluid, real dt);

/// Makes new lists if any pair may have come closer than the skin allows; sorts the fluid rows and
/// drops those outside the domain when it does. Positions must be finite.
void update_neighbours(Fluid& fluid);
/// The lattice of the tiles of all particles; needs kernel, domain and period.
TileLattice lattice_of(const Fluid& fluid);
/// The two halves of update_neighbours, between which a caller may add and remove fluid rows:
/// whether lists are due, or asked for, and their making.
bool lists_are_due(Fluid& fluid, bool asked);
void make_lists(Fluid& fluid);
/// Makes the particles of fixed walls that the tiles of fluid and bodies are near to, as a rebuild
/// of lists does; a restart needs them for the columns of solids. A rank has the fluid tiles of its
/// range and the body tiles of all ranks, of which it keeps its own.
void place_fixed_walls(Fluid& fluid);
/// Makes the lists again from the recorded positions, as a restart needs; a rank has its own tiles.
void rebuild_neighbours(Fluid& fluid);

/// p and V of the fluid from rho, then p and V of solid particles from the adjacent fluid.
void update_pressure(Fluid& fluid);

/// Force on every fluid, body and wall particle that depends on positions; the density diffusion.
/// dt: length of the step, for the backstop.
void update_forces(Fluid& fluid, real dt);

/// v += dt (F + F_visc)/m + dt (g + drive) of the fluid.
void kick(Fluid& fluid, real dt);

/// R = rho sum V (v_i - v_j).r F + D and the viscous force, from the new velocities; gaps close
/// where solids are too near.
void update_rates(Fluid& fluid);

/// Moves the fluid particles by the shifting of a step, if that effect is on.
void shift(Fluid& fluid, real dt);

/// Largest speed [m/s] and acceleration [m/s2] of the fluid of this process; NaN if any value is
/// not finite.
real top_speed(const Fluid& fluid);
real top_acceleration(const Fluid& fluid);

/// alpha h c0 / (2 (d + 2)) + nu + the largest nu_t of this process [m2/s]; 0 without viscosity.
real effective_viscosity(const Fluid& fluid);

} // namespace hyoryu
