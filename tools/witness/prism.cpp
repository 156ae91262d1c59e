// SPDX-License-Identifier: MIT
#include "prism.hpp"

#include <algorithm>
#include <utility>

namespace witness {

namespace {

struct Line {
    Vec3 low, high; // by y
    double x_at(double y) const
    {
        return low.x() + (high.x() - low.x()) * (y - low.y()) / (high.y() - low.y());
    }
};

// Two triangles that face up, or down.
void add_level(Mesh& mesh, const std::pair<double, double>& below,
               const std::pair<double, double>& above, double y0, double y1, double z, int facing)
{
    const int first = static_cast<int>(mesh.corners.size());
    mesh.corners.emplace_back(below.first, y0, z);
    mesh.corners.emplace_back(below.second, y0, z);
    mesh.corners.emplace_back(above.second, y1, z);
    mesh.corners.emplace_back(above.first, y1, z);
    for (const int k : {1, 2}) {
        mesh.triangles.push_back(facing > 0 ? std::array<int, 3>{first, first + k, first + k + 1}
                                            : std::array<int, 3>{first, first + k + 1, first + k});
    }
}

// Top and bottom in slabs between the corners' y: between the first and the second edge that cross
// a slab the solid is inside, between the third and the fourth, and so on.
void add_levels(Mesh& mesh, const std::vector<Line>& lines, const std::vector<double>& cuts,
                double bottom, double top)
{
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
        const double y0 = cuts[c];
        const double y1 = cuts[c + 1];
        std::vector<Line> crossing;
        for (const Line& line : lines) {
            if (line.low.y() <= y0 && line.high.y() >= y1) {
                crossing.push_back(line);
            }
        }
        std::sort(crossing.begin(), crossing.end(), [&](const Line& a, const Line& b) {
            return a.x_at((y0 + y1) / 2) < b.x_at((y0 + y1) / 2);
        });
        for (std::size_t k = 0; k + 1 < crossing.size(); k += 2) {
            const std::pair below{crossing[k].x_at(y0), crossing[k + 1].x_at(y0)};
            const std::pair above{crossing[k].x_at(y1), crossing[k + 1].x_at(y1)};
            add_level(mesh, below, above, y0, y1, top, 1);
            add_level(mesh, below, above, y0, y1, bottom, -1);
        }
    }
}

} // namespace

Mesh prism_of(const std::vector<Vec3>& polygon, double bottom, double top)
{
    std::vector<Line> lines;
    std::vector<double> cuts;
    Mesh mesh;
    double area = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3& a = polygon[k];
        const Vec3& b = polygon[(k + 1) % polygon.size()];
        area += (a.x() * b.y() - b.x() * a.y()) / 2;
    }
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec3 a = polygon[k];
        const Vec3 b = polygon[(k + 1) % polygon.size()];
        cuts.push_back(a.y());
        bool is_bridge = false;
        for (std::size_t m = 0; m < polygon.size(); ++m) {
            const Vec3& c = polygon[m];
            const Vec3& d = polygon[(m + 1) % polygon.size()];
            is_bridge = is_bridge || (c.head<2>() == b.head<2>() && d.head<2>() == a.head<2>());
        }
        if (is_bridge) {
            continue;
        }
        if (a.y() != b.y()) {
            lines.push_back(a.y() < b.y() ? Line{a, b} : Line{b, a});
        }
        // With the solid on the left of its lower edge, seen from above.
        const int first = static_cast<int>(mesh.corners.size());
        const Vec3& from = area > 0 ? a : b;
        const Vec3& to = area > 0 ? b : a;
        mesh.corners.emplace_back(from.x(), from.y(), bottom);
        mesh.corners.emplace_back(to.x(), to.y(), bottom);
        mesh.corners.emplace_back(to.x(), to.y(), top);
        mesh.corners.emplace_back(from.x(), from.y(), top);
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
    }
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    add_levels(mesh, lines, cuts, bottom, top);
    return mesh;
}

} // namespace witness
