// SPDX-License-Identifier: MIT
// Sliding along the unit direction d of the tangent plane: p = p_n (1, -mu d),
//   p_n = -b_n / den(d),   den = K_nn - mu K_nt . d,
//   u_t = b_t + p_n (K_tn - mu K_tt d)   must be parallel to d.
#include "cone.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <optional>

namespace hyoryu {

namespace {

using Vec2 = Eigen::Vector2d;

// Below this part of K_nn the denominator is that of a Painleve configuration (contact notes,
// section 1).
constexpr double painleve = 1e-12;
// A determinant below this part of the product of the diagonal means a direction that cannot move.
constexpr double singular = 1e-13;
// Most Newton steps: from the fixed-point guess the method converges quadratically or not at all.
constexpr int newton_steps = 12;
constexpr double settled_turn = 1e-9; // the square of it is below round-off [rad]
constexpr int fixed_point_steps = 3;
// A scan this fine brackets every root: the condition is a trigonometric polynomial of degree two.
constexpr int scan_points = 48;
constexpr int bisections = 60; // to the last bit

struct SlidingContact {
    double p_n = 0;
    Vec2 u{0, 0}; // remaining tangential velocity
    bool exists = false;
};

SlidingContact slip_along(const Cone& cone, const Vec3& b, const Vec2& d)
{
    const Vec2 k_nt = cone.K.block<1, 2>(0, 1).transpose();
    const Vec2 k_tn = cone.K.block<2, 1>(1, 0);
    const double den = cone.K(0, 0) - cone.mu * k_nt.dot(d);
    SlidingContact slip;
    slip.exists = den > painleve * cone.K(0, 0);
    if (slip.exists) {
        slip.p_n = -b[0] / den;
        slip.u = b.tail<2>() + slip.p_n * (k_tn - cone.mu * (cone.K.block<2, 2>(1, 1) * d));
    }
    return slip;
}

Vec3 impulse_along(const SlidingContact& slip, double mu, const Vec2& d)
{
    return {slip.p_n, -mu * slip.p_n * d.x(), -mu * slip.p_n * d.y()};
}

// d x w with w = den(d) u_t(d), smooth everywhere; zero where u_t is parallel to d. For d = (c, s)
// it is x c + y s + cc c^2 + cs c s + ss s^2.
struct Crossed {
    double x = 0, y = 0, cc = 0, cs = 0, ss = 0;

    double at(const Vec2& d) const
    {
        return d.x() * (x + cc * d.x() + cs * d.y()) + d.y() * (y + ss * d.y());
    }
    /// The derivative by the angle of d.
    double slope(const Vec2& d) const
    {
        return d.x() * (y + cs * d.x()) - d.y() * (x + cs * d.y()) + 2 * (ss - cc) * d.x() * d.y();
    }
};

Crossed crossed(const Cone& cone, const Vec3& b)
{
    const Mat3& K = cone.K;
    const double mu = cone.mu;
    Crossed f;
    f.x = K(0, 0) * b[2] - b[0] * K(2, 0);
    f.y = b[0] * K(1, 0) - K(0, 0) * b[1];
    f.cc = mu * (b[0] * K(2, 1) - K(0, 1) * b[2]);
    f.cs = mu * (b[0] * (K(2, 2) - K(1, 1)) - K(0, 2) * b[2] + K(0, 1) * b[1]);
    f.ss = mu * (K(0, 2) * b[1] - b[0] * K(1, 2));
    return f;
}

Vec2 at_angle(double angle)
{
    return {std::cos(angle), std::sin(angle)};
}

std::optional<Vec3> accepted(const Cone& cone, const Vec3& b, const Vec2& d)
{
    const SlidingContact slip = slip_along(cone, b, d);
    if (slip.exists && slip.u.dot(d) >= 0) {
        return impulse_along(slip, cone.mu, d);
    }
    return std::nullopt;
}

std::optional<Vec3> slide_by_newton(const Cone& cone, const Vec3& b, Vec2 d, int steps)
{
    const Crossed f = crossed(cone, b);
    for (int k = 0; k < steps; ++k) {
        const double slope = f.slope(d);
        if (slope == 0) {
            return std::nullopt;
        }
        const double change = -f.at(d) / slope;
        // rotation by `change`, up to a length that normalisation removes
        d = Vec2(d.x() - change * d.y(), d.y() + change * d.x()).normalized();
        if (std::abs(change) < settled_turn) {
            break;
        }
    }
    return accepted(cone, b, d);
}

// Fixed point d <- direction of u_t + c d, which leads Newton's method to the right root.
std::optional<Vec3> slide_by_fixed_point(const Cone& cone, const Vec3& b, Vec2 d)
{
    for (int k = 0; k < fixed_point_steps; ++k) {
        const SlidingContact slip = slip_along(cone, b, d);
        if (!slip.exists) {
            return std::nullopt;
        }
        const double c = cone.mu * slip.p_n * 0.5 * (cone.K(1, 1) + cone.K(2, 2));
        const Vec2 next = slip.u + c * d;
        if (next.squaredNorm() == 0) {
            return std::nullopt;
        }
        d = next.normalized();
    }
    return slide_by_newton(cone, b, d, newton_steps);
}

std::optional<Vec3> slide_by_scan(const Cone& cone, const Vec3& b)
{
    const double step = 2 * std::numbers::pi / scan_points;
    const Crossed f = crossed(cone, b);
    for (int k = 0; k < scan_points; ++k) {
        double low = k * step;
        double high = low + step;
        double f_low = f.at(at_angle(low));
        if (f_low * f.at(at_angle(high)) > 0) {
            continue;
        }
        for (int m = 0; m < bisections; ++m) {
            const double mid = 0.5 * (low + high);
            const double f_mid = f.at(at_angle(mid));
            (f_mid * f_low > 0 ? low : high) = mid;
            f_low = f_mid * f_low > 0 ? f_mid : f_low;
        }
        if (const auto p = accepted(cone, b, at_angle(0.5 * (low + high)))) {
            return p;
        }
    }
    return std::nullopt;
}

// The direction of the guess usually needs only a Newton correction.
std::optional<Vec3> slide_in_space(const Cone& cone, const Vec3& b, const Vec3& stick,
                                   const Vec3& guess, int steps)
{
    const bool known = guess.tail<2>().squaredNorm() > 0;
    const Vec2 d =
        known ? Vec2(-guess.tail<2>().normalized()) : Vec2(-stick.tail<2>().normalized());
    std::optional<Vec3> slide = known ? slide_by_newton(cone, b, d, steps) : std::nullopt;
    if (!slide) {
        slide = slide_by_fixed_point(cone, b, d);
    }
    return slide ? slide : slide_by_scan(cone, b);
}

std::optional<Vec3> slide_in_plane(const Cone& cone, const Vec3& b)
{
    const double first = b[1] < 0 ? -1 : 1;
    for (const double d : {first, -first}) {
        const SlidingContact slip = slip_along(cone, b, Vec2(d, 0));
        if (slip.exists && slip.u.x() * d >= 0) {
            return impulse_along(slip, cone.mu, Vec2(d, 0));
        }
    }
    return std::nullopt;
}

// Whether no sliding impulse exists for fast sliding; it is then stopped at once (tangential
// impact).
bool jams(const Cone& cone, const Vec3& b)
{
    const Vec2 t = b.tail<2>();
    const double speed = t.norm();
    return speed > std::abs(b[0]) && !slip_along(cone, b, t / speed).exists;
}

} // namespace

void invert(Cone& cone)
{
    const Mat3& K = cone.K;
    cone.K_inverse.setZero();
    if (cone.size == 1) {
        cone.K_inverse(0, 0) = 1 / K(0, 0);
        return;
    }
    const Mat3 block = cone.size == 3 ? K : Mat3(K + Mat3(Vec3(0, 0, 1).asDiagonal()));
    const double bound = singular * block.diagonal().prod();
    if (block.determinant() > bound) {
        cone.K_inverse = block.inverse();
    } else {
        const Eigen::SelfAdjointEigenSolver<Mat3> modes(0.5 * (block + block.transpose()));
        for (int k = 0; k < 3; ++k) {
            if (modes.eigenvalues()[k] > singular * modes.eigenvalues()[2]) {
                const Vec3 v = modes.eigenvectors().col(k);
                cone.K_inverse += v * v.transpose() / modes.eigenvalues()[k];
            }
        }
    }
    if (cone.size == 2) {
        cone.K_inverse.row(2).setZero();
        cone.K_inverse.col(2).setZero();
    }
}

namespace {

ConeImpulse impulse_by(const Cone& cone, const Vec3& b, const Vec3& guess, int steps)
{
    if (b[0] >= 0) {
        return {};
    }
    if (cone.size == 1) {
        return {Vec3(-b[0] / cone.K(0, 0), 0, 0)};
    }
    const Vec3 stick = -(cone.K_inverse * b);
    if (stick[0] >= 0 && stick.tail<2>().norm() <= cone.mu * stick[0]) {
        return {stick, jams(cone, b)};
    }
    std::optional<Vec3> slide;
    if (cone.size == 2) {
        slide = slide_in_plane(cone, b);
    } else {
        slide = slide_in_space(cone, b, stick, guess, steps);
    }
    if (slide) {
        return {*slide};
    }
    return {stick[0] > 0 ? stick : Vec3(-b[0] / cone.K(0, 0), 0, 0), true};
}

} // namespace

ConeImpulse cone_impulse(const Cone& cone, const Vec3& b, const Vec3& guess)
{
    return impulse_by(cone, b, guess, newton_steps);
}

ConeImpulse nearer_impulse(const Cone& cone, const Vec3& b, const Vec3& guess)
{
    return impulse_by(cone, b, guess, 1);
}

} // namespace hyoryu
