// SPDX-License-Identifier: MIT
// Seepage: water pressure in the joint between a face of a body and its support.
//
// No particle fits into a gap of less than a spacing, so that the joint under a body standing on
// the ground is dry and the particles alone never lift it. Here the joints are found from the exact
// surfaces; their pressure is that of slow seepage through a gap of uniform width, between the
// pressures that the fluid shows at the rim. The forces act on the body and, opposite, on the solid
// on the other side. A joint begins where faces touch and ends when they are two spacings apart:
// faces that have not touched have water between them. Ours; the thin gap is that of Reynolds
// (1886) with uniform width.
#pragma once

#include "hyoryu/coupling/coupling.hpp"

#include <memory>

namespace hyoryu {

/// Pressure of one cell of a joint, on the surface of a body.
struct JointLoad {
    int other = -1;      // on the other side: a body, or -1 - (index of the boundary)
    Vec3 point{0, 0, 0}; // [m]
    Vec3 force{0, 0, 0}; // on the body; the other side feels the opposite [N]
    double pressure = 0; // [Pa]
    double gap = 0;      // width of the joint there [m]; negative where the surfaces overlap
};

struct JointTables; // faces of bodies cut into cells, surfaces of walls; private to coupling

/// The joints of a scene. What a restart needs are the first four: a row for each joint.
struct Seepage {
    /// {body, face} that have touched and not parted by two spacings since. Faces are numbered
    /// within their body. Ascending.
    std::vector<std::array<int, 2>> joined;
    std::vector<double> opening;               // mean speed at which the two sides part [m/s]
    std::vector<double> pressure;              // mean, before the inflow lowers it [Pa]
    std::vector<double> inertia;               // pressure that accelerates the inflow [Pa]
    std::vector<std::uint8_t> open;            // by body: water enters below it, `stands = "open"`
    std::vector<std::vector<JointLoad>> loads; // by body, of the last step; most have none
    std::unique_ptr<JointTables> tables;       // surfaces; none before the first step

    Seepage();
    ~Seepage();
    Seepage(Seepage&&) noexcept;
    Seepage& operator=(Seepage&&) noexcept;
};

/// The time for which walls are placed, and the length of this step and of the one before [s].
struct JointTime {
    double time = 0;
    double dt = 0;
    double before = 0;
};

/// To be called after `joined` and its columns were read from a checkpoint. Throws IoError if it
/// does not fit the bodies.
void restart_joints(Seepage& seepage);

/// Finds the joints at these poses, with walls where they are at that time, and their pressures
/// from those of the fluid and solid particles; tells the fluid which particles of bodies leave
/// their film forces to the joints (`Fluid::film_cuts`). Makes the surfaces at its first call;
/// after that nothing is allocated and no ray is cast while no body comes within two spacings of
/// another solid.
void update_joints(Seepage& seepage, const Rigid& rigid, const std::vector<Pose>& poses,
                   const BodyParticles& bodies, const JointTime& step, Fluid& fluid);

/// Removes from the forces on particles behind joints what their films push along the joints; to be
/// called when the forces are known, before the sums of `collect_loads`.
void cut_slip_of_films(Seepage& seepage, const std::vector<Pose>& poses, Fluid& fluid);

/// Adds the forces of the joints to the loads of the bodies, about the centres of mass of the
/// poses, and to the forces on the walls.
void add_joint_loads(const Seepage& seepage, const std::vector<Pose>& poses,
                     std::vector<Wrench>& bodies, std::span<Vec3> walls);

/// Adds to the sums of `collect_loads` and `collect_wall_forces` what the film forces on particles
/// of this process left to the joints (`Fluid::film_cuts`): the reaction has already acted on the
/// other side.
void return_film_cuts(const Fluid& fluid, const std::vector<Pose>& poses, OwnerSums<6>& bodies,
                      OwnerSums<3>& walls);

} // namespace hyoryu
