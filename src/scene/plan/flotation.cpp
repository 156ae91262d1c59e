// SPDX-License-Identifier: MIT
#include "hyoryu/scene/flotation.hpp"

#include "hyoryu/scene/rigid_scene.hpp"
#include "hyoryu/scene/triangles.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

constexpr double level_accuracy = 1e-12; // of the size of the body
constexpr double tilt_step = 1e-4;       // of differences for GM [rad]
constexpr double first_turn = 0.02;      // out of an unstable state [rad]
constexpr double largest_turn = 0.1;     // of a step downhill [rad]
constexpr double at_rest = 1e-6;         // lever of a state of rest over the size of the body
constexpr double small_turn = 1e-7;      // with which the search ends [rad]
constexpr double least_part = 1e-6;      // of a turn, where none goes further downhill
constexpr double facets = 0.03;          // of the radius: the error of GM by facets of round shapes
constexpr int most_turns = 300;

struct Part {
    double volume = 0; // [m3], m2 in two dimensions
    Vec3 first = Vec3::Zero();
};

// The part of a triangle below the level, as a polygon.
std::vector<Vec3> below(const std::array<Vec3, 3>& t, const Vec3& up, double level)
{
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& p = t[k];
        const Vec3& q = t[(k + 1) % 3];
        const double a = up.dot(p) - level;
        const double b = up.dot(q) - level;
        if (a <= 0) {
            kept.push_back(p);
        }
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
            kept.emplace_back(p + a / (a - b) * (q - p));
        }
    }
    return kept;
}

double radius_of(const Shape& shape)
{
    if (const auto* sphere = std::get_if<SphereShape>(&shape)) {
        return sphere->radius;
    }
    const auto* cylinder = std::get_if<CylinderShape>(&shape);
    return cylinder != nullptr ? cylinder->radius : 0;
}

class Hull {
public:
    Hull(const BodySettings& body, int dimensions)
        : dimensions_(dimensions), surface_(triangles_of(body.shape, dimensions)),
          neutral_(facets * radius_of(body.shape))
    {
        move_to_middle(body, surface_.corners);
        for (const Vec3& corner : surface_.corners) {
            size_ = std::max(size_, corner.norm());
        }
        whole_ = part_below(Vec3::UnitZ(), 2 * size_).volume;
    }

    double size() const { return size_; }
    // A lever and a metacentric height up to which facets cannot be told from a round shape [m].
    double neutral() const { return neutral_; }
    int dimensions() const { return dimensions_; }

    // The part below the level, summed over cones from a point of the level to the surface; the cap
    // in the level has no volume as seen from that point; in two dimensions the triangles are the
    // section itself.
    Part part_below(const Vec3& up, double level) const
    {
        Part part;
        const Vec3 apex = dimensions_ == 3 ? Vec3(level * up) : Vec3(Vec3::Zero());
        for (const auto& triangle : surface_.triangles) {
            const std::array<Vec3, 3> t{corner(triangle[0]), corner(triangle[1]),
                                        corner(triangle[2])};
            const std::vector<Vec3> polygon = below(t, up, level);
            for (std::size_t k = 2; k < polygon.size(); ++k) {
                add(polygon[0], polygon[k - 1], polygon[k], apex, part);
            }
        }
        return part;
    }

    // The level at which that share of the volume is below it.
    double level_of(const Vec3& up, double share) const
    {
        double low = lowest(up);
        double high = -lowest(-up);
        const double wanted = share * whole_;
        while (high - low > level_accuracy * size_) {
            const double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high) {
                break;
            }
            (part_below(up, middle).volume < wanted ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }

    double lowest(const Vec3& up) const
    {
        double low = infinity;
        for (const Vec3& corner : surface_.corners) {
            low = std::min(low, up.dot(corner));
        }
        return low;
    }

private:
    const Vec3& corner(int k) const { return surface_.corners[at(k)]; }

    void add(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& apex, Part& part) const
    {
        if (dimensions_ == 2) {
            const double area = 0.5 * (b - a).cross(c - a).norm();
            part.volume += area;
            part.first += area / 3 * (a + b + c);
            return;
        }
        const double volume = (a - apex).dot((b - apex).cross(c - apex)) / 6;
        part.volume += volume;
        part.first += volume / 4 * (apex + a + b + c);
    }

    int dimensions_;
    TriangleSurface surface_; // about the centre of mass
    double neutral_ = 0;      // [m]
    double size_ = 0;         // [m]
    double whole_ = 0;        // volume of the facets
};

// The centre of mass seen from the centre of buoyancy. Turned into the water level it is the lever
// of the righting couple, since the buoyancy moves along the level when the body tilts.
struct State {
    Vec3 lever = Vec3::Zero();
    double level = 0; // above the centre of mass along `up` [m]
};

State state_of(const Hull& hull, const Vec3& up, double share)
{
    State state;
    state.level = hull.level_of(up, share);
    const Part part = hull.part_below(up, state.level);
    state.lever = -part.first / part.volume;
    return state;
}

Vec3 across(const Vec3& up, const Vec3& v, int dimensions)
{
    Vec3 flat = v - up.dot(v) * up;
    if (dimensions == 2) {
        flat.y() = 0;
    }
    return flat;
}

std::array<Vec3, 2> tangents(const Vec3& up, int dimensions)
{
    const Vec3 first =
        dimensions == 2 ? Vec3::UnitY().cross(up).normalized() : Vec3(up.unitOrthogonal());
    return {first, up.cross(first)};
}

// How the lever grows with tilting, in the tangents: the second derivative of the energy.
Eigen::Matrix2d stiffness(const Hull& hull, const Vec3& up, double share)
{
    const auto t = tangents(up, hull.dimensions());
    const Index axes = hull.dimensions() == 2 ? 1 : 2;
    Eigen::Matrix2d slope = Eigen::Matrix2d::Zero();
    for (Index k = 0; k < axes; ++k) {
        const Vec3 way = tilt_step * t[at(k)];
        const Vec3 there = (up + way).normalized();
        const Vec3 back = (up - way).normalized();
        const Vec3 change = across(there, state_of(hull, there, share).lever, hull.dimensions()) -
                            across(back, state_of(hull, back, share).lever, hull.dimensions());
        for (Index m = 0; m < axes; ++m) {
            slope(m, k) = change.dot(t[at(m)]) / (2 * tilt_step);
        }
    }
    if (axes == 1) {
        slope(1, 1) = slope(0, 0); // no second axis: any stiffness will do
    }
    return 0.5 * (slope + slope.transpose());
}

using Axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>;

Flotation flotation_at(const Hull& hull, const Vec3& up, double share)
{
    const State state = state_of(hull, up, share);
    const double stiff = Axes(stiffness(hull, up, share)).eigenvalues()[0];
    const double least = std::abs(stiff) < hull.neutral() ? 0 : stiff;
    return {state.level - hull.lowest(up), least, up};
}

// Where to turn from a state: Newton's step where the energy is a bowl, else downhill; from a state
// of rest that is not stable along its axis of least resistance.
Vec3 turn_from(const Hull& hull, const Vec3& up, const Vec3& slope, double share)
{
    const auto t = tangents(up, hull.dimensions());
    const Axes axes(stiffness(hull, up, share));
    const Eigen::Vector2d g(slope.dot(t[0]), hull.dimensions() == 2 ? 0 : slope.dot(t[1]));
    Eigen::Vector2d turn;
    if (axes.eigenvalues()[0] > 0) {
        turn = -(axes.eigenvectors() *
                 (axes.eigenvectors().transpose() * g).cwiseQuotient(axes.eigenvalues()));
    } else if (g.norm() < at_rest * hull.size()) {
        turn = first_turn * (hull.dimensions() == 2 ? Eigen::Vector2d(1, 0)
                                                    : Eigen::Vector2d(axes.eigenvectors().col(0)));
    } else {
        turn = -largest_turn * g.normalized();
    }
    turn *= std::min(1.0, largest_turn / std::max(turn.norm(), at_rest));
    return turn[0] * t[0] + turn[1] * t[1];
}

// Downhill in the height of the centre of mass above that of buoyancy.
Vec3 resting_direction(const Hull& hull, Vec3 up, double share)
{
    double part = 1;
    double here = state_of(hull, up, share).lever.dot(up);
    for (int turn = 0; turn < most_turns && part > least_part; ++turn) {
        const Vec3 slope = across(up, state_of(hull, up, share).lever, hull.dimensions());
        if (slope.norm() < hull.neutral() &&
            Axes(stiffness(hull, up, share)).eigenvalues()[0] > -hull.neutral()) {
            break;
        }
        const Vec3 way = part * turn_from(hull, up, slope, share);
        if (way.norm() < small_turn) {
            break;
        }
        const Vec3 next = (up + way).normalized();
        const double there = state_of(hull, next, share).lever.dot(next);
        if (there < here) {
            up = next;
            here = there;
            part = std::min(1.0, 2 * part);
        } else {
            part *= 0.5;
        }
    }
    return up;
}

} // namespace

std::optional<Floating> flotation(const BodySettings& body, double fluid_density,
                                  const Vec3& gravity, int dimensions)
{
    const double share = effective_density(body, dimensions) / fluid_density;
    if (!(share < 1) || !(share > 0) || !(gravity.norm() > 0)) {
        return std::nullopt;
    }
    const Hull hull(body, dimensions);
    const Vec3 up = body.rotation.conjugate() * -gravity.normalized();
    Floating floating;
    floating.as_placed = flotation_at(hull, up, share);
    floating.at_rest = flotation_at(hull, resting_direction(hull, up, share), share);
    floating.tilt = std::acos(std::clamp(up.dot(floating.at_rest.up), -1.0, 1.0));
    return floating;
}

} // namespace hyoryu
