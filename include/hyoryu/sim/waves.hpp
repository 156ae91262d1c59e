// SPDX-License-Identifier: MIT
// Waves at the ends of a flume: sponges (boxes that damp the motion of the fluid), and paddles that
// absorb incoming waves.
#pragma once

#include "hyoryu/core/types.hpp"

#include <vector>

namespace hyoryu {

struct Simulation;

/// State of an absorbing paddle, besides the motion of its wall (`Motion::Absorption`).
struct Absorber {
    std::size_t wall = 0;
    double side = 1;          // +1: the water is on its +x side, -1: on the other
    double face = 0;          // x of that side at time 0 [m]
    double low = 0, high = 0; // its extent in y [m]
    double still = 0;         // weighted count of the particles before it at the start
    double level = 0;         // of the water before it, filtered [m]
};

struct Waves {
    std::vector<Absorber> absorbers;
    Vec3 sponge_impulse{0, 0, 0}; // of the sponges on the fluid in the last step [N s]
};

/// The absorbers of a scene whose fluid has its first lists; none without fluid.
Waves make_waves(const Simulation& sim);

/// Sets the speeds that the paddles add to their paths in the coming step, so as to absorb waves.
/// The level before a paddle is that of the particles within 4 spacings of it, weighted by their
/// nearness and compared with the start; it is smoothed over 4 dp/sqrt(g d), about the time of a
/// wave across that strip. The paddle adds (asked - level) sqrt(g/d), which sends a long wave on as
/// if the flume had no end. Schaeffer and Klopman, J. Waterway Port Coast. Ocean Eng. 126 (2000)
/// 88.
void absorb_waves(Simulation& sim, double dt);

/// Brings the velocities in the sponges of the scene towards theirs, u, over dt: u + (v - u)
/// exp(-r s^2 dt), s from 0 to 1 across a sponge, r its rate or, for waves in water of depth d,
/// 10 sqrt(g/d) [1/s]. A parabolic u over z is 6 s (1 - s) times its mean, s from 0 to 1.
/// `Waves::sponge_impulse` is what the fluid gained. A sponge with a pressure also relaxes the
/// density towards that of it, hydrostatic above its lower side, at the rate c0 s^2/L, L its
/// length.
void damp_in_sponges(Simulation& sim, double dt);

} // namespace hyoryu
