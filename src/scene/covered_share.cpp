// SPDX-License-Identifier: MIT
#include "hyoryu/scene/covered_share.hpp"

#include <algorithm>

namespace hyoryu {

std::vector<int> fixed_walls_of(const Scene& scene)
{
    std::vector<int> fixed;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        if (!moves(scene.walls[w].motion)) {
            fixed.push_back(static_cast<int>(w));
        }
    }
    return fixed;
}

double uncovered_share(std::span<const SolidSurface> surfaces, std::span<const int> fixed,
                       const Vec3& place, double edge)
{
    double share = 1;
    for (const int k : fixed) {
        const SolidSurface& solid = surfaces[static_cast<std::size_t>(k)];
        const Vec3 own = solid.rotation.conjugate() * (place - solid.centre);
        share *= std::clamp(0.5 + nearest_place(solid, own).distance / edge, 0.0, 1.0);
    }
    return share;
}

} // namespace hyoryu
