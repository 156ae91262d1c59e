// SPDX-License-Identifier: MIT
#include "hyoryu/core/triangle_sides.hpp"
#include "hyoryu/geometry/mesh.hpp"

#include <fmt/format.h>

namespace hyoryu {

namespace {

/// How many edges do not have exactly two triangles that run along them in opposite directions.
struct EdgeFaults {
    std::size_t open = 0;
    std::size_t crowded = 0;
    std::size_t turned = 0;
};

EdgeFaults edge_faults(const Mesh& mesh)
{
    EdgeFaults faults;
    const std::vector<TriangleSide> sides = sorted_sides(mesh.triangles);
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
        std::size_t rising = 0;
        for (last = first; last < sides.size() && sides[last].low == sides[first].low &&
                           sides[last].high == sides[first].high;
             ++last) {
            const TriangleSide& s = sides[last];
            const std::array<int, 3>& corner = mesh.triangles[at(s.triangle)];
            rising += corner[at(s.side)] < corner[at(s.side + 1) % 3] ? 1 : 0;
        }
        const std::size_t count = last - first;
        faults.open += count == 1 ? 1 : 0;
        faults.crowded += count > 2 ? 1 : 0;
        faults.turned += count == 2 && rising != 1 ? 1 : 0;
    }
    return faults;
}

double extent(const Mesh& mesh)
{
    Vec3 low = mesh.corners.front();
    Vec3 high = low;
    for (const Vec3& corner : mesh.corners) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
    }
    return (high - low).norm();
}

} // namespace

std::string closure_fault(const Mesh& mesh)
{
    if (mesh.triangles.empty()) {
        return "it has no triangles";
    }
    const EdgeFaults faults = edge_faults(mesh);
    if (faults.open > 0) {
        return fmt::format("{} open edges", faults.open);
    }
    if (faults.crowded > 0) {
        return fmt::format("{} edges with more than two triangles", faults.crowded);
    }
    if (faults.turned > 0) {
        return fmt::format("neighbouring triangles have opposite orientations at {} edges",
                           faults.turned);
    }
    const double size = extent(mesh);
    constexpr double flat = 1e-9; // of the cube of the extent
    if (!(solid_properties(mesh).volume > flat * size * size * size)) {
        return "its volume is zero";
    }
    return {};
}

SolidProperties solid_properties(const Mesh& mesh)
{
    SolidProperties solid;
    if (mesh.corners.empty()) {
        return solid;
    }
    // Signed tetrahedra from one corner of the mesh, which keeps the numbers small far from the
    // origin. Of a tetrahedron 0abc: volume det(abc)/6, centroid (a+b+c)/4, and
    // integral of x x^T = volume/20 (aa^T + bb^T + cc^T + ss^T), s = a+b+c  (Tonon 2004).
    const Vec3 origin = mesh.corners.front();
    Vec3 first = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 a = mesh.corners[i] - origin;
        const Vec3 b = mesh.corners[j] - origin;
        const Vec3 c = mesh.corners[k] - origin;
        const Vec3 s = a + b + c;
        const double volume = a.dot(b.cross(c)) / 6;
        solid.volume += volume;
        first += volume / 4 * s;
        second += volume / 20 *
                  (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
    if (solid.volume != 0) {
        const Vec3 centre = first / solid.volume;
        solid.centroid = origin + centre;
        solid.second_moment = second - solid.volume * centre * centre.transpose();
    }
    return solid;
}

} // namespace hyoryu
