// SPDX-License-Identifier: MIT
// The reflection coefficient of regular waves from several gauges (Mansard and Funke 1980).
#pragma once

#include "hyoryu/assess/measure.hpp"

#include <vector>

namespace hyoryu {

/// The elevation of the surface at one gauge of a flume.
struct WaveRecord {
    double x = 0; // the way the waves come [m]
    Samples elevation;
};

/// The height of the waves of that period [s] and wavenumber [rad/m] that travel towards -x over
/// that of those towards +x. At each gauge the amplitude and phase of the period are fitted to the
/// rows, and to those of all gauges the two waves, both by least squares. None if the gauges stand
/// whole halves of a wavelength apart, where they cannot tell one wave from the other, if a
/// record is shorter than a period, or if period or wavenumber is not above 0. Source: Mansard and
/// Funke (1980), The measurement of incident and reflected spectra using a least squares method,
/// Proc. 17th Int. Conf. Coastal Engineering, 154-172.
Measured reflection(const std::vector<WaveRecord>& records, double period, double wavenumber);

/// The same of the gauges of a quantity. Throws FormulaError and IoError.
Measured reflection(const Quantity& quantity, const Scope& scope, RunFiles& files);

} // namespace hyoryu
