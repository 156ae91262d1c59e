// SPDX-License-Identifier: MIT
#include "hyoryu/scene/piston.hpp"

#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

constexpr double last_phase = 3.80; // tanh = 0.999, as Goring cut it
// Points of the path: the cubics between them follow it to 1e-4 of its largest speed.
constexpr int points = 201;
// Points of a period: the cubics follow the path to 1e-4 of the stroke.
constexpr int points_of_period = 64;

double decay_number(double height, double depth, SolitaryTheory theory)
{
    const double high = theory == SolitaryTheory::rayleigh ? depth + height : depth;
    return std::sqrt(3 * height / (4 * depth * depth * high));
}

// Smooth from 0 to 1, with no speed at either end.
double smooth(double s)
{
    return s >= 1 ? 1 : s * s * (3 - 2 * s);
}

} // namespace

Motion solitary_piston(double height, double depth, double gravity, SolitaryTheory theory)
{
    const double k = decay_number(height, depth, theory);
    const double c = std::sqrt(gravity * (depth + height));
    const double half_stroke = height / (k * depth);
    // Time and place are explicit in the phase theta = k (c t - x), since the paddle moves with the
    // mean speed c eta / (d + eta) of the water.
    const auto time = [&](double theta) {
        return (theta + height / depth * std::tanh(theta)) / (k * c);
    };
    Motion motion;
    motion.absorption = Motion::Absorption{};
    for (int n = 0; n < points; ++n) {
        const double theta = last_phase * (2.0 * n / (points - 1) - 1);
        motion.times.push_back(time(theta) + time(last_phase));
        motion.places.emplace_back(half_stroke * (std::tanh(theta) + std::tanh(last_phase)), 0, 0);
        motion.absorption->levels.push_back(height / sq(std::cosh(theta)));
    }
    return motion;
}

double solitary_length(double height, double depth, SolitaryTheory theory)
{
    const double last = std::acosh(10.0); // sech^2 = 1 %
    return 2 * last / decay_number(height, depth, theory);
}

double wave_number(double period, double depth, double gravity)
{
    const double deep = sq(2 * std::numbers::pi / period) / gravity * depth; // w^2 d / g
    // Newton's method for x tanh x, whose slope grows: from above it falls to the root.
    double x = deep + std::sqrt(deep);
    for (int n = 0; n < 50; ++n) {
        const double t = std::tanh(x);
        x -= (x * t - deep) / (t + x * (1 - sq(t)));
    }
    return x / depth;
}

Stroke stroke_of(const WaveTrain& wave, double gravity)
{
    const double kd = wave_number(wave.period, wave.depth, gravity) * wave.depth;
    const double ratio = 2 * (std::cosh(2 * kd) - 1) / (std::sinh(2 * kd) + 2 * kd); // H / S
    const double sinh = std::sinh(kd);
    const double second = sq(wave.height) / (32 * wave.depth) *
                          (3 * std::cosh(kd) / (sinh * sinh * sinh) - 2 / ratio);
    return {wave.height / ratio, wave.order == 2 ? second : 0};
}

double ursell_number(const WaveTrain& wave, double gravity)
{
    const double length = 2 * std::numbers::pi / wave_number(wave.period, wave.depth, gravity);
    return wave.height * sq(length) / (sq(wave.depth) * wave.depth);
}

Motion regular_piston(const WaveTrain& wave, double gravity, double end)
{
    const Stroke stroke = stroke_of(wave, gravity);
    const double w = 2 * std::numbers::pi / wave.period;
    const double k = wave_number(wave.period, wave.depth, gravity);
    const double sinh = std::sinh(k * wave.depth);
    // Second harmonic of the surface of a Stokes wave [m].
    const double harmonic = wave.order == 2 ? sq(wave.height) * k / 16 * std::cosh(k * wave.depth) *
                                                  (3 + 2 * sq(sinh)) / (sinh * sinh * sinh)
                                            : 0;
    Motion motion;
    motion.absorption = Motion::Absorption{};
    const double step = wave.period / points_of_period;
    const auto count = static_cast<long long>(std::ceil(end / step)) + 1;
    for (long long n = 0; n <= count; ++n) {
        const double t = static_cast<double>(n) * step;
        const double grown = smooth(wave.ramp > 0 ? t / wave.ramp : 1);
        motion.times.push_back(t);
        motion.places.emplace_back(
            grown * (stroke.first / 2 * std::sin(w * t) + stroke.second * std::sin(2 * w * t)), 0,
            0);
        motion.absorption->levels.push_back(
            grown * (wave.height / 2 * std::cos(w * t) + harmonic * std::cos(2 * w * t)));
    }
    return motion;
}

Motion lifted_gate(double start, double speed, double runway, double end)
{
    const double gains = 2 * runway / speed; // with a constant acceleration [s]
    Motion motion;
    constexpr int parts = 8; // of the parabola of the acceleration
    for (int k = 0; k <= parts; ++k) {
        const double part = static_cast<double>(k) / parts;
        motion.times.push_back(start + part * gains);
        motion.places.emplace_back(0, 0, part * part * runway);
    }
    // Between points of one speed the cubics keep it; behind the last they come to rest, a day
    // later at least, so that an extended run has the same path.
    constexpr double day = 86400;
    const double rest = std::max(day, 2 * end);
    for (const double later : {gains / parts, rest, rest + gains}) {
        motion.times.push_back(start + gains + later);
        motion.places.emplace_back(0, 0, runway + later * speed);
    }
    return motion;
}

} // namespace hyoryu
