// SPDX-License-Identifier: MIT
#include "hyoryu/sim/junctions.hpp"

#include "hyoryu/core/parallel.hpp"
#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/scene/solid_surface.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hyoryu {

namespace {

constexpr double parallel = 0.9; // cosine of normals that divide no force

bool is_obstacle(const Wall& wall)
{
    const auto* solid = std::get_if<SolidWall>(&wall.geometry);
    const auto* mesh = solid != nullptr ? std::get_if<MeshShape>(&solid->shape) : nullptr;
    return solid != nullptr && !(mesh != nullptr && mesh->terrain);
}

// Finds the particles in the ground near obstacles, if one of the two has a gauge.
class JunctionSearch {
public:
    JunctionSearch(const Simulation& sim, const std::vector<Vec3>& ways)
        : sim_(sim), ways_(ways), reach_(sim.fluid->kernel.support),
          gauged_(sim.scene.walls.size(), false)
    {
        for (const GaugedForce& force : sim.gauges.forces) {
            if (force.target < 0) {
                gauged_[at(-1 - force.target)] = true;
            }
        }
        bool by_ground = false;
        for (std::size_t w = 0; w < sim.scene.walls.size(); ++w) {
            const bool obstacle = is_obstacle(sim.scene.walls[w]);
            by_ground = by_ground || (gauged_[w] && !obstacle);
            (obstacle ? obstacles_ : grounds_).push_back(static_cast<int>(w));
        }
        const bool periodic = sim.fluid->period != Vec3(0, 0, 0); // where images are near
        if (!by_ground && !periodic) {
            const std::vector<int> all = obstacles_;
            std::erase_if(obstacles_, [&](int wall) { return !is_near_gauged(wall, all); });
        }
    }

    bool any() const
    {
        return !obstacles_.empty() && std::ranges::find(gauged_, true) != gauged_.end();
    }

    std::optional<JunctionRow> look_at(std::int32_t row) const
    {
        const Store& store = sim_.fluid->particles.wall;
        const Vec3 place = store[field::position][row];
        const int owner = -1 - store.owner()[row];
        JunctionRow found{.row = row, .owner = owner, .ground = ground_at(place, owner)};
        found.obstacle = owner != found.ground ? owner : nearest_obstacle(found.ground, place);
        // Which wall has a gauge does not change what belongs to which.
        const bool asked =
            found.obstacle >= 0 &&
            (gauged_[at(owner)] || gauged_[at(found.ground)] || gauged_[at(found.obstacle)]);
        return asked && divide(place, found) ? std::optional(found) : std::nullopt;
    }

private:
    // Whether one with a gauge may compete with it for a particle, or is itself.
    bool is_near_gauged(int wall, const std::vector<int>& all) const
    {
        const auto middle = [&](int k) {
            return Vec3(sim_.barrier->solids[at(k)].centre + ways_[at(k)]);
        };
        const auto reach = [&](int k) { return sim_.barrier->solids[at(k)].reach; };
        return std::ranges::any_of(all, [&](int other) {
            if (!gauged_[at(other)]) {
                return false;
            }
            const double apart = (middle(wall) - middle(other)).norm();
            return !(apart > reach(wall) + reach(other) + 2 * reach_);
        });
    }

    NearestPlace nearest(int wall, const Vec3& place, double farthest) const
    {
        return nearest_from_centre(sim_.barrier->solids[at(wall)], from_centre(wall, place),
                                   farthest);
    }

    // From the centre of a wall to a place, or to its image that is nearest to it.
    Vec3 from_centre(int wall, const Vec3& place) const
    {
        Vec3 way = place - sim_.barrier->solids[at(wall)].centre - ways_[at(wall)];
        const Vec3& period = sim_.fluid->period;
        for (int a = 0; a < 3; ++a) {
            way[a] -= period[a] > 0 ? std::round(way[a] / period[a]) * period[a] : 0;
        }
        return way;
    }

    // The wall that a particle is in: of an obstacle that reaches into the ground, the ground.
    int ground_at(const Vec3& place, int owner) const
    {
        if (is_obstacle(sim_.scene.walls[at(owner)])) {
            for (const int ground : grounds_) {
                if (nearest(ground, place, infinity).distance < 0) {
                    return ground;
                }
            }
        }
        return owner;
    }

    // That whose surface is nearest to a place of the ground; -1 if none is within reach.
    int nearest_obstacle(int ground, const Vec3& place) const
    {
        int best = -1;
        double least = reach_;
        for (const int wall : obstacles_) {
            const double reach = sim_.barrier->solids[at(wall)].reach + reach_;
            if (wall == ground || from_centre(wall, place).norm() > reach) {
                continue;
            }
            const double distance = std::abs(nearest(wall, place, reach_).distance);
            if (distance < least) {
                best = wall;
                least = distance;
            }
        }
        return best;
    }

    // False if the two do not meet in a corner. An obstacle that another one stands on is ground
    // where it faces up. The normal of the obstacle that water beside it sees is looked for above
    // the ground, where the side that it stands on is not the nearest.
    bool divide(const Vec3& place, JunctionRow& found) const
    {
        constexpr double upright = 0.7;
        const NearestPlace ground = nearest(found.ground, place, infinity);
        const Vec3& n = ground.normal;
        const bool faces_up = n.dot(sim_.scene.gravity) <= -upright * sim_.scene.gravity.norm();
        if (is_obstacle(sim_.scene.walls[at(found.ground)]) && !faces_up) {
            return false;
        }
        const Vec3 on_ground = place - ground.distance * n;
        const Vec3 m = nearest(found.obstacle, on_ground + reach_ * n, infinity).normal;
        const double cosine = n.dot(m);
        found.normal = n;
        if (std::abs(cosine) < parallel) {
            found.share = (n - cosine * m) / (1 - sq(cosine));
            return true;
        }
        found.part = 1; // a piston covers a side, which has no share
        return cosine > 0 && !faces_up && nearest(found.obstacle, on_ground, infinity).distance < 0;
    }

    const Simulation& sim_;
    const std::vector<Vec3>& ways_; // of the walls since time 0 [m]
    double reach_;                  // [m]
    std::vector<bool> gauged_;
    std::vector<int> grounds_, obstacles_;
};

void find_junctions(Simulation& sim, const std::vector<Vec3>& ways)
{
    const FluidNeighbours& n = sim.fluid->neighbours;
    sim.loads.junctions.rows.clear();
    sim.loads.junctions.builds = n.builds;
    sim.loads.junctions.ways = ways;
    const JunctionSearch search(sim, ways);
    if (!search.any()) {
        return;
    }
    std::vector<std::vector<JunctionRow>> of_tile(n.wet_walls.size());
    parallel_for(0, static_cast<Index>(n.wet_walls.size()), [&](Index k) {
        const std::int32_t tile = n.wet_walls[at(k)];
        for (std::int32_t slot = n.wall.start[at(tile)]; slot < n.wall.start[at(tile + 1)];
             ++slot) {
            if (const auto found = search.look_at(n.wall.row[at(slot)])) {
                of_tile[at(k)].push_back(*found);
            }
        }
    });
    for (const std::vector<JunctionRow>& rows : of_tile) {
        sim.loads.junctions.rows.insert(sim.loads.junctions.rows.end(), rows.begin(), rows.end());
    }
}

} // namespace

void collect_junctions(Simulation& sim)
{
    Junctions& junctions = sim.loads.junctions;
    OwnerSums<3>& sums = sim.loads.of_junctions;
    const bool wanted = std::ranges::any_of(
        sim.gauges.forces, [](const GaugedForce& force) { return force.target < 0; });
    const FixedUnit unit = sum_units(sim.fluid->parameters).force;
    sums.begin(wanted && sim.barrier ? sim.scene.walls.size() : 0, {unit, unit, unit});
    if (sums.owners() == 0) {
        return;
    }
    std::vector<Vec3> ways;
    for (const Wall& wall : sim.scene.walls) {
        ways.push_back(displacement(wall.motion, sim.clock.time));
    }
    if (ways != junctions.ways || junctions.builds != sim.fluid->neighbours.builds) {
        find_junctions(sim, ways);
    }
    const auto F = sim.fluid->particles.wall[field::force];
    for (const JunctionRow& foot : junctions.rows) {
        const Vec3& force = F[foot.row];
        const Vec3 of_obstacle = foot.part * (force - force.dot(foot.share) * foot.normal);
        const Vec3 moved = foot.owner == foot.ground ? of_obstacle : Vec3(of_obstacle - force);
        sums.add(at(foot.obstacle), {moved.x(), moved.y(), moved.z()});
        sums.add(at(foot.ground), {-moved.x(), -moved.y(), -moved.z()});
    }
}

} // namespace hyoryu
