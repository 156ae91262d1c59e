// SPDX-License-Identifier: MIT
// The keys of waves: pistons, gates and sponges.
#pragma once

#include "keys_shapes.hpp"

#include "hyoryu/scene/piston.hpp"

#include <numbers>

namespace hyoryu {

/// [wall.motion.piston]: a solitary wave, or regular waves.
struct PistonWave {
    std::optional<double> solitary_height, height; // [m]
    SolitaryTheory theory = SolitaryTheory::boussinesq;
    WaveTrain train;
};

/// [wall.motion.lift]
struct Lift {
    double start = 0; // [s]
    double speed = 0; // [m/s]
};

inline void find_wave(TableReader& table, const PistonWave& wave)
{
    if (wave.solitary_height && wave.height) {
        table.error("height", "give either `solitary_height` or `height`, not both");
    } else if (!table.mistaken() && !table.has("solitary_height") && !table.has("height")) {
        table.error("solitary_height",
                    "is missing: give `solitary_height`, or `height` and `period`",
                    "Height of a solitary wave; a paddle that only absorbs has `absorb`, `depth` "
                    "and no `piston`");
    }
}

inline void refuse_second_crests(TableReader& table, const PistonWave& wave, double gravity)
{
    const double most = 8 * sq(std::numbers::pi) / 3;
    const double number = ursell_number(wave.train, gravity);
    if (wave.train.order == 2 && number > most) {
        table.error("height",
                    fmt::format("H L^2 / d^3 is {:.3g}, above 8 pi^2 / 3 = {:.3g}: the second "
                                "order would have a second crest in every trough",
                                number, most),
                    "a lower or shorter wave, or deeper water; order = 1 has no such limit");
    }
}

inline void move_as_piston(TableReader& table, PistonWave& wave, Wall& wall, double gravity,
                           double end)
{
    if (!table.sound("depth") || !(wave.solitary_height || wave.height)) {
        return;
    }
    const double depth = wave.train.depth;
    if (!(gravity > 0)) {
        table.error("depth", "there are no waves without `gravity`");
    } else if (wave.solitary_height) {
        wall.motion = solitary_piston(*wave.solitary_height, depth, gravity, wave.theory);
        wall.wave = {.height = *wave.solitary_height,
                     .length = solitary_length(*wave.solitary_height, depth, wave.theory),
                     .depth = depth};
    } else if (table.sound("period")) {
        constexpr double most_periods = 15000; // 64 points each, a million in all
        wave.train.height = *wave.height;
        if (!(end / wave.train.period <= most_periods)) {
            table.error("period", fmt::format("the run would last {:.3g} periods, at most {} are "
                                              "allowed",
                                              end / wave.train.period, most_periods));
            return;
        }
        refuse_second_crests(table, wave, gravity);
        wall.motion = regular_piston(wave.train, gravity, end);
        const double number = wave_number(wave.train.period, depth, gravity);
        wall.wave = {.height = *wave.height,
                     .length = 2 * std::numbers::pi / number,
                     .depth = depth,
                     .period = wave.train.period};
    }
    if (wall.motion.absorption) {
        wall.motion.absorption->depth = depth;
    }
}

inline void lift_gate(TableReader& table, const Lift& lift, Motion& motion, double spacing,
                      double end)
{
    if (table.sound("speed") && lift.speed > 0) {
        motion = lifted_gate(lift.start, lift.speed, spacing / 2, end);
    }
}

void keys_of(auto& keys, Is<PistonWave> auto& wave, auto& wall, double gravity, double end)
{
    keys.positive("solitary_height", wave.solitary_height, "m", "Height of a solitary wave.",
                  no_default);
    keys.positive("height", wave.height, "m", "Height of regular waves, from trough to crest.",
                  no_default);
    keys.rule(find_wave, wave);
    keys.positive("depth", wave.train.depth, "m", "Depth of the water at rest.", needed);
    const bool regular = wave.height.has_value() || keys.gives("height");
    if (keys.applies(regular)) {
        keys.positive("period", wave.train.period, "s", "Period of regular waves.", needed);
        keys.integer(
            "order", wave.train.order, 1, 2, "1 or 2",
            "Order of the paddle motion for regular waves: 2 adds the second harmonic, without "
            "which the paddle generates a free wave of twice the frequency (Madsen 1971).");
        keys.rule(inherit, wave.train.ramp, wave.train.period);
        keys.not_negative("ramp", wave.train.ramp, "s",
                          "Time over which regular waves grow to their full height.",
                          "wall.motion.piston.period");
    }
    if (keys.applies(!regular)) {
        keys.choice("theory", wave.theory, {"boussinesq", "rayleigh"},
                    "Theory of the shape of the solitary wave. With \"rayleigh\" high waves are "
                    "longer and the tail behind the wave is smaller.");
    }
    keys.rule(move_as_piston, wave, wall, gravity, end);
}

void keys_of(auto& keys, Is<Lift> auto& lift, auto& motion, double spacing, double end)
{
    keys.not_negative("start", lift.start, "s", "Time at which the gate starts to rise.");
    keys.positive(
        "speed", lift.speed, "m/s",
        "Speed at which the gate rises; it gains this speed over half a particle spacing.", needed);
    keys.rule(lift_gate, lift, motion, spacing, end);
}

inline void check_sponge(TableReader& table, const Sponge& sponge, double gravity)
{
    if (sponge.depth && sponge.rate) {
        table.error("rate", "give either `depth` or `rate`, not both");
    } else if (!table.mistaken() && !table.has("depth") && !table.has("rate")) {
        table.error("depth", "is missing: give `depth` or `rate`",
                    "Depth of the water at rest [m], or the rate of damping [1/s]");
    } else if (sponge.depth && !(gravity > 0)) {
        table.error("depth", "gives no rate of damping without `gravity`", "give `rate` [1/s]");
    }
    if (table.reading().dimensions == 2 && sponge.side > 1) {
        table.error("side", "in two dimensions there are \"-x\" and \"+x\"");
    }
}

void keys_of(auto& keys, Is<Sponge> auto& sponge, double gravity)
{
    keys.planar("min", sponge.min, "m", "Lower corner of the box of a sponge.", required);
    keys.planar("max", sponge.max, "m", "Upper corner of the box of a sponge.", required);
    keys.rule(check_corners, sponge.min, sponge.max);
    keys.choice(
        "side", sponge.side, {"-x", "+x", "-y", "+y"},
        "Side of the box with the strongest damping; the damping begins at the opposite side.",
        "+x");
    keys.positive("depth", sponge.depth, "m",
                  "Depth of the water at rest, for the damping of waves: the damping rate at the "
                  "side is 10 sqrt(g/depth). Give either depth or rate.");
    keys.positive("rate", sponge.rate, "1/s",
                  "Damping rate at the side; give either depth or rate.");
    keys.planar("velocity", sponge.velocity, "m/s",
                "Velocity to which the fluid relaxes: the velocity of a stream that a sponge in a "
                "periodic domain restores.");
    keys.choice("profile", sponge.parabolic, {"uniform", "parabolic"},
                "Velocity profile over z. \"parabolic\": the profile of viscous flow between "
                "plates at the lower and the upper side of the box, with `velocity` as its mean.");
    keys.number("pressure", sponge.pressure, "Pa",
                "Pressure at `min`, hydrostatic above it, to which the fluid in the box relaxes in "
                "the time in which sound crosses the box. A periodic or closed domain without a "
                "free surface needs this key, because its mean density drifts otherwise.",
                no_default);
    keys.rule(check_sponge, sponge, gravity);
}

} // namespace hyoryu
