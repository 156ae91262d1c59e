// SPDX-License-Identifier: MIT
// Fits the scene into the part of the picture that labels leave free.
#ifdef HYORYU_HAS_VTK
#include "camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double view_angle = 28;    // degrees, vertical: about a 85 mm lens
constexpr double free_width = 0.94;  // share of the picture that the scene may fill
constexpr double free_height = 0.78; // the colour scale and the time take the rest
constexpr double shift_up = 0.045;   // of the height: the scale below is taller than the time above

/// Right, up and towards the camera.
Mat3 view_axes(const Vec3& direction)
{
    const Vec3 right = Vec3::UnitZ().cross(direction).normalized();
    Mat3 axes;
    axes << right.transpose(), direction.cross(right).transpose(), direction.transpose();
    return axes;
}

/// The corners of the box as the camera would see them if it stood at the origin.
Eigen::Matrix<double, 3, 8> corners_in_view(const Box& box, const Mat3& axes)
{
    Eigen::Matrix<double, 3, 8> corners;
    for (int k = 0; k < 8; ++k) {
        corners.col(k) = axes * box.corner(static_cast<Box::CornerType>(k));
    }
    return corners;
}

struct Stand {
    Vec3 eye; // in view axes
    double distance = 0;
};

/// The nearest stand from which all corners lie within the slopes, horizontally and vertically. For
/// each axis the two tightest planes meet at one depth; the farther of the two depths holds for
/// both.
Stand nearest_stand(const Eigen::Matrix<double, 3, 8>& corners, double slope_x, double slope_y)
{
    const Eigen::Vector2d slopes(slope_x, slope_y);
    Stand stand;
    double depth = -infinity;
    Eigen::Vector2d low;
    Eigen::Vector2d high;
    for (int axis = 0; axis < 2; ++axis) {
        // A corner at (u, w) asks of an eye at (e, d): |u - e| <= slope (d - w).
        high[axis] = (corners.row(axis) + slopes[axis] * corners.row(2)).maxCoeff();
        low[axis] = (corners.row(axis) - slopes[axis] * corners.row(2)).minCoeff();
        depth = std::max(depth, (high[axis] - low[axis]) / (2 * slopes[axis]));
    }
    stand.eye << 0.5 * (high + low), depth;
    stand.distance = depth - corners.row(2).mean();
    return stand;
}

} // namespace

Vec3 view_direction(double azimuth_deg, double elevation_deg)
{
    constexpr double steepest = 89; // straight down, "up" would lose its meaning
    const double azimuth = azimuth_deg * degree;
    const double elevation = std::clamp(elevation_deg, -steepest, steepest) * degree;
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
}

void aim(vtkCamera& camera, const Box& box, const Vec3& direction, double aspect)
{
    const Mat3 axes = view_axes(direction);
    const double slope = std::tan(0.5 * view_angle * degree);
    const Stand stand =
        nearest_stand(corners_in_view(box, axes), slope * aspect * free_width, slope * free_height);
    const Vec3 eye = axes.transpose() * stand.eye;
    const Vec3 focus = eye - stand.distance * direction;
    camera.SetPosition(eye.data());
    camera.SetFocalPoint(focus.data());
    camera.SetViewUp(0, 0, 1);
    camera.SetViewAngle(view_angle);
    camera.SetWindowCenter(0, -2 * shift_up);
}

void aim_at_plane(vtkCamera& camera, const Box& box, double aspect)
{
    const Vec3 size = box.sizes();
    const Vec3 focus = box.center();
    const double half_height =
        0.5 * std::max(size.z() / free_height, size.x() / (aspect * free_width));
    camera.SetFocalPoint(focus.data());
    camera.SetPosition(focus.x(), focus.y() - 10 * half_height, focus.z());
    camera.SetViewUp(0, 0, 1);
    camera.ParallelProjectionOn();
    camera.SetParallelScale(half_height);
    camera.SetWindowCenter(0, -2 * shift_up);
}

} // namespace hyoryu
#endif
