// SPDX-License-Identifier: MIT
#include "hyoryu/geometry/outline.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace hyoryu {

Mesh prism_mesh(const PrismOutline& outline)
{
    Ring ring = outline.corners;
    if (signed_area(ring) < 0) {
        std::ranges::reverse(ring);
    }
    const std::vector<std::array<int, 3>> roof = ear_triangles(ring);
    if (roof.empty()) {
        return {};
    }
    // A corner of the mesh for each place: the two ends of a bridge are one.
    Mesh mesh;
    std::map<Plan2, int> number;
    std::vector<int> of_corner; // below; the one above it follows
    for (const Plan2& p : ring) {
        const auto [at, is_new] = number.emplace(p, static_cast<int>(mesh.corners.size()));
        if (is_new) {
            mesh.corners.emplace_back(p[0], p[1], outline.bottom);
            mesh.corners.emplace_back(p[0], p[1], outline.top);
        }
        of_corner.push_back(at->second);
    }
    for (const auto& [i, j, k] : roof) {
        const int a = of_corner[i];
        const int b = of_corner[j];
        const int c = of_corner[k];
        mesh.triangles.push_back({a + 1, b + 1, c + 1});
        mesh.triangles.push_back({a, c, b});
    }
    std::set<std::array<int, 2>> edges;
    for (std::size_t k = 0; k < ring.size(); ++k) {
        edges.insert({of_corner[k], of_corner[(k + 1) % ring.size()]});
    }
    for (const auto& [a, b] : edges) {
        if (!edges.contains({b, a})) {
            mesh.triangles.push_back({a, b, b + 1});
            mesh.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return mesh;
}

} // namespace hyoryu
