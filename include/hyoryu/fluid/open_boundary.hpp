// SPDX-License-Identifier: MIT
// Open sides of the fluid. Outside each lies a carpet of buffer particles: fluid rows that take
// part in all pair loops as neighbours, but whose velocity and density follow from the prescribed
// flow. A row belongs to the carpet exactly while it is behind the plane.
//
// The flow at the plane is driven by the incoming Riemann invariant alone, u + 2 sqrt(g h), so that
// the waves that come from inside leave. Ours in this form; linearised it is the correction of
// Verbrugghe et al. (2019).
#pragma once

#include "hyoryu/fluid/fluid.hpp"

#include <optional>
#include <vector>

namespace hyoryu {

/// Columns that a carpet has at least: the support of the kernel, and three for what moves between
/// two lists. `smoothing_ratio`: smoothing length / spacing [1].
int least_carpet_columns(real smoothing_ratio);

/// From the plane to the middle of the strip in which the depth is measured [spacings].
inline constexpr real strip_half = 4;

/// Columns of a strip: cells of one spacing, in each lane, in which the ground is looked up.
inline constexpr int strip_columns = 8;

/// Weight of a place of the strip at a distance from the plane, a hat function: the sum over a
/// lattice gives the depth independent of its phase.
real strip_weight(real distance, real spacing);

/// The water that the strip of a station holds up to a level, beside the walls that stand in it.
struct StripSpace {
    bool has_wall = false; // in this strip: otherwise its mean ground is all that counts
    real low = 0, step = 1;
    std::vector<real> below; // up to the level low + k step, weighed as the depth is [m3], [m2]
};

/// A vertical plane through which fluid enters and leaves. `s` is the distance from it into the
/// domain, lanes are strips along it: the window divided into as many as come nearest to a spacing;
/// in two dimensions there is one lane.
struct OpenSide {
    int axis = 0;         // of the normal: 0 or 1
    real plane = 0;       // [m]
    real into = 1;        // +1 or -1: the direction into the domain along the axis
    real first = 0;       // lower edge of the first lane along the plane [m]
    real lane_width = 0;  // the spacing in two dimensions [m]
    real low = 0;         // lower edge of the window [m]
    bool flat = false;    // of a scene of two dimensions
    bool repeats = false; // the plane reaches from end to end of a period
    std::vector<real>
        bed; // ground below the carpet, by lane; infinity where it fills the window [m]
    std::vector<real> strip; // mean ground of the strip in which the depth is measured, by lane [m]
    // By lane and column of the strip: whether a wall stands there, which rises from the ground
    // more steeply than 45 degrees, and the ground below it; empty if none does.
    std::vector<std::uint8_t> wall;
    std::vector<real> below_wall;  // [m]
    std::vector<StripSpace> space; // by station, if a wall stands in the strip of any
    int station_lanes = 4;         // lanes of a station, in each of which one depth is measured
    int columns = 6; // of the carpet: as many as a body covers that leaves, and the least

    int lanes() const { return static_cast<int>(bed.size()); }
    int stations() const { return (lanes() + station_lanes - 1) / station_lanes; }
    real distance(const Vec3& x) const { return into * (x[axis] - plane); }
    Vec3 normal() const { return into * Vec3::Unit(axis); }
    /// The lane of a point; outside of 0 .. lanes() beside the window.
    int lane(const Vec3& x) const;
    /// Distance of the columns of the carpet: a row, a lane and a column share the volume of a
    /// particle [m].
    real column(real spacing) const { return spacing * (spacing / lane_width); }
    /// Whether a lane is open at a level: not where a wall at the plane emerges from the water.
    bool is_open(int lane, real level = infinity) const
    {
        const real ground = bed[at(lane)];
        return ground < infinity && (ground < level || !has_wall(lane, 0));
    }
    bool has_wall(int lane, int column) const
    {
        return !wall.empty() && wall[at(lane * strip_columns + column)] != 0;
    }
    /// The ground at a station: the mean over the lanes that are open at a level, over all with
    /// ground if none is; infinity if there are none.
    real station_bed(int station, real level = infinity) const;
    /// The mean ground of its strip, where no wall stands.
    real station_strip(int station) const;
    int open_lanes(int station, real level = infinity) const;
    /// Width of the lanes of a station that are open [m]; 1 in two dimensions.
    real open_width(int station, real level = infinity) const
    {
        return flat ? 1 : static_cast<real>(open_lanes(station, level)) * lane_width;
    }
    /// The middle of a lane along the plane [m]; 0 in two dimensions.
    real middle(int lane) const
    {
        return flat ? 0 : first + (static_cast<real>(lane) + 0.5) * lane_width;
    }
};

/// The prescribed flow at a station at one moment.
struct AskedFlow {
    std::optional<real> level;     // of the free surface [m]
    std::optional<real> velocity;  // into the domain [m/s]
    std::optional<real> discharge; // into the domain, of a metre of width [m2/s]
    bool free = false;             // outflow: the carpet takes over depth and velocity of the strip
    real still = 0;                // depth of the water at rest, for a level alone [m]
};

/// The flow that a station measures inside and gives to its carpet.
struct StationFlow {
    real depth = 0;      // h_m: measured depth, filtered [m]
    real drift = 0;      // mean velocity of the strip into the domain, filtered [m/s]
    real level = 0;      // of the carpet [m]
    real velocity = 0;   // of the carpet into the domain [m/s]
    bool passes = false; // supercritical outflow: every particle keeps its velocity
};

/// The flow at the plane: of the carpet, from the strip inside and what is asked for.
/// `bed`, `strip`: the ground below the carpet and below the strip [m].
struct StationGround {
    real bed = 0, strip = 0;
};
StationFlow flow_at(const AskedFlow& asked, const StationFlow& before, const StationGround& ground,
                    real gravity);

struct Carpet {
    OpenSide side;
    bool power_profile = false; // u(z) ~ z^(1/7) in place of a uniform one
    std::vector<StationFlow> stations;
    std::vector<real> carry;            // by lane: particles still due by volume [1]
    std::int64_t made = 0, dropped = 0; // rows since the start
    std::int64_t in = 0, out = 0;       // rows that crossed the plane
    real volume_asked = 0;              // integral of depth x velocity over the window [m3]
    real moved = 0;                     // by the fastest lane since lists were made [m]

    // Rows that may be behind the plane or in the strip until lists are made again.
    std::vector<std::int32_t> near;
    std::vector<std::uint8_t> behind;      // of those, now
    std::vector<std::int32_t> near_bodies; // rows of bodies about the plane, in this step
    std::vector<std::uint8_t> beside_body; // of the rows of fluid, see below; empty: none
    std::vector<Vec3> kept;                // velocities of those that are set before the kick [m/s]

    bool is_beside_body(std::size_t k) const { return !beside_body.empty() && beside_body[k] != 0; }
};

/// The open sides of a scene, and what passed them.
struct OpenBoundary {
    std::vector<Carpet> carpets;
    std::int64_t next_id = 0;    // number of the next particle that is made
    Vec3 impulse{0, 0, 0};       // on fluid and bodies of the run since the start [N s]
    Vec3 dropped_force{0, 0, 0}; // viscous, of rows dropped in this step [N]
    real energy = 0;             // carried in through the planes since the start [J]
};

/// Finds the rows about each plane; after lists were made or rows came back from a checkpoint.
void find_rows(const Fluid& fluid, OpenBoundary& open);

/// Finds the rows of bodies about each plane, and the rows of fluid behind it beside them. The
/// velocity of these is not set, it returns to that of the carpet in the time in which a wave runs
/// 4 spacings: a body that turns, heaves or is held pushes them aside, and a lattice of prescribed
/// velocity would not yield. Their density is prescribed, so that the pressure on the body is that
/// of the level; with continuity their volume would not be kept, since no water outside bounds it.
/// The outermost columns are never beside a body, since no fluid supports them from outside.
void mark_beside_bodies(const Fluid& fluid, OpenBoundary& open);

/// Measures depth and velocity of the strip inside each plane, as they are now, without a filter.
void measure_start(const Fluid& fluid, OpenBoundary& open);

/// Filters the depth and velocity that the strips have now, over a step of dt.
void measure_strips(const Fluid& fluid, OpenBoundary& open, real dt);

/// Counts the rows that crossed a plane.
void count_crossings(const Fluid& fluid, OpenBoundary& open);

/// Whether a carpet has moved so far that new columns are due.
bool carpets_due(const Fluid& fluid, const OpenBoundary& open);

/// Drops rows that have left the carpets, and makes new ones. Only before lists are made: rows
/// move.
void renew_carpets(Fluid& fluid, OpenBoundary& open);

/// Sets the density of the carpets to that of water at rest below their level; no gap, no cavity.
void set_densities(Fluid& fluid, const OpenBoundary& open);

/// Before and after the kick: sets the velocities of the carpets and records the impulse.
void keep_velocities(const Fluid& fluid, OpenBoundary& open);
void set_velocities(Fluid& fluid, OpenBoundary& open, real dt);

/// Whether a point is behind an open plane.
bool is_behind(const OpenBoundary& open, const Vec3& x);

} // namespace hyoryu
