// SPDX-License-Identifier: MIT
#include "hyoryu/sim/bed_friction.hpp"

#include "solid_places.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace hyoryu {

namespace {

constexpr double column_width = 4; // spacings
constexpr double fine = 1 << 30;   // parts of c0 that velocities are added in, as integers

// Whole columns across the domain, so that those of a periodic one are alike.
void lay_columns(const Fluid& fluid, BedFriction& bed)
{
    const double wanted = column_width * fluid.parameters.spacing;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto a = static_cast<Index>(axis);
        const bool flat = fluid.parameters.dimensions == 2 && axis == 1;
        const double length = fluid.domain_max[a] - fluid.domain_min[a];
        bed.count[axis] = flat ? 1 : std::max<Index>(1, static_cast<Index>(length / wanted));
        bed.width[axis] = flat ? 1 : length / static_cast<double>(bed.count[axis]);
    }
    const std::size_t columns = at(bed.count[0] * bed.count[1]);
    bed.particles.assign(columns, 0);
    bed.lowest.assign(columns, 0);
    bed.speeds.assign(columns, {0, 0, 0});
}

std::size_t column_of(const Fluid& fluid, const BedFriction& bed, const Vec3& x)
{
    const Vec3 own =
        fluid.period == Vec3(0, 0, 0) ? x : Vec3(fluid.neighbours.fluid.lattice.wrapped(x));
    std::array<Index, 2> cell{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto a = static_cast<Index>(axis);
        const double place = (own[a] - fluid.domain_min[a]) / bed.width[axis];
        cell[axis] = bed.count[axis] == 1
                         ? 0
                         : std::clamp(static_cast<Index>(place), Index(0), bed.count[axis] - 1);
    }
    return at(cell[1] * bed.count[0] + cell[0]);
}

// Sums of integers, which threads may add in any order.
void fill_columns(const Fluid& fluid, BedFriction& bed)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto v = fluid.particles.fluid[field::velocity];
    const double unit = fluid.parameters.eos.c0 / fine;
    parallel_for(0, fluid.particles.fluid.size(), [&](Index i) {
        const std::size_t column = column_of(fluid, bed, x[at(i)]);
        std::atomic_ref(bed.particles[column]).fetch_add(1, std::memory_order_relaxed);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto units = std::llround(v[at(i)][static_cast<Index>(axis)] / unit);
            std::atomic_ref(bed.speeds[column][axis]).fetch_add(units, std::memory_order_relaxed);
        }
    });
}

// Adds the columns of other ranks.
void add_other_columns(const Fluid& fluid, BedFriction& bed)
{
    std::vector<std::int64_t> numbers(bed.particles.begin(), bed.particles.end());
    numbers.insert(numbers.end(), bed.lowest.begin(), bed.lowest.end());
    for (const auto& speed : bed.speeds) {
        numbers.insert(numbers.end(), speed.begin(), speed.end());
    }
    fluid.ghosts->comm.add(numbers);
    const std::size_t columns = bed.particles.size();
    for (std::size_t k = 0; k < columns; ++k) {
        bed.particles[k] = static_cast<std::int32_t>(numbers[k]);
        bed.lowest[k] = static_cast<std::int32_t>(numbers[columns + k]);
        std::copy_n(&numbers[2 * columns + 3 * k], 3, bed.speeds[k].begin());
    }
}

// The depth of a column, at least a spacing [m]: the water over the area of the bed below it, which
// walls and the edge of the domain may cut. Where no particle is near the bed: over the column.
double depth_of(const Fluid& fluid, const BedFriction& bed, std::size_t column)
{
    const FluidParameters& f = fluid.parameters;
    const double of_particle = f.mass / f.eos.rho0;
    const double area = bed.lowest[column] > 0
                            ? bed.lowest[column] * of_particle / f.spacing
                            : bed.width[0] * (f.dimensions == 2 ? 1 : bed.width[1]);
    return std::max(bed.particles[column] * of_particle / area, static_cast<double>(f.spacing));
}

// Whether a wall is less than a spacing below a place, along gravity. A plate may be thinner.
bool is_lowest(const Simulation& sim, const Vec3& x, std::span<const int> solids)
{
    const WallBarrier& barrier = *sim.barrier;
    const Vec3 down = sim.scene.gravity.normalized() * barrier.spacing;
    bool found = false;
    for (const Vec3& below : {Vec3(x + down), Vec3(x + down / 2)}) {
        for_images(*sim.fluid, below, 0, [&](const Vec3& image) {
            found = found || std::ranges::any_of(solids, [&](int solid) {
                        const auto k = at(solid);
                        return k < barrier.walls &&
                               nearest_of(barrier, barrier.places[k], k, image, barrier.spacing)
                                       .distance <= 0;
                    });
        });
    }
    return found;
}

struct RoughPlace {
    int wall = -1;
    double distance = 0;    // [m]
    Vec3 normal{0, 0, 1};   // out of the wall
    Vec3 velocity{0, 0, 0}; // of the wall [m/s]
};

// The nearest rough wall within a spacing of a place.
RoughPlace nearest_rough(const Simulation& sim, const Vec3& x, std::span<const int> solids)
{
    const WallBarrier& barrier = *sim.barrier;
    RoughPlace found{.distance = barrier.spacing};
    for_images(*sim.fluid, x, barrier.spacing, [&](const Vec3& image) {
        for (const int wall : solids) {
            if (at(wall) >= barrier.walls || !(sim.scene.walls[at(wall)].manning > 0)) {
                continue;
            }
            const SolidPlace& place = barrier.places[at(wall)];
            const NearestPlace nearest =
                nearest_of(barrier, place, at(wall), image, barrier.spacing);
            if (nearest.distance < found.distance) {
                found = {wall, nearest.distance, place.rotation * nearest.normal, place.velocity};
            }
        }
    });
    return found;
}

// Brakes one particle; the wall gets what was taken from it.
void rub_row(Simulation& sim, Index i, std::span<const int> solids, double dt)
{
    Fluid& fluid = *sim.fluid;
    BedFriction& bed = sim.bed;
    const Vec3& x = std::as_const(fluid.particles.fluid)[field::position][at(i)];
    Vec3& v = fluid.particles.fluid[field::velocity][at(i)];
    const RoughPlace rough = nearest_rough(sim, x, solids);
    if (rough.wall < 0) {
        return;
    }
    const auto along = [&](const Vec3& velocity) {
        const Vec3 relative = velocity - rough.velocity;
        return Vec3(relative - relative.dot(rough.normal) * rough.normal);
    };
    const std::size_t column = column_of(fluid, bed, x);
    const auto& sum = bed.speeds[column];
    const double unit = fluid.parameters.eos.c0 / fine / bed.particles[column];
    const Vec3 mean = unit * Vec3(static_cast<double>(sum[0]), static_cast<double>(sum[1]),
                                  static_cast<double>(sum[2]));
    const Vec3 own = along(v);
    const double n = sim.scene.walls[at(rough.wall)].manning;
    const double braked = dt * sim.scene.gravity.norm() * sq(n) * along(mean).squaredNorm() /
                          (std::cbrt(depth_of(fluid, bed, column)) * sim.barrier->spacing);
    if (braked > 0 && own.norm() > 0) {
        const Vec3 taken = own * (braked / (own.norm() + braked));
        const Vec3 f = fluid.parameters.mass / dt * taken;
        v -= taken;
        sim.loads.of_walls.add(at(rough.wall), {f.x(), f.y(), f.z()});
    }
}

// Whether a particle may be within a spacing of a solid, according to the bounds of the barrier.
bool may_be_near(const WallBarrier& barrier, Index i, const Vec3& from_centre)
{
    const WallBarrier::Seen& seen = barrier.seen[at(i)];
    const Vec3 moved = from_centre - Vec3(seen.x, seen.y, seen.z);
    const double left = seen.clearance - barrier.way - barrier.spacing;
    return !(left > 0 && moved.squaredNorm() < sq(left));
}

// Calls f(i, x, solids) for the fluid rows that may be within a spacing of a solid, in parallel.
void for_rows_near(const Simulation& sim, const auto& f)
{
    const Tiles& tiles = sim.fluid->neighbours.fluid;
    const auto x = sim.fluid->particles.fluid[field::position];
    parallel_blocks(0, tiles.tiles(), [&](Index tile) {
        const Vec3 centre = tiles.lattice.centre(tiles.tile[at(tile)]);
        for (Index i = tiles.start[at(tile)]; i < tiles.start[at(tile + 1)]; ++i) {
            const Vec3 r = x[at(i)] - centre;
            if (may_be_near(*sim.barrier, i, r)) {
                f(i, x[at(i)], solids_near(*sim.barrier, tiles.lattice, tile, r));
            }
        }
    });
}

} // namespace

BedFriction make_bed_friction(const Simulation& sim)
{
    BedFriction bed;
    for (std::size_t w = 0; sim.fluid && w < sim.scene.walls.size(); ++w) {
        if (sim.scene.walls[w].manning > 0) {
            bed.walls.push_back(static_cast<int>(w));
        }
    }
    return bed;
}

void rub_on_beds(Simulation& sim, double dt)
{
    const Fluid& fluid = *sim.fluid;
    BedFriction& bed = sim.bed;
    lay_columns(fluid, bed);
    fill_columns(fluid, bed);
    for_rows_near(sim, [&](Index, const Vec3& x, std::span<const int> solids) {
        if (is_lowest(sim, x, solids)) {
            std::atomic_ref(bed.lowest[column_of(fluid, bed, x)])
                .fetch_add(1, std::memory_order_relaxed);
        }
    });
    if (fluid.ghosts) {
        add_other_columns(fluid, bed);
    }
    for_rows_near(sim, [&](Index i, const Vec3&, std::span<const int> solids) {
        rub_row(sim, i, solids, dt);
    });
}

} // namespace hyoryu
