// SPDX-License-Identifier: MIT
// Domain decomposition of a case while several processes fill it. Each process computes a range of
// the cells of the fluid and of the places in the layers of walls, and sends the particles that it
// finds to the process that owns the place. A process owns a range of the tiles of a lattice that
// is used for filling alone.
#pragma once

#include "hyoryu/core/tiles.hpp"
#include "hyoryu/ranks/comm.hpp"
#include "hyoryu/ranks/cuts.hpp"
#include "hyoryu/scene/filling_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace hyoryu {

/// A range [first, last) of items.
struct FillPart {
    Index first = 0, last = 0;
};
/// The range of `number` items that this process works on: equal ranges, in the order of the ranks.
/// All items if `comm` is null.
FillPart part_of(Index number, const Comm* comm);

/// The sum of a number over all processes; the number itself if `comm` is null.
inline Index sum_of_all(Comm* comm, Index number)
{
    std::int64_t sum = number;
    if (comm != nullptr) {
        comm->add({&sum, 1});
    }
    return sum;
}

/// The regions of all processes.
class FillRegion {
public:
    /// Cuts the tiles into ranges of about equal weight. `weights`: of the particles that this
    /// process has computed. Called by all processes.
    FillRegion(Comm& comm, const TileLattice& lattice, const TileWeights& weights);

    Comm& comm() const { return comm_; }
    const TileLattice& lattice() const { return lattice_; }
    int owner(const Vec3& place) const { return cuts_.owner(lattice_.tile_of(place)); }
    bool owns(const Vec3& place) const { return owner(place) == comm_.rank(); }
    /// The other processes that own a place in the cube of half the edge `reach` [m] about one.
    std::vector<int> others_about(const Vec3& place, double reach) const;

private:
    Comm& comm_;
    TileLattice lattice_;
    Cuts cuts_;
};

/// The bounds of the points of all processes; of the points alone if `comm` is null.
Bounds bounds_of_all(Comm* comm, std::span<const Vec3> points);

/// The lattice of the regions of a scene.
TileLattice fill_lattice(const Scene& scene, const Bounds& domain);

/// The exchange of values of particles with the processes in whose neighbourhood they are.
class FillHalo {
public:
    /// `places`: positions of the particles of this process [m]. A particle is copied to each
    /// process that owns a place within `reach` [m] along each axis.
    FillHalo(const FillRegion& region, std::span<const Vec3> places, double reach);

    /// Sends a value of each particle of this process to the processes that have copies of it, and
    /// returns the values of the copies here, in the same order at each call.
    template <class T>
    std::vector<T> fetch(std::span<const T> own) const
    {
        std::vector<Parcel> out(sent_.size());
        for (std::size_t rank = 0; rank < sent_.size(); ++rank) {
            std::vector<T> some;
            for (const std::int32_t row : sent_[rank]) {
                some.push_back(own[at(row)]);
            }
            put(out[rank], std::span<const T>(some));
        }
        std::vector<T> copies;
        for (const Parcel& parcel : region_.comm().exchange(std::move(out))) {
            const std::size_t before = copies.size();
            copies.resize(before + parcel.size() / sizeof(T));
            Unpacking(parcel).take(std::span(copies).subspan(before));
        }
        return copies;
    }
    /// Restricts the exchange to the marked particles. From then on `fetch` takes their values
    /// alone.
    void keep(std::span<const std::uint8_t> marked);

private:
    const FillRegion& region_;
    std::vector<std::vector<std::int32_t>> sent_; // rows, by rank
};

} // namespace hyoryu
