// SPDX-License-Identifier: MIT
#include "free_space.hpp"

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

// The sides of basins extend to infinity here: space beyond them is not free.
constexpr double endless = 1e9; // [m]

SolidSurface surface_of_block(const FluidBlock& block, int dimensions)
{
    BodySettings as_body;
    as_body.shape = block.shape;
    as_body.position = block.centre;
    as_body.rotation = block.rotation;
    return surface_of(as_body, dimensions);
}

} // namespace

FreeSpace::FreeSpace(const Scene& scene) : FreeSpace(scene, 0)
{
    for (const BodySettings& body : scene.bodies) {
        obstacles_.push_back(surface_of(body, scene.dimensions));
    }
    number_obstacles();
}

FreeSpace::FreeSpace(const Scene& scene, std::size_t block)
    : walls_(scene.walls.size()), dimensions_(scene.dimensions)
{
    for (const Wall& wall : scene.walls) {
        obstacles_.push_back(surface_of(wall, endless, scene.dimensions));
    }
    const std::vector<FluidBlock>& blocks = scene.fluid->blocks;
    const std::size_t end = blocks[block].seeded ? blocks.size() : block;
    for (std::size_t b = 0; b < end; ++b) {
        if (!blocks[b].seeded) {
            obstacles_.push_back(surface_of_block(blocks[b], scene.dimensions));
        }
    }
    number_obstacles();
}

void FreeSpace::number_obstacles()
{
    all_.resize(obstacles_.size());
    std::iota(all_.begin(), all_.end(), 0);
}

Vec3 FreeSpace::from(const SolidSurface& solid, const Vec3& point) const
{
    Vec3 r = point - solid.centre;
    r.y() = dimensions_ == 2 ? 0 : r.y();
    return r;
}

std::vector<int> FreeSpace::about(const Vec3& point, double distance) const
{
    std::vector<int> found;
    for (const int k : all_) {
        const SolidSurface& solid = obstacles_[at(k)];
        if (from(solid, point).norm() - solid.reach < distance) {
            found.push_back(k);
        }
    }
    return found;
}

NearestPlace FreeSpace::nearest(const Vec3& point, std::span<const int> among,
                                double farthest) const
{
    NearestPlace nearest;
    for (const int k : among) {
        const SolidSurface& solid = obstacles_[at(k)];
        const Vec3 r = from(solid, point);
        // The surface is not nearer than the ball that holds it.
        if (r.norm() - solid.reach >= nearest.distance) {
            continue;
        }
        const NearestPlace place = nearest_from_centre(solid, r, farthest);
        if (place.distance < nearest.distance) {
            nearest = place;
        }
    }
    return nearest;
}

bool FreeSpace::is_in_wall(const Vec3& point) const
{
    return nearest(point, all().first(walls_)).distance < 0;
}

bool step_off(const FreeSpace& space, std::span<const int> among, double distance, Vec3& point,
              double farthest)
{
    constexpr int tries = 10; // corners of several surfaces take some
    for (int k = 0; k < tries; ++k) {
        const NearestPlace nearest = space.nearest(point, among, farthest);
        const double lacking = distance - nearest.distance;
        if (lacking <= 1e-9 * distance) {
            return true;
        }
        point += lacking * nearest.normal;
    }
    return space.nearest(point, among, farthest).distance > 0;
}

} // namespace hyoryu
