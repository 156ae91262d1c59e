// SPDX-License-Identifier: MIT
// The penalty method of particle-based rigid bodies, kept as the baseline to compare with: springs
// and dashpots between the particles of bodies and those of walls and of other bodies.
#pragma once

#include "hyoryu/core/cell_grid.hpp"
#include "hyoryu/rigid/law.hpp"

namespace hyoryu {

/// The particles of a solid, sorted so that those near a place are found.
struct ParticleCloud {
    std::vector<Vec3> points; // [m]
    double spacing = 0;       // d [m]
    double reach = 0;         // largest distance of a particle from the origin [m]
    CellGrid grid;            // over `points`
};
ParticleCloud particle_cloud(std::vector<Vec3> points, double spacing);

/// All that the penalty method needs beside bodies and boundaries.
///
/// Two particles nearer than d, the mean of their spacings, push each other along the line between
/// them with F = max(0, k (d - r) - c v_n), v_n their speed of separation (Tanaka, Sakai and
/// Koshizuka 2007), and a friction force min(c |v_t|, mu F) acts against the sliding v_t at the
/// middle between them: Coulomb friction, viscous while slow. Restitution follows from k and c,
/// whatever the laws of the materials say.
///
/// A plane is the half-space behind it filled with particles, endless and never stored: cells of
/// one spacing from the plane's point on, along n and the two tangents t (the x axis, or y for a
/// plane across x, without its part along n) and s = n x t, a particle in the middle of each. The
/// walls of a basin are two layers of particles outside it, their cells a whole number within it. A
/// particle that a blow drives between those of a wall is held there, as the method has it.
struct Penalty {
    PenaltyParameters parameters;
    double wall_spacing = 0;              // of planes and basins [m]
    std::vector<ParticleCloud> bodies;    // of each body, in body axes
    std::vector<ParticleCloud> obstacles; // of each boundary, where it is at time 0; empty for
                                          // planes and basins
};

} // namespace hyoryu
