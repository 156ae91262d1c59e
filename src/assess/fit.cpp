// SPDX-License-Identifier: MIT
#include "hyoryu/assess/fit.hpp"

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace hyoryu {

namespace {

constexpr double safety = 1.25; // of the grid convergence index with three grids
// Floors that are tried below the smallest value.
constexpr int floors = 400;

// Two-sided 95 % points of Student's distribution with 1, 2, ... degrees of freedom.
double student(int freedom)
{
    constexpr std::array table{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365,
                               2.306,  2.262, 2.228, 2.201, 2.179, 2.160, 2.145,
                               2.131,  2.120, 2.110, 2.101, 2.093, 2.086};
    const auto k = static_cast<std::size_t>(freedom);
    // Beyond the table its asymptote: 1.96 (1 + 1.42 / freedom) is within 0.1 %.
    return k <= table.size() ? table[k - 1] : 1.96 * (1 + 1.42 / freedom);
}

struct Points {
    std::vector<double> x, y; // logarithms
};

Points logarithms(std::span<const double> x, std::span<const double> y)
{
    Points points;
    for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
        if (x[k] > 0 && y[k] > 0 && std::isfinite(x[k]) && std::isfinite(y[k])) {
            points.x.push_back(std::log(x[k]));
            points.y.push_back(std::log(y[k]));
        }
    }
    return points;
}

std::size_t different(const std::vector<double>& values)
{
    return std::set<double>(values.begin(), values.end()).size();
}

} // namespace

Line fit_line(std::span<const double> x, std::span<const double> y)
{
    const auto n = static_cast<double>(x.size());
    double mx = 0;
    double my = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        mx += x[k] / n;
        my += y[k] / n;
    }
    double xx = 0;
    double xy = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        xx += (x[k] - mx) * (x[k] - mx);
        xy += (x[k] - mx) * (y[k] - my);
    }
    Line line{xy / xx, my - xy / xx * mx, not_a_number};
    if (x.size() > 2) {
        double squares = 0;
        for (std::size_t k = 0; k < x.size(); ++k) {
            const double off = y[k] - line.offset - line.slope * x[k];
            squares += off * off;
        }
        line.deviation = std::sqrt(squares / (n - 2) / xx);
    }
    return line;
}

std::optional<Power> fit_power(std::span<const double> x, std::span<const double> y)
{
    const Points points = logarithms(x, y);
    if (different(points.x) < 2) {
        return std::nullopt;
    }
    const Line line = fit_line(points.x, points.y);
    const int n = static_cast<int>(points.x.size());
    const double wide = n > 2 ? student(n - 2) * line.deviation : not_a_number;
    return Power{line.slope, line.slope - wide, line.slope + wide, n};
}

std::optional<PowerWithFloor> fit_power_with_floor(std::span<const double> x,
                                                   std::span<const double> y)
{
    const Points points = logarithms(x, y);
    if (different(points.x) < 4) {
        return std::nullopt;
    }
    const double smallest = std::exp(*std::min_element(points.y.begin(), points.y.end()));
    std::optional<PowerWithFloor> best;
    for (int k = 0; k < floors; ++k) {
        const double floor = smallest * k / floors;
        Points above = points;
        for (double& y_log : above.y) {
            y_log = std::log(std::exp(y_log) - floor);
        }
        const Line line = fit_line(above.x, above.y);
        double squares = 0;
        for (std::size_t m = 0; m < points.x.size(); ++m) {
            const double model = std::exp(line.offset + line.slope * points.x[m]) + floor;
            const double off = points.y[m] - std::log(model);
            squares += off * off;
        }
        const double misfit = std::sqrt(squares / static_cast<double>(points.x.size()));
        if (!best || misfit < best->misfit) {
            best = PowerWithFloor{std::exp(line.offset), line.slope, floor, misfit};
        }
    }
    return best;
}

std::optional<Richardson> extrapolate(const std::array<double, 3>& h,
                                      const std::array<double, 3>& values)
{
    const double r21 = h[1] / h[0];
    const double r32 = h[2] / h[1];
    const double e21 = values[1] - values[0];
    const double e32 = values[2] - values[1];
    if (!(r21 > 1) || !(r32 > 1) || !(e32 / e21 > 0)) {
        return std::nullopt;
    }
    // Equation 3 of the source, r21^p (r32^p - 1)/(r21^p - 1) = e32/e21, whose left side rises with
    // p. Its fixed point iteration crawls where the ratios differ much, so the root is bracketed.
    const auto excess = [&](double p) {
        return p * std::log(r21) + std::log(std::expm1(p * std::log(r32))) -
               std::log(std::expm1(p * std::log(r21))) - std::log(e32 / e21);
    };
    double low = 1e-6;
    double high = 50; // no scheme is of such an order
    if (excess(low) > 0 || excess(high) < 0) {
        return std::nullopt;
    }
    for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (low + high);
        (excess(middle) < 0 ? low : high) = middle;
    }
    const double p = 0.5 * (low + high);
    const double gain = std::expm1(p * std::log(r21));
    const double limit = values[0] - e21 / gain;
    return Richardson{p, limit, safety * std::abs(e21 / values[0]) / gain};
}

double median(std::span<const double> values)
{
    if (values.empty()) {
        return not_a_number;
    }
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const std::size_t n = sorted.size();
    return 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

} // namespace hyoryu
