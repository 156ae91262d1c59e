// SPDX-License-Identifier: MIT
// Which process keeps which particles while processes that share a case fill it. Each makes a range
// of the cells and of the places in the layers of walls, and sends what it finds there to the owner
// of the place. A process owns a range of the tiles of a lattice that is used for this alone.
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

/// The part [first, last) of so many things that a process makes: all without others.
struct FillPart {
    Index first = 0, last = 0;
};
FillPart part_of(Index number, const Comm* comm);

/// A number of each process, summed.
inline Index sum_of_all(Comm* comm, Index number)
{
    std::int64_t sum = number;
    if (comm != nullptr) {
        comm->add({&sum, 1});
    }
    return sum;
}

class FillRegion {
public:
    /// Cut into parts of about equal weight: `weights` of what this process has made. Called by
    /// all.
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

/// The bounds of points of all processes. Null for one.
Bounds bounds_of_all(Comm* comm, std::span<const Vec3> points);

/// The lattice of the regions of a scene.
TileLattice fill_lattice(const Scene& scene, const Bounds& domain);

/// Copies of the particles of others that are near the tiles of a process.
class FillHalo {
public:
    /// `places`: of the own particles; copies go to all that own a place within `reach` [m].
    FillHalo(const FillRegion& region, std::span<const Vec3> places, double reach);

    /// Values of the own particles to those of the copies, in the same order each time.
    template <class T>
    std::vector<T> fetch(std::span<const T> own) const
    {
        std::vector<Parcel> out(sent_.size());
        for (std::size_t rank = 0; rank < sent_.size(); ++rank) {
            std::vector<T> some;
            for (const std::int32_t row : sent_[rank]) {
                some.push_back(own[static_cast<std::size_t>(row)]);
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
    /// From now on only those of the own particles that are marked, by their numbers among these.
    void keep(std::span<const std::uint8_t> marked);

private:
    const FillRegion& region_;
    std::vector<std::vector<std::int32_t>> sent_; // rows, by rank
};

} // namespace hyoryu
