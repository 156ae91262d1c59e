// SPDX-License-Identifier: MIT
#include "fill_region.hpp"

#include "hyoryu/ranks/reduction.hpp"

namespace hyoryu {

FillPart part_of(Index number, const Comm* comm)
{
    if (comm == nullptr) {
        return {0, number};
    }
    // In two steps, so that the product has room.
    const Index ranks = comm->size();
    const auto before = [&](Index rank) {
        return number / ranks * rank + number % ranks * rank / ranks;
    };
    return {before(comm->rank()), before(comm->rank() + 1)};
}

FillRegion::FillRegion(Comm& comm, const TileLattice& lattice, const TileWeights& weights)
    : comm_(comm), lattice_(lattice), cuts_(cut_evenly(comm, weights))
{
}

std::vector<int> FillRegion::others_about(const Vec3& place, double reach) const
{
    const auto low = TileLattice::place_of(lattice_.tile_of(place - Vec3::Constant(reach)));
    const auto high = TileLattice::place_of(lattice_.tile_of(place + Vec3::Constant(reach)));
    std::vector<int> found;
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
        for (std::int64_t y = low[1]; y <= high[1]; ++y) {
            for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                const int rank = cuts_.owner(TileLattice::tile_at({x, y, z}));
                if (rank != comm_.rank() && std::ranges::find(found, rank) == found.end()) {
                    found.push_back(rank);
                }
            }
        }
    }
    return found;
}

Bounds bounds_of_all(Comm* comm, std::span<const Vec3> points)
{
    Bounds box;
    for (const Vec3& p : points) {
        box.add(p);
    }
    box.min = -box.min;
    Reduction largest(comm);
    largest.largest({box.min.data(), 3});
    largest.largest({box.max.data(), 3});
    largest.run();
    box.min = -box.min;
    return box;
}

TileLattice fill_lattice(const Scene& scene, const Bounds& domain)
{
    constexpr double edge = 8; // spacings
    return make_lattice(domain.min, edge * scene.spacing);
}

FillHalo::FillHalo(const FillRegion& region, std::span<const Vec3> places, double reach)
    : region_(region), sent_(at(region.comm().size()))
{
    for (std::size_t k = 0; k < places.size(); ++k) {
        for (const int rank : region.others_about(places[k], reach)) {
            sent_[at(rank)].push_back(static_cast<std::int32_t>(k));
        }
    }
}

void FillHalo::keep(std::span<const std::uint8_t> marked)
{
    std::vector<std::int32_t> number; // among the marked ones before
    std::int32_t before = 0;
    for (const std::uint8_t mark : marked) {
        number.push_back(before);
        before += mark != 0 ? 1 : 0;
    }
    for (std::vector<std::int32_t>& rows : sent_) {
        std::erase_if(rows, [&](std::int32_t row) { return marked[at(row)] == 0; });
        for (std::int32_t& row : rows) {
            row = number[at(row)];
        }
    }
}

} // namespace hyoryu
