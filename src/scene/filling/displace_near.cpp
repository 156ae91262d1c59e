// SPDX-License-Identifier: MIT
#include "displace_near.hpp"

#include "displace.hpp"
#include "stand_off.hpp"

#include <algorithm>
#include <iterator>
#include <set>

namespace hyoryu {

namespace {

// Distance from the bounds of a body within which displacement looks at fluid [spacings]: cut cells
// lie within 1, particles marked near these within 4 more; particles that are moved off the body
// within 2.95, and those that they interact with within 1 more.
constexpr double margin = 6;

// The tiles that bodies reach.
std::set<std::uint64_t> tiles_about(const Scene& scene, const TileLattice& lattice)
{
    std::set<std::uint64_t> tiles;
    for (const BodySettings& body : scene.bodies) {
        const Bounds box = bounds(placed(body, scene.dimensions));
        const Vec3 reach = Vec3::Constant(margin * scene.spacing);
        const auto low = TileLattice::place_of(lattice.tile_of(box.min - reach));
        const auto high = TileLattice::place_of(lattice.tile_of(box.max + reach));
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
            for (std::int64_t y = low[1]; y <= high[1]; ++y) {
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    tiles.insert(TileLattice::tile_at({x, y, z}));
                }
            }
        }
    }
    return tiles;
}

struct Split {
    std::vector<std::size_t> far, near; // rows
};

Split split(const Scene& scene, const TileLattice& lattice, const Filling& filling)
{
    const std::set<std::uint64_t> tiles = tiles_about(scene, lattice);
    Split rows;
    for (std::size_t k = 0; k < filling.fluid.size(); ++k) {
        const bool is_near = tiles.contains(lattice.tile_of(filling.fluid[k]));
        (is_near ? rows.near : rows.far).push_back(k);
    }
    return rows;
}

// Closes the gaps that removed particles leave in the numbers.
void renumber(const std::vector<std::int64_t>& gone, std::vector<std::int64_t>& numbers)
{
    for (std::int64_t& number : numbers) {
        number -= std::ranges::lower_bound(gone, number) - gone.begin();
    }
}

std::vector<std::size_t> owned(const FillRegion& region, std::span<const Vec3> places)
{
    std::vector<std::size_t> rows;
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (region.owns(places[k])) {
            rows.push_back(k);
        }
    }
    return rows;
}

void displace_of_several(const Scene& scene, const FillRegion& region, Filling& filling)
{
    Comm& comm = region.comm();
    const auto ranks = at(comm.size());
    const Split rows = split(scene, region.lattice(), filling);
    Filling near = exchange_fluid(
        comm, filling, std::vector<std::vector<std::size_t>>(ranks, rows.near)); // equal on all
    near.fluid_elsewhere = filling.fluid_count() - static_cast<Index>(near.fluid.size());
    near.fluid_volume = filling.fluid_volume;
    const Bounds elsewhere = bounds_of_all(&comm, fluid_of(filling, rows.far).fluid);
    const std::vector<std::int64_t> before = near.fluid_number;
    take_out_bodies(scene, elsewhere, near);
    stand_off_bodies(scene, near);
    std::vector<std::int64_t> gone;
    std::ranges::set_difference(before, near.fluid_number, std::back_inserter(gone));
    const Index count = near.fluid_count();
    Filling own = fluid_of(filling, rows.far);
    join_fluid(fluid_of(near, owned(region, near.fluid)), own);
    renumber(gone, own.fluid_number);
    swap_fluid(own, filling);
    filling.fluid_volume = near.fluid_volume;
    filling.fluid_elsewhere = count - static_cast<Index>(filling.fluid.size());
}

} // namespace

void displace_by_bodies(const Scene& scene, const FillRegion* region, Filling& filling)
{
    if (region != nullptr) {
        displace_of_several(scene, *region, filling);
        return;
    }
    take_out_bodies(scene, {}, filling);
    stand_off_bodies(scene, filling);
}

} // namespace hyoryu
