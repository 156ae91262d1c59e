// SPDX-License-Identifier: MIT
// Shapes to particles: fluid on a lattice, walls as layers behind their surface, bodies as layers
// that conform to theirs.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/ranks/comm.hpp"
#include "hyoryu/scene/shapes.hpp"

namespace hyoryu {

/// Particles of one body in its own axes, about the centre of mass.
struct Aggregate {
    std::vector<Vec3> points;   // [m]
    double particle_volume = 0; // volume of the body / number of particles [m3]
    Index surface_points = 0;   // in the outermost layer
    Vec3 cell{0, 0, 0};         // of the lattice that fills a mesh [m]
};

/// Wall particles that follow each other in the filling as their places do in the layers of a wall.
struct WallRun {
    Index first = 0; // particle; those up to the first one of the next run belong to this one
    Index place = 0; // its number in the layers
    std::int32_t wall = 0;
    std::int32_t shift = 0; // in `wall_shifts`: away from its place in the layers
};

/// All particles of a scene at the start, or those of them that one of several processes has.
struct Filling {
    std::vector<Vec3> fluid;                // [m]
    std::vector<std::int64_t> fluid_number; // of all processes; empty for one: 0, 1, ...
    Index fluid_elsewhere = 0;              // fluid particles that other processes have
    std::vector<Vec3> fluid_velocity;       // [m/s]; empty if all fluid is at rest
    std::vector<double> fluid_depth;        // below the free surface above it, along gravity [m]
    std::vector<double> fluid_pressure;     // above the hydrostatic one [Pa]; empty without any
    double fluid_volume = 0;                // that the fluid particles stand for [m^d]
    std::vector<std::uint8_t> fluid_cut;   // 1 about cells that surfaces cut or the block stretches
    std::vector<Vec3> wall;                // [m]; empty without fluid
    std::vector<std::int64_t> wall_number; // of all processes; empty for one: 0, 1, ...
    Index wall_elsewhere = 0;              // wall particles that other processes have
    std::vector<std::int32_t> wall_owner;  // index of the wall
    std::vector<double> wall_depth;        // behind the surface [m]; empty where fluid slips
    std::vector<WallRun> wall_runs;        // of the wall particles of all processes, ascending
    std::vector<Vec3> wall_shifts{
        Vec3(0, 0, 0)}; // of runs; others lie below and beside carpets [m]
    std::vector<Aggregate> bodies;
    Bounds domain; // particles outside are removed from the run
    std::vector<Diagnostic> warnings;
    std::vector<Diagnostic> faults; // told with those of the plan

    /// Of all processes.
    Index fluid_count() const { return static_cast<Index>(fluid.size()) + fluid_elsewhere; }
    Index wall_count() const { return static_cast<Index>(wall.size()) + wall_elsewhere; }
    std::int64_t number_of_fluid(std::size_t k) const { return number(fluid_number, k); }
    std::int64_t number_of_wall(std::size_t k) const { return number(wall_number, k); }

private:
    static std::int64_t number(const std::vector<std::int64_t>& numbers, std::size_t k)
    {
        return numbers.empty() ? static_cast<std::int64_t>(k) : numbers[k];
    }
};

/// Layers of solid particles that hide the void behind a wall from every fluid particle.
int wall_layers(double smoothing_ratio);

/// How thick these layers are, or would be with the usual kernel [m].
double thickness_of_rows(const Scene& scene);

/// Particles of one shape at the given spacing, in layers at half a spacing, one and a half, ...
/// below the surface: planes for boxes, rings and shells for cylinders and spheres, a lattice for
/// meshes.
Aggregate aggregate(const Shape& shape, double spacing, int dimensions);

/// The processes that fill a case together.
struct Fillers {
    Comm* comm = nullptr; // null for one process
    double part = 1;      // share of all particles that is on this machine
};

/// Fills the scene. Where a body stands in the fluid, exactly its volume is taken out. Several
/// processes call this function together: each gets all bodies and a part of the particles, and
/// none ever has all particles. The parts together equal, bit for bit, the filling by one process.
/// Throws CaseError, naming the estimate, if more particles were asked for than can be numbered or
/// than the memory of this machine can hold.
Filling fill(const Scene& scene, const Fillers& fillers = {});

/// The volume that a fluid particle stands for at rest [m3], [m2] in two dimensions: cells that
/// fill the blocks are seldom cubes of the spacing. With any other volume, the pressure in the
/// water would rise too fast or too slowly with depth, in the ratio of the volumes. With open sides
/// that of a cube, since their carpets are made of cubes.
double particle_volume(const Scene& scene, const Filling& filling);

} // namespace hyoryu
