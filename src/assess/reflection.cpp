// SPDX-License-Identifier: MIT
// With the amplitudes a and b of the two waves the elevation at x is the real part of
// (a e^(ikx) + b e^(-ikx)) e^(-iwt).
#include "hyoryu/assess/reflection.hpp"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace hyoryu {

namespace {

using Complex = std::complex<double>;

// Below this part of its largest value, gauges a quarter of a wavelength apart, the determinant of
// the two waves raises errors of the gauges more than threefold.
constexpr double least_determinant = 0.1;

Measured not_measured(std::string why)
{
    return {not_a_number, std::move(why)};
}

// Waves below this part of the largest elevation are round-off of the fits.
constexpr double least_wave = 1e-12;

double largest(const Samples& samples)
{
    double most = 0;
    for (const double value : samples.values) {
        most = std::max(most, std::abs(value));
    }
    return most;
}

// The part of the samples that has this angular frequency, beside a constant: p in Re(p e^(-iwt)).
Complex amplitude(const Samples& samples, double omega)
{
    const auto rows = static_cast<Eigen::Index>(samples.t.size());
    Eigen::MatrixX3d parts(rows, 3);
    for (Eigen::Index k = 0; k < rows; ++k) {
        const double phase = omega * samples.t[static_cast<std::size_t>(k)];
        parts.row(k) << 1, std::cos(phase), std::sin(phase);
    }
    const Eigen::Map<const Eigen::VectorXd> values(samples.values.data(), rows);
    const Eigen::Vector3d fit = parts.colPivHouseholderQr().solve(values);
    return {fit[1], fit[2]};
}

} // namespace

Measured reflection(const std::vector<WaveRecord>& records, double period, double wavenumber)
{
    if (!(period > 0 && wavenumber > 0)) {
        return not_measured("period and wavenumber must be above 0");
    }
    const double omega = 2 * std::numbers::pi / period;
    Complex spread = 0; // of the gauges along the wave
    Complex coming = 0, going = 0;
    double most = 0;
    for (const WaveRecord& record : records) {
        const Samples& s = record.elevation;
        if (s.t.empty() || !(s.t.back() - s.t.front() >= period)) {
            return not_measured("the rows cover less than one period");
        }
        const Complex wave = std::polar(1.0, wavenumber * record.x);
        const Complex seen = amplitude(s, omega);
        most = std::max(most, largest(s));
        spread += wave * wave;
        coming += std::conj(wave) * seen;
        going += wave * seen;
    }
    const auto count = static_cast<double>(records.size());
    const double determinant = count * count - std::norm(spread);
    if (!(determinant > least_determinant * count * count)) {
        return not_measured("the distances between the gauges are close to multiples of half a "
                            "wavelength");
    }
    const double there = std::abs(count * coming - std::conj(spread) * going);
    const double back = std::abs(count * going - spread * coming);
    if (!std::isfinite(back) || !(there > least_wave * determinant * most)) {
        return not_measured("the gauges record no wave, or some values are not numbers");
    }
    return {back / there, ""};
}

Measured reflection(const Quantity& quantity, const Scope& scope, RunFiles& files)
{
    const WaveGauges& waves = *quantity.waves;
    std::vector<WaveRecord> records{
        {0, within(quantity, scope, samples(quantity.series, scope, files))}};
    for (std::size_t k = 0; k < waves.beside.size(); ++k) {
        Series beside = quantity.series;
        beside.value = waves.beside[k];
        records.push_back(
            {waves.distance[k], within(quantity, scope, samples(beside, scope, files))});
    }
    return reflection(records, evaluate(waves.period, scope), evaluate(waves.wavenumber, scope));
}

} // namespace hyoryu
