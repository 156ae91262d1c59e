// SPDX-License-Identifier: MIT
#include "ellipse.hpp"
#include "tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Newton steps; a handful is the rule.
constexpr int most_steps = 40;

// The point nearest to (x, y), x, y and beta >= 0, kappa = 1 - beta^2, with the outward normal: the
// largest root s of (x/(s + kappa))^2 + (beta y/s)^2 = 1, on which Newton's method closes in from
// below. Source: Eberly, Distance from a Point to an Ellipse (2013).
Foot nearest_foot(double x, double y, double beta, double kappa)
{
    double s = std::max(beta * y, x - kappa);
    if (s <= 0) { // on the major axis, within the centres of curvature
        const double cosine = kappa > 0 ? std::min(x / kappa, 1.0) : 0;
        const double sine = std::sqrt(1 - sq(cosine));
        return {{cosine, sine}, {beta * cosine, std::max(sine, no_direction)}};
    }
    for (int k = 0; k < most_steps; ++k) {
        const double p = sq(x / (s + kappa));
        const double q = sq(beta * y / s);
        const double next = s + 0.5 * (p + q - 1) / (p / (s + kappa) + q / s);
        if (next <= s) {
            break;
        }
        s = next;
    }
    const Eigen::Vector2d angle(x / (s + kappa), beta * y / s);
    return {angle.normalized(), {x * s, y * (s + kappa)}};
}

// Whether the ellipse has a second normal through the point, on its other long side: within the
// evolute, m = |beta y|.
bool has_far_foot(double x, double m, double kappa)
{
    return std::cbrt(sq(x)) + std::cbrt(sq(m)) < std::cbrt(sq(kappa));
}

// The angle of that second foot: cosine (kappa - m/sine) = x, a concave function of the cosine, on
// the smallest root of which Newton's method closes in from below.
Eigen::Vector2d far_angle(double x, double m, double kappa)
{
    double cosine = x / kappa;
    for (int k = 0; k < most_steps; ++k) {
        const double sine2 = 1 - sq(cosine);
        const double sine = std::sqrt(sine2);
        const double slope = kappa - m / (sine * sine2);
        const double next = cosine + (x - cosine * (kappa - m / sine)) / slope;
        if (next <= cosine) {
            break;
        }
        cosine = next;
    }
    return {cosine, std::sqrt(1 - sq(cosine))};
}

} // namespace

std::optional<Foot> upper_foot(double x, double y, double beta)
{
    const double kappa = 1 - sq(beta);
    const double m = std::abs(beta * y);
    const bool inside = has_far_foot(std::abs(x), m, kappa);
    Foot foot;
    if (!(beta < 0) && (y >= 0 || !inside)) {
        foot = nearest_foot(std::abs(x), std::abs(y), beta, kappa);
        foot.angle.y() *= y < 0 ? -1 : 1;
        foot.normal.y() *= y < 0 ? -1 : 1;
    } else if (!inside) {
        return std::nullopt;
    } else {
        foot.angle = y < 0 && beta < 0 ? nearest_foot(std::abs(x), -y, -beta, kappa).angle
                                       : far_angle(std::abs(x), m, kappa);
        foot.normal = {beta * foot.angle.x(), foot.angle.y()};
    }
    foot.angle.x() *= x < 0 ? -1 : 1;
    foot.normal.x() *= x < 0 ? -1 : 1;
    return foot;
}

} // namespace hyoryu
