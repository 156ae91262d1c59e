// SPDX-License-Identifier: MIT
// Ghosts: copies on a rank of the particles of other ranks in the tiles that touch its range. Tiles
// are sent whole and in their order, so that every rank sees a tile as its owner does, and lists
// and sums equal those of one process bit for bit.
#pragma once

#include "hyoryu/ranks/comm.hpp"
#include "hyoryu/ranks/cuts.hpp"

#include "hyoryu/core/particles.hpp"

#include <optional>

namespace hyoryu {

/// Which values are exchanged. `out[r]`: indices of the own values that go to rank r; `in[r]`:
/// indices at which the values from rank r are stored, in the order in which that rank sends them.
struct Links {
    std::vector<std::vector<std::int32_t>> out, in;
};

/// The copies of one kind of particles, by rank; valid until the tiles are made anew.
struct Halo {
    std::vector<std::vector<std::int32_t>>
        out;              // by rank: points of own tiles of which it has copies
    std::vector<Rows> in; // by rank: its points among the ghosts
    Links tiles;          // indices of the tiles of these points

    Index count() const { return in.empty() ? 0 : in.back().end; }
};

/// All points of a halo.
Links all_links(const Halo& halo);

/// Ghosts of one kind, and by ghost whether a neighbour list of this rank reads it.
struct LookedAt {
    const Halo* halo;
    std::span<const std::uint8_t> marks;
};
/// The links of each halo, restricted to the ghosts that neighbour lists read. Collective: all
/// ranks call it with the same number of halos.
std::vector<Links> needed_links(Comm& comm, std::span<const LookedAt> ghosts);

/// Sends own tiles to the ranks that own a place beside them, and makes the tiles of the ghosts, of
/// which point k has row k.
Halo share_tiles(Comm& comm, const Cuts& cuts, const Tiles& own, Tiles& ghosts);

/// Gives solid ghosts the owners of their particles, bodies and walls.
void share_owners(Comm& comm, const Halo& halo, const Tiles& tiles, const Store& own,
                  Store& ghosts);

/// Sends marks of ghosts to the ranks that own them; a point that any rank marks is marked.
/// `own_first`, `ghost_first`: the mark of the first own point and of the first ghost.
void return_marks(Comm& comm, const Halo& halo, std::vector<std::uint8_t>& marks, Index own_first,
                  Index ghost_first);
/// Sets the marks of ghosts to those that their owners have.
void share_marks(Comm& comm, const Halo& halo, std::span<const std::uint8_t> own,
                 std::span<std::uint8_t> ghosts);

/// Moves each row to the rank that `owner` names for it, with all columns and its number. Rows that
/// arrive come behind those that stay. `room` as in Store::gather.
void move_rows(Comm& comm, Store& store, std::span<const int> owner, std::span<std::byte> room);

/// Values of fields on their way from own particles to the ghosts of others: added field by field,
/// sent in one message for each pair of ranks.
class Delivery {
public:
    /// A field of a store of own particles, and of that of the ghosts of the same kind.
    template <Field F>
    void add(const Links& links, const Tiles& tiles, const Store& own, Store& ghosts, F of)
    {
        using T = typename F::type;
        const auto* const from = own[of].data();
        auto* const to = ghosts[of].data();
        parts_.push_back({&links, tiles.row.data(), reinterpret_cast<const std::byte*>(from),
                          reinterpret_cast<std::byte*>(to), sizeof(T)});
    }
    /// Values by tile.
    template <class T>
    void add(const Links& links, const std::vector<T>& own, std::vector<T>& ghosts)
    {
        parts_.push_back({&links, nullptr, reinterpret_cast<const std::byte*>(own.data()),
                          reinterpret_cast<std::byte*>(ghosts.data()), sizeof(T)});
    }
    /// Packs the values, and makes room for those that come. The parcels are memory that may serve
    /// again.
    void pack(const Comm& comm, std::vector<Parcel>& out, std::vector<Parcel>& in) const;
    /// Stores the received values.
    void unpack(const std::vector<Parcel>& in) const;
    /// Sends and receives.
    void send(Comm& comm, std::vector<Parcel>& out, std::vector<Parcel>& in) const
    {
        pack(comm, out, in);
        comm.exchange(out, in);
        unpack(in);
    }

private:
    struct Part {
        const Links* links;
        const std::int32_t* row; // of each own point; null: the values are in their order
        const std::byte* from;
        std::byte* to;
        std::size_t bytes; // of a value
    };
    std::vector<Part> parts_;
};

/// A delivery that is sent while the rank computes.
class Underway {
public:
    void begin(Comm& comm, Delivery delivery)
    {
        delivery_ = std::move(delivery);
        delivery_->pack(comm, out_, in_);
        comm.begin(out_, in_);
    }
    /// Waits for the values and stores them. Returns false if nothing was begun.
    bool arrive(Comm& comm)
    {
        if (!delivery_) {
            return false;
        }
        comm.finish();
        delivery_->unpack(in_);
        delivery_.reset();
        return true;
    }

private:
    std::optional<Delivery> delivery_;
    std::vector<Parcel> out_, in_;
};

} // namespace hyoryu
