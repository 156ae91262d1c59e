// SPDX-License-Identifier: MIT
// The pressure on a particle by runs of cells, against the sum over all pairs.
#include "scene/filling/packing_grid.hpp"

#include "dice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyoryu::test_packing_grid {
namespace {

// Clouds of fluid and of solids about some places, each as dense as a lattice. Lengths in spacings.
struct Cloud {
    int dimensions = 3;
    std::vector<Vec3> fluid, solids;
    std::vector<float> depth; // of the fluid
    std::vector<float> cubes; // of the solids
    Kernel kernel;
    double volume = 1;
};

Vec3 drawn_about(Dice& dice, const Vec3& middle, int dimensions)
{
    const Vec3 way{dice.between(-4, 4), dimensions == 2 ? 0 : dice.between(-4, 4),
                   dice.between(-4, 4)};
    return middle + way;
}

Cloud drawn(Dice& dice, int dimensions, double extent)
{
    Cloud cloud{.dimensions = dimensions};
    cloud.kernel = make_kernel(dice.between(1.1, 1.6), 1, dimensions);
    cloud.volume = dice.between(0.9, 1.1);
    for (int place = 0; place < 3; ++place) {
        const Vec3 middle{dice.between(-extent, extent),
                          dimensions == 2 ? 0 : dice.between(-extent, extent),
                          dice.between(-extent, extent)};
        for (int k = 0; k < (dimensions == 2 ? 60 : 400); ++k) {
            cloud.fluid.push_back(drawn_about(dice, middle, dimensions));
            cloud.depth.push_back(static_cast<float>(dice.between(-1, 30)));
            if (dice.chance(0.3)) {
                cloud.solids.push_back(drawn_about(dice, middle, dimensions));
                cloud.cubes.push_back(static_cast<float>(dice.between(0.5, 1.6)));
            }
        }
    }
    return cloud;
}

PackingUnits units_of(const Cloud& cloud)
{
    Vec3 low = cloud.fluid[0];
    Vec3 high = cloud.fluid[0];
    for (const Vec3& p : cloud.fluid) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return packing_units((low + high) / 2, 1, low - Vec3::Constant(9), high + Vec3::Constant(9));
}

std::vector<Vec3> forces_by_cells(const Cloud& cloud)
{
    const PackingUnits units = units_of(cloud);
    const double reach = cloud.kernel.support / units.size;
    const auto sorted = [&](const std::vector<Vec3>& points) {
        std::vector<UnitPlace> places;
        std::ranges::transform(points, std::back_inserter(places),
                               [&](const Vec3& p) { return units.whole(p); });
        return packing_grid(places, reach);
    };
    PackingGrid fluid = sorted(cloud.fluid);
    PackingGrid solids = sorted(cloud.solids);
    solids.cubes.assign(solids.x.size(), 0);
    for (std::size_t k = 0; k < cloud.solids.size(); ++k) {
        solids.cubes[k] = cloud.cubes[static_cast<std::size_t>(solids.order[k])];
    }
    fluid.depth.assign(fluid.x.size(), 0);
    for (std::size_t k = 0; k < cloud.fluid.size(); ++k) {
        fluid.depth[k] = cloud.depth[static_cast<std::size_t>(fluid.order[k])];
    }
    const PackingPressure pressure{.kernel = cloud.kernel,
                                   .unit = units.size,
                                   .reach = reach,
                                   .volume = cloud.volume,
                                   .deepest = 31};
    std::vector<Vec3> forces;
    for (std::size_t k = 0; k < cloud.fluid.size(); ++k) {
        forces.push_back(
            pressure_sum(fluid, &solids, pressure, units.whole(cloud.fluid[k]), cloud.depth[k]));
    }
    return forces;
}

// By the formula of the kernel (Wendland C2), over all. Places are those that the units can hold,
// since rounding changes the direction between particles that nearly coincide.
Vec3 force_by_pairs(const Cloud& cloud, std::size_t i)
{
    const PackingUnits units = units_of(cloud);
    const Vec3 own_place = units.rounded(cloud.fluid[i]);
    Vec3 force = Vec3::Zero();
    const double own = std::max<double>(cloud.depth[i], 0);
    const auto add = [&](double volume, const Vec3& r, double its) {
        const double q = r.norm() / cloud.kernel.h;
        const double repulsion = std::max(1.0, 0.6 / std::max(r.norm(), 1e-3));
        const double f = q < 2 ? repulsion * cloud.kernel.f_scale * std::pow(1 - q / 2, 3) : 0;
        force += volume * (own + std::max(its, 0.0)) * f * r;
    };
    for (std::size_t j = 0; j < cloud.fluid.size(); ++j) {
        add(cloud.volume, own_place - units.rounded(cloud.fluid[j]), cloud.depth[j]);
    }
    for (std::size_t j = 0; j < cloud.solids.size(); ++j) {
        const Vec3 r = own_place - units.rounded(cloud.solids[j]);
        add(cloud.cubes[j], r, cloud.depth[i] + r.z());
    }
    return force;
}

// The forces of some 200 pairs of a weight of up to 60, in single precision.
TEST(PackingGrid, PressureIsThatOfAllPairs)
{
    Dice dice(61);
    for (int n = 0; n < 12; ++n) {
        const double extent = n % 3 == 0 ? 3 : (n % 3 == 1 ? 200 : 10000);
        const Cloud cloud = drawn(dice, n % 2 == 0 ? 2 : 3, extent);
        const std::vector<Vec3> forces = forces_by_cells(cloud);
        double strongest = 0;
        for (std::size_t i = 0; i < cloud.fluid.size(); ++i) {
            const Vec3 all = force_by_pairs(cloud, i);
            strongest = std::max(strongest, all.norm());
            EXPECT_LT((forces[i] - all).norm(), extent > 1000 ? 2e-3 : 2e-4)
                << "case " << n << ", particle " << i << " at " << cloud.fluid[i].transpose();
        }
        EXPECT_GT(strongest, 5);
    }
}

// Mirrored and in any order: what a run does must not depend on the numbers of its particles.
TEST(PackingGrid, NeitherTheOrderNorAMirrorChangesABit)
{
    Dice dice(62);
    for (int n = 0; n < 8; ++n) {
        const Cloud cloud = drawn(dice, n % 2 == 0 ? 2 : 3, 20);
        const std::vector<Vec3> forces = forces_by_cells(cloud);
        Cloud turned = cloud;
        std::ranges::reverse(turned.fluid);
        std::ranges::reverse(turned.depth);
        std::ranges::reverse(turned.solids);
        std::ranges::reverse(turned.cubes);
        for (auto* points : {&turned.fluid, &turned.solids}) {
            for (Vec3& p : *points) {
                p.x() = -p.x();
            }
        }
        std::vector<Vec3> of_turned = forces_by_cells(turned);
        std::ranges::reverse(of_turned);
        for (std::size_t i = 0; i < forces.size(); ++i) {
            const Vec3 back(-of_turned[i].x(), of_turned[i].y(), of_turned[i].z());
            ASSERT_EQ(forces[i], back) << "case " << n << ", particle " << i;
        }
    }
}

// Water in two ponds far apart, as in a town: no more cells than a few for each particle.
TEST(PackingGrid, EmptySpaceBetweenParticlesTakesNoMemory)
{
    Dice dice(63);
    for (const double apart : {1e3, 1e4, 1e5}) {
        std::vector<UnitPlace> places;
        const PackingUnits units =
            packing_units(Vec3::Zero(), 1, Vec3::Constant(-apart), Vec3::Constant(apart));
        for (int k = 0; k < 200000; ++k) {
            const Vec3 middle = Vec3::Constant(k % 2 == 0 ? -apart : apart);
            places.push_back(units.whole(drawn_about(dice, middle, 3)));
        }
        const PackingGrid grid = packing_grid(places, 2.75 / units.size);
        EXPECT_LE(grid.start.size(), 3 * places.size());
        EXPECT_TRUE(any_within(grid, places[7], 1 / units.size));
    }
}

} // namespace
} // namespace hyoryu::test_packing_grid
