// SPDX-License-Identifier: MIT
// The last barrier: fluid does not pass the exact surface of a wall or a body.
//
// Solid particles keep the fluid out by pressure, which a crowded initial row, a plate thinner than
// a spacing or a violent impact can overcome. After the kick of a step, therefore, the velocity u
// of a particle along the normal of a surface, relative to the solid there, may not be less than
//     u*(d) = -s (d - dp/8) / dt           at a distance d of dp/4 or more,
//             0                            nearer than that,
//             min(-d / (20 dt), 0.02 c0)   inside, where d < 0,
// with s = (d - dp/4) / (dp/16), at most 1, so that u* is continuous and round-off does not decide
// in which step a particle is held. The particle receives the impulse J = m (u* - u) n, the solid
// -J. A stopped particle has no approach speed left, as in an inelastic impact; a particle inside
// is led out slowly. Water at its normal distance is not affected. Between surfaces that close in
// on a particle the rule is applied in four rounds. A body yields to its hits: with Y = sum a m
// (1/M + rotation), where a is the whole impulse over that of the first round, it takes all of them
// if Y < 1 and the share 1/Y of them otherwise, so that they never turn its motion around; the
// particles keep the rest. What other solids have answered to that rest is then found anew. Ours;
// the impulse is that of a unilateral constraint (Moreau 1988).
#pragma once

#include "hyoryu/scene/solid_surface.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hyoryu {

struct Simulation;

/// A surface, with the least normal velocity that a particle may have relative to it.
struct SurfaceHold {
    int solid = 0;          // wall, or number of walls + body
    Vec3 normal{0, 0, 1};   // out of the solid
    Vec3 velocity{0, 0, 0}; // of the solid at the particle [m/s]
    double least = 0;       // speed along the normal relative to it [m/s]
    Vec3 impulse{0, 0, 0};  // on the particle [N s]
    double first = 0;       // speed that it lacked first [m/s]
    double sum = 0;         // of the speeds that it lacked, round by round [m/s]
};

/// An impulse of the barrier.
struct BarrierHit {
    Index row = 0;         // of the fluid particle
    int solid = 0;         // wall, or number of walls + body
    Vec3 place{0, 0, 0};   // of the particle [m]
    Vec3 impulse{0, 0, 0}; // on the particle [N s]
    double repeats = 1;    // the impulse over that which stops the approach: more in a pinch [1]
    double wanted = 0;     // least velocity of the particle along the impulse [m/s]
};

/// Where a solid is and how it moves.
struct SolidPlace {
    Vec3 position{0, 0, 0}; // of its axes [m]
    Mat3 rotation = Mat3::Identity();
    Vec3 velocity{0, 0, 0}; // of the origin of its axes [m/s]
    Vec3 spin{0, 0, 0};     // angular velocity [rad/s]
    bool left = false;      // the body is no longer there
};

/// The solids of a scene, and bounds by which fluid particles far from them are skipped. The bounds
/// are kept from step to step to save work; no result depends on them.
struct WallBarrier {
    std::vector<SolidSurface> solids; // walls, then bodies
    std::size_t walls = 0;            // of them
    double spacing = 0;               // dp [m]
    double dt = 0;                    // of the last step [s]
    int dimensions = 3;

    std::vector<SolidPlace> places, before; // of the solids in this step and in the one before
    long long builds = -1;                  // of the neighbour lists for which all below holds
    double way = 0;                         // bound of how far any solid has come since then [m]
    /// The solids that particles of a tile may meet, ascending, if they are few.
    struct Near {
        std::array<int, 15> solid{};
        int count = 0; // more than there is room for: any
    };
    std::vector<Near> near;        // of each tile
    std::vector<double> clearance; // of all particles of each tile when the lists were made [m]
    /// Of a fluid row at its last examination: its place relative to the centre of its tile, and
    /// the distance of the nearest solid plus `way`, at most the search distance [m].
    struct Seen {
        float x, y, z, clearance;
    };
    std::vector<Seen> seen;
    std::vector<std::vector<SurfaceHold>> holds; // of one particle, by thread
    std::vector<std::vector<BarrierHit>> hits;   // of this step, by thread
    std::vector<double> shares;                  // of its hits that each body takes
    std::vector<int> numbers;                    // of all solids
};

WallBarrier make_wall_barrier(const Scene& scene);

/// Stops the fluid at the surfaces of walls and bodies at their places in the middle of a step of
/// length dt, at `time`; adds the reactions to the sums of the loads (`begin_loads`).
///
/// The hits are computed for solids of infinite mass. A light body recoils from the particles that
/// it stops: those on a body are to be scaled by s = min(1, 1 / (m sum K)), K the inverse effective
/// mass of the body at each hit. The sum bounds their joint effect, so that those of one body, each
/// on a particle that no other solid holds, never add energy: the change is m du^2 s (-1 + s (1 + m
/// sum K) / 2) at most, which is not above zero for this s.
void hold_at_solids(Simulation& sim, double time, double dt);

/// Scales the hits on bodies, once their sums are those of all processes: adds them to the loads
/// and returns the rest to the particles. Where several solids hold a particle, the others then
/// give what is wanted of them anew: walls any impulse, bodies at most that of before. Called by
/// all processes.
void share_hits(Simulation& sim);

/// How many hits there were in the last step, on particles of this process.
std::size_t hits_of_step(const WallBarrier& barrier);

/// Fluid particles that are deeper than a quarter of a spacing inside a wall or body, now. Checks
/// every particle against every solid near it, without the bounds of the barrier. Excludes the
/// carpets of open sides, whose ground is that of the window carried out. Those of all processes;
/// called by all of them.
Index particles_in_solids(const Simulation& sim);

/// Counts them for a frame, or for the end of a run, and records the maximum so far.
Index count_in_solids(Simulation& sim);

} // namespace hyoryu
