// SPDX-License-Identifier: MIT
// A results folder as a run would leave it, made of formulae: a wave runs down a flume, lifts
// timbers and breaks on a house.
#pragma once

#include "hyoryu/core/types.hpp"
#include "hyoryu/io/results.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

namespace hyoryu::test_help {

/// The eight corners and twelve triangles of a box, turned outwards or, for a tank, inwards.
inline void add_box(Surface& surface, std::vector<std::int32_t>& owner, const Vec3& centre,
                    const Vec3& half, const Mat3& turn, std::int32_t index, bool inwards)
{
    constexpr std::array<std::array<int, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    const auto first = static_cast<std::int32_t>(surface.points.size() / 3);
    for (int k = 0; k < 8; ++k) {
        const Vec3 corner((k & 1) != 0 ? half.x() : -half.x(), (k & 2) != 0 ? half.y() : -half.y(),
                          (k & 4) != 0 ? half.z() : -half.z());
        const Vec3 place = centre + turn * corner;
        for (int axis = 0; axis < 3; ++axis) {
            surface.points.push_back(static_cast<float>(place[axis]));
        }
        owner.push_back(index);
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (inwards && f == 1) {
            continue; // the tank is open above
        }
        for (const std::array<int, 3>& corner : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
            for (const int c : corner) {
                const int k = inwards ? corner[2] + corner[0] - c : c;
                surface.triangles.push_back(
                    first + faces[f][static_cast<std::size_t>(c == corner[1] ? corner[1] : k)]);
            }
        }
    }
}

/// Height of the water at x.
inline double wave(double x, double time)
{
    const double front = 2.0 + 2.5 * time;
    return 0.12 + 0.55 / (1 + std::exp((x - front) / 0.18)) + 0.05 * std::sin(5 * x - 8 * time);
}

inline Cloud make_water(std::int64_t index, double spacing)
{
    Cloud cloud{.name = "fluid",
                .time = 0.1 * static_cast<double>(index),
                .index = index,
                .points = {},
                .columns = {}};
    std::vector<float> velocity;
    std::vector<float> pressure;
    for (double x = 0.5 * spacing; x < 6; x += spacing) {
        for (double y = 0.5 * spacing; y < 1; y += spacing) {
            const double height = wave(x, cloud.time) + 0.02 * std::sin(20 * y + 9 * x);
            for (double z = 0.5 * spacing; z < height; z += spacing) {
                if (x > 4.6 && x < 5.0 && y > 0.3 && y < 0.7 && z < 0.5) {
                    continue;
                }
                const double jitter = 0.2 * spacing * std::sin(1e4 * (x + 3 * y + 7 * z));
                const double speed = 2.5 * (height - 0.05) / 0.6 * (0.6 + 0.5 * z / height);
                for (const double part : {x + jitter, y - jitter, z + jitter}) {
                    cloud.points.push_back(static_cast<float>(part));
                }
                for (const double part : {speed, 0.1 * speed * std::sin(20 * y), 0.0}) {
                    velocity.push_back(static_cast<float>(part));
                }
                pressure.push_back(static_cast<float>(9810 * (height - z)));
            }
        }
    }
    cloud.columns = {{"Velocity", "m/s", 3, velocity}, {"Pressure", "Pa", 1, pressure}};
    return cloud;
}

/// The row of water nearest to y = 0, in the plane y = 0: a 2-D case.
inline Cloud make_plane_water(std::int64_t index, double spacing)
{
    const Cloud water = make_water(index, spacing);
    const auto& velocity = std::get<std::vector<float>>(water.columns[0].values);
    Cloud plane{.name = "fluid", .time = water.time, .index = index, .points = {}, .columns = {}};
    std::vector<float> in_plane;
    for (std::size_t i = 0; i < water.points.size(); i += 3) {
        if (water.points[i + 1] < static_cast<float>(spacing)) {
            plane.points.insert(plane.points.end(), {water.points[i], 0.0F, water.points[i + 2]});
            in_plane.insert(in_plane.end(), {velocity[i], 0.0F, velocity[i + 2]});
        }
    }
    plane.columns = {{"Velocity", "m/s", 3, in_plane}};
    return plane;
}

inline Surface make_timbers(std::int64_t index, int count)
{
    Surface surface{.name = "surfaces",
                    .time = 0.1 * static_cast<double>(index),
                    .index = index,
                    .points = {},
                    .triangles = {},
                    .columns = {}};
    std::vector<std::int32_t> body;
    for (int b = 0; b < count; ++b) {
        const double x = 1.0 + 0.35 * b + 0.8 * surface.time;
        const double y = 0.2 + 0.25 * (b % 3);
        const Mat3 turn = (Eigen::AngleAxisd(0.7 * b + surface.time, Vec3::UnitZ()) *
                           Eigen::AngleAxisd(0.2 * std::sin(b + 3 * surface.time), Vec3::UnitY()))
                              .toRotationMatrix();
        add_box(surface, body, {x, y, wave(x, surface.time) + 0.02}, {0.2, 0.04, 0.04}, turn, b,
                false);
    }
    surface.columns = {{"Body", "", 1, body}};
    return surface;
}

inline Surface make_flume()
{
    Surface surface{
        .name = "structures", .time = 0, .index = 0, .points = {}, .triangles = {}, .columns = {}};
    std::vector<std::int32_t> wall;
    add_box(surface, wall, {3, 0.5, 0.5}, {3, 0.5, 0.5}, Mat3::Identity(), 0, true);
    add_box(surface, wall, {4.8, 0.5, 0.25}, {0.2, 0.2, 0.25}, Mat3::Identity(), 1, false);
    surface.columns = {{"Wall", "", 1, wall}};
    return surface;
}

/// Wall particles of the same flume.
inline Cloud make_wall_particles(double spacing)
{
    Cloud cloud{.name = "walls", .time = 0, .index = 0, .points = {}, .columns = {}};
    for (double x = -0.5 * spacing; x < 6 + spacing; x += spacing) {
        for (double y = -0.5 * spacing; y < 1 + spacing; y += spacing) {
            for (double z = -0.5 * spacing; z < 1; z += spacing) {
                const bool house = x > 4.6 && x < 5.0 && y > 0.3 && y < 0.7 && z < 0.5;
                if (x < 0 || x > 6 || y < 0 || y > 1 || z < 0 || house) {
                    for (const double part : {x, y, z}) {
                        cloud.points.push_back(static_cast<float>(part));
                    }
                }
            }
        }
    }
    return cloud;
}

inline void write_flood(const std::filesystem::path& folder, double spacing, std::int64_t frames)
{
    FrameWriter writer(folder);
    writer.write(make_flume(), FramePlace::alone);
    writer.write(make_wall_particles(spacing), FramePlace::alone);
    for (std::int64_t index = 0; index < frames; ++index) {
        writer.write(make_water(index, spacing));
        writer.write(make_timbers(index, 6));
    }
    writer.finish();
}

} // namespace hyoryu::test_help
