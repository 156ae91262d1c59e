// SPDX-License-Identifier: MIT
// Motions of pistons that make waves, and of gates. Each path runs along its axis from time 0 on.
#pragma once

#include "hyoryu/core/motion.hpp"

namespace hyoryu {

/// Which solitary wave: k = sqrt(3 H / (4 d^3)), or sqrt(3 H / (4 d^2 (d + H))), which sheds less
/// of a tail where the wave is high.
enum class SolitaryTheory { boussinesq, rayleigh };

/// The path along +x of a piston that makes a solitary wave of a height in water of a depth [m],
/// and the levels at the paddle, as of one that absorbs (`Motion::Absorption`, without the depth).
/// Goring (1978) with c = sqrt(g (d + H)); Guizien and Barthelemy, J. Hydraul. Res. 40 (2002) 321.
Motion solitary_piston(double height, double depth, double gravity,
                       SolitaryTheory theory = SolitaryTheory::boussinesq);
/// Length over which the surface of that wave lies above 1 % of its height [m].
double solitary_length(double height, double depth, SolitaryTheory theory);

/// Regular waves.
struct WaveTrain {
    double height = 0; // from trough to crest [m]
    double period = 0; // [s]
    double depth = 0;  // of the water at rest [m]
    int order = 2;     // 2: with the second harmonic that keeps the wave from shedding a free one
    double ramp = 0;   // time in which the stroke grows to its full size [s]
};

/// Wave number of w^2 = g k tanh(k d) [1/m].
double wave_number(double period, double depth, double gravity);

/// Stroke S = H (sinh 2kd + 2kd) / (2 (cosh 2kd - 1)) of the first order, and the amplitude of the
/// second harmonic of the path [m].
struct Stroke {
    double first = 0;
    double second = 0;
};
Stroke stroke_of(const WaveTrain& wave, double gravity);

/// H L^2 / d^3, above 8 pi^2 / 3 of which the second order has a second crest in its troughs.
double ursell_number(const WaveTrain& wave, double gravity);

/// The path along +x of a piston that makes regular waves until `end`, and the levels at the
/// paddle. Madsen, J. Geophys. Res. 76 (1971) 8672.
Motion regular_piston(const WaveTrain& wave, double gravity, double end);

/// A gate that starts to rise at a time [s] with a speed [m/s] along +z, for a day or until twice
/// `end`. It gains the speed at a constant acceleration over `runway` [m].
Motion lifted_gate(double start, double speed, double runway, double end);

} // namespace hyoryu
