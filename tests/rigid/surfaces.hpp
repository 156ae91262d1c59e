// SPDX-License-Identifier: MIT
// Triangle surfaces for tests.
#pragma once

#include "hyoryu/rigid/body.hpp"

#include <cmath>

namespace hyoryu::test {

/// A flat square floor at z = 0 over [-half, half]^2, cut into 2 n^2 triangles whose corners are
/// moved about within the plane, so that no edge is in line with anything.
inline MeshSurface flat_floor(double half, int n)
{
    MeshSurface mesh;
    const double step = 2 * half / n;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const bool rim = i == 0 || j == 0 || i == n || j == n;
            const double aside = rim ? 0 : 0.2 * step;
            mesh.corners.emplace_back(-half + i * step + aside * std::sin(7.0 * i + 3.0 * j),
                                      -half + j * step + aside * std::cos(5.0 * i - 2.0 * j), 0);
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const int k = i + (n + 1) * j;
            mesh.triangles.push_back({k, k + 1, k + n + 2});
            mesh.triangles.push_back({k, k + n + 2, k + n + 1});
        }
    }
    return mesh;
}

/// The closed surface of a convex polytope, every face as a fan.
inline MeshSurface surface_of(const Polytope& solid, const Vec3& position)
{
    MeshSurface mesh{solid.corners, {}, position, Quat::Identity()};
    for (const auto& face : solid.faces) {
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            mesh.triangles.push_back({face[0], face[k], face[k + 1]});
        }
    }
    return mesh;
}

/// A pyramid of square base at z = 0 with its tip at `height`.
inline MeshSurface spike(double half, double height)
{
    return {
        {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}, {0, 0, height}},
        {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}},
        Vec3::Zero(),
        Quat::Identity()};
}

} // namespace hyoryu::test
