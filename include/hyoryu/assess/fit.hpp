// SPDX-License-Identifier: MIT
// Orders, floors and limits from a few points.
#pragma once

#include <array>
#include <optional>
#include <span>

namespace hyoryu {

/// The line through points by least squares.
struct Line {
    double slope = 0, offset = 0;
    double deviation = 0; // of the slope; NaN for two points
};
/// Needs two different abscissae.
Line fit_line(std::span<const double> x, std::span<const double> y);

/// The power p of y = C x^p by least squares of the logarithms, with its interval of 95 %
/// confidence (Student's t with n - 2 degrees of freedom); NaN bounds for two points.
struct Power {
    double exponent = 0;
    double low = 0, high = 0;
    int points = 0;
};
/// Pairs that are not both positive and finite are left out; none with fewer than two abscissae.
std::optional<Power> fit_power(std::span<const double> x, std::span<const double> y);

/// y = C x^p + floor with 0 <= floor < min y, by least squares of log y over a scan of floors.
struct PowerWithFloor {
    double factor = 0, exponent = 0, floor = 0;
    double misfit = 0; // root mean square of the logarithms
};
/// None with fewer than four different abscissae.
std::optional<PowerWithFloor> fit_power_with_floor(std::span<const double> x,
                                                   std::span<const double> y);

/// Extrapolation to h = 0 from three values, the finest first. Source: Celik et al. (2008),
/// Procedure for estimation and reporting of uncertainty due to discretization in CFD applications,
/// J. Fluids Eng. 130, 078001.
struct Richardson {
    double order = 0;
    double limit = 0;
    double gci = 0; // relative uncertainty of the finest value, safety factor 1.25
};
/// None if the values do not converge monotonically, or towards no order.
std::optional<Richardson> extrapolate(const std::array<double, 3>& h,
                                      const std::array<double, 3>& values);

/// The middle of the sorted values; NaN if there are none.
double median(std::span<const double> values);

} // namespace hyoryu
