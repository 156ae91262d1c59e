// SPDX-License-Identifier: MIT
#include "solid_places.hpp"

#include "hyoryu/fluid/ghosts.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// The bodies as they are now.
std::vector<Pose> present_poses(const Rigid& rigid)
{
    std::vector<Pose> poses;
    for (const Body& body : rigid.bodies) {
        poses.push_back({body.position, body.orientation});
    }
    return poses;
}

// The solids that a box about a centre may meet.
void find_solids(const WallBarrier& barrier, std::span<const SolidPlace> places, const Vec3& low,
                 const Vec3& high, std::vector<std::size_t>& near)
{
    near.clear();
    Vec3 half = (high - low) / 2;
    half.y() = barrier.dimensions == 2 ? 0 : half.y();
    const double reach = half.norm();
    for (std::size_t k = 0; k < barrier.solids.size(); ++k) {
        const NearestPlace place =
            nearest_of(barrier, places[k], k, (low + high) / 2, 1.001 * reach);
        if (place.distance <= 1.001 * reach) {
            near.push_back(k);
        }
    }
}

} // namespace

void place_solids(const Simulation& sim, std::span<const Pose> poses, double time,
                  std::vector<SolidPlace>& places)
{
    const WallBarrier& barrier = *sim.barrier;
    places.clear();
    for (std::size_t w = 0; w < barrier.walls; ++w) {
        const SolidSurface& solid = barrier.solids[w];
        const Motion& motion = sim.scene.walls[w].motion;
        places.push_back({solid.centre + displacement(motion, time),
                          solid.rotation.toRotationMatrix(), velocity(motion, time),
                          Vec3(0, 0, 0)});
    }
    for (std::size_t b = 0; b < poses.size(); ++b) {
        const Body& body = sim.rigid.bodies[b];
        places.push_back({poses[b].position, poses[b].orientation.toRotationMatrix(), body.velocity,
                          angular_velocity(body), body.left});
    }
}

NearestPlace nearest_of(const WallBarrier& barrier, const SolidPlace& place, std::size_t solid,
                        const Vec3& x, double farthest)
{
    Vec3 r = x - place.position;
    if (barrier.dimensions == 2) {
        r.y() = 0;
    }
    if (place.left || r.squaredNorm() > sq(barrier.solids[solid].reach + farthest)) {
        return {};
    }
    return nearest_place(barrier.solids[solid], place.rotation.transpose() * r, farthest);
}

Index particles_in_solids(const Simulation& sim)
{
    if (!sim.barrier) {
        return 0;
    }
    const WallBarrier& barrier = *sim.barrier;
    const Fluid& fluid = *sim.fluid;
    const double deep = 0.25 * barrier.spacing;
    std::vector<SolidPlace> places;
    place_solids(sim, present_poses(sim.rigid), sim.clock.time, places);
    const auto x = fluid.particles.fluid[field::position];
    const auto counts = [&](Index row) {
        return sim.open.boundary.carpets.empty() || !is_behind(sim.open.boundary, x[row]);
    };
    const auto inside = [&](const Vec3& p, std::span<const std::size_t> near) {
        bool in = false;
        for_images(fluid, p, 0, [&](const Vec3& image) {
            for (const std::size_t k : near) {
                in = in || nearest_of(barrier, places[k], k, image, infinity).distance < -deep;
            }
        });
        return in;
    };
    // Rows that follow each other are near each other: together they meet few solids.
    constexpr Index group = 64;
    const Index rows = fluid.particles.fluid.size();
    const Index own = sum(0, (rows + group - 1) / group, Index(0), [&](Index block) {
        const Index last = std::min(rows, (block + 1) * group);
        Bounds box;
        for (Index i = block * group; i < last; ++i) {
            if (counts(i)) {
                for_images(fluid, x[i], 0, [&](const Vec3& image) { box.add(image); });
            }
        }
        std::vector<std::size_t> near;
        find_solids(barrier, places, box.min, box.max, near);
        Index count = 0;
        for (Index i = block * group; i < last && !near.empty(); ++i) {
            count += counts(i) && inside(x[i], near) ? 1 : 0;
        }
        return count;
    });
    return count_over_ranks(fluid, own);
}

Index count_in_solids(Simulation& sim)
{
    const Index count = particles_in_solids(sim);
    sim.conservation.worst_in_solids = std::max(sim.conservation.worst_in_solids, count);
    return count;
}

} // namespace hyoryu
