// SPDX-License-Identifier: MIT
#include "hyoryu/ranks/halo.hpp"

#include "hyoryu/ranks/rows.hpp"

#include <algorithm>
#include <iterator>

namespace hyoryu {

namespace {

// The ranks, but for this one, that own a place beside a tile, each once.
std::vector<int> ranks_beside(const Cuts& cuts, const TileLattice& lattice, std::uint64_t tile,
                              int self)
{
    std::vector<int> ranks;
    lattice.for_beside(tile, [&](std::uint64_t number, const auto&) {
        const int owner = cuts.owner(number);
        if (owner != self && std::ranges::find(ranks, owner) == ranks.end()) {
            ranks.push_back(owner);
        }
    });
    return ranks;
}

// Tiles that go to a rank.
struct TileBatch {
    std::vector<std::uint64_t> tile;
    std::vector<std::int32_t> count; // points of each
    std::array<std::vector<float>, 3> x;

    void add(const Tiles& tiles, Index t)
    {
        const Index first = tiles.start[at(t)];
        const Index last = tiles.start[at(t + 1)];
        tile.push_back(tiles.tile[at(t)]);
        count.push_back(static_cast<std::int32_t>(last - first));
        const std::array columns{&tiles.x, &tiles.y, &tiles.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            x[axis].insert(x[axis].end(), columns[axis]->begin() + first,
                           columns[axis]->begin() + last);
        }
    }
    Parcel packed() const
    {
        Parcel parcel;
        if (tile.empty()) {
            return parcel;
        }
        put(parcel, tile.size());
        put(parcel, std::span(tile));
        put(parcel, std::span(count));
        for (const std::vector<float>& column : x) {
            put(parcel, std::span(column));
        }
        return parcel;
    }
};

// Appends the tiles of a parcel; returns how many points they have.
Index append_batch(Tiles& ghosts, const Parcel& parcel)
{
    if (parcel.empty()) {
        return 0;
    }
    Unpacking from(parcel);
    const auto tiles = from.take<std::size_t>();
    const std::size_t before = ghosts.tile.size();
    ghosts.tile.resize(before + tiles);
    from.take(std::span(ghosts.tile).subspan(before));
    std::vector<std::int32_t> count(tiles);
    from.take(std::span(count));
    const std::int32_t first = ghosts.start.back();
    for (const std::int32_t points : count) {
        ghosts.start.push_back(ghosts.start.back() + points);
    }
    for (std::vector<float>* column : {&ghosts.x, &ghosts.y, &ghosts.z}) {
        column->resize(at(ghosts.start.back()));
        from.take(std::span(*column).subspan(at(first)));
    }
    return ghosts.start.back() - first;
}

} // namespace

Halo share_tiles(Comm& comm, const Cuts& cuts, const Tiles& own, Tiles& ghosts)
{
    const auto ranks = at(comm.size());
    Halo halo;
    halo.out.resize(ranks);
    halo.tiles = {std::vector<std::vector<std::int32_t>>(ranks), {}};
    std::vector<TileBatch> batch(ranks);
    for (Index t = 0; t < own.tiles(); ++t) {
        for (const int rank : ranks_beside(cuts, own.lattice, own.tile[at(t)], comm.rank())) {
            batch[at(rank)].add(own, t);
            halo.tiles.out[at(rank)].push_back(static_cast<std::int32_t>(t));
            for (std::int32_t k = own.start[at(t)]; k < own.start[at(t + 1)]; ++k) {
                halo.out[at(rank)].push_back(k);
            }
        }
    }
    std::vector<Parcel> out;
    std::ranges::transform(batch, std::back_inserter(out), &TileBatch::packed);
    const std::vector<Parcel> in = comm.exchange(std::move(out));

    // Ranges of numbers ascend with the ranks, and so do the tiles.
    ghosts = {.lattice = own.lattice};
    for (const Parcel& parcel : in) {
        const Index first = ghosts.start.back();
        const Index first_tile = ghosts.tiles();
        halo.in.push_back({first, first + append_batch(ghosts, parcel)});
        halo.tiles.in.push_back(rows_from(first_tile, ghosts.tiles() - first_tile));
    }
    for (std::int32_t k = 0; k < ghosts.start.back(); ++k) {
        ghosts.row.push_back(k);
    }
    bound_chunks(ghosts);
    return halo;
}

Links all_links(const Halo& halo)
{
    Links links{halo.out, {}};
    for (const Rows& rows : halo.in) {
        links.in.push_back(rows_from(rows.begin, rows.size()));
    }
    return links;
}

std::vector<Links> needed_links(Comm& comm, std::span<const LookedAt> ghosts)
{
    const auto ranks = at(comm.size());
    std::vector<Links> links(ghosts.size());
    std::vector<Parcel> out(ranks);
    for (std::size_t k = 0; k < ghosts.size(); ++k) {
        links[k] = {std::vector<std::vector<std::int32_t>>(ranks),
                    std::vector<std::vector<std::int32_t>>(ranks)};
        for (std::size_t r = 0; r < ranks; ++r) {
            const Rows& rows = ghosts[k].halo->in[r];
            put(out[r], ghosts[k].marks.subspan(at(rows.begin), at(rows.size())));
            for (Index row = rows.begin; row < rows.end; ++row) {
                if (ghosts[k].marks[at(row)] != 0) {
                    links[k].in[r].push_back(static_cast<std::int32_t>(row));
                }
            }
        }
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    for (std::size_t r = 0; r < ranks; ++r) {
        Unpacking from(in[r]);
        for (std::size_t k = 0; k < ghosts.size(); ++k) {
            for (const std::int32_t point : ghosts[k].halo->out[r]) {
                if (from.take<std::uint8_t>() != 0) {
                    links[k].out[r].push_back(point);
                }
            }
        }
    }
    return links;
}

void share_owners(Comm& comm, const Halo& halo, const Tiles& tiles, const Store& own, Store& ghosts)
{
    std::vector<Parcel> out(halo.out.size());
    for (std::size_t r = 0; r < out.size(); ++r) {
        for (const std::int32_t point : halo.out[r]) {
            put(out[r], own.owner()[tiles.row[at(point)]]);
        }
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    for (std::size_t r = 0; r < in.size(); ++r) {
        const std::span<std::int32_t> owner = ghosts.owner();
        Unpacking(in[r]).take(owner.subspan(at(halo.in[r].begin), at(halo.in[r].size())));
    }
}

void return_marks(Comm& comm, const Halo& halo, std::vector<std::uint8_t>& marks, Index own_first,
                  Index ghost_first)
{
    std::vector<Parcel> out(halo.in.size());
    for (std::size_t r = 0; r < out.size(); ++r) {
        put(out[r], std::span<const std::uint8_t>(marks).subspan(at(ghost_first + halo.in[r].begin),
                                                                 at(halo.in[r].size())));
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    for (std::size_t r = 0; r < in.size(); ++r) {
        Unpacking from(in[r]);
        for (const std::int32_t point : halo.out[r]) {
            marks[at(own_first + point)] |= from.take<std::uint8_t>();
        }
    }
}

void share_marks(Comm& comm, const Halo& halo, std::span<const std::uint8_t> own,
                 std::span<std::uint8_t> ghosts)
{
    std::vector<Parcel> out(halo.out.size());
    for (std::size_t r = 0; r < out.size(); ++r) {
        for (const std::int32_t point : halo.out[r]) {
            put(out[r], own[at(point)]);
        }
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    for (std::size_t r = 0; r < in.size(); ++r) {
        Unpacking(in[r]).take(ghosts.subspan(at(halo.in[r].begin), at(halo.in[r].size())));
    }
}

void move_rows(Comm& comm, Store& store, std::span<const int> owner, std::span<std::byte> room)
{
    const auto ranks = at(comm.size());
    std::vector<std::int32_t> stay;
    std::vector<std::vector<std::int32_t>> leave(ranks);
    for (std::size_t row = 0; row < owner.size(); ++row) {
        auto& to = owner[row] == comm.rank() ? stay : leave[at(owner[row])];
        to.push_back(static_cast<std::int32_t>(row));
    }
    std::vector<Parcel> out(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
        if (!leave[r].empty()) {
            put(out[r], static_cast<Index>(leave[r].size()));
            put_rows(out[r], store, leave[r]);
        }
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    const auto count_of = [](const Parcel& parcel) {
        return parcel.empty() ? 0 : Unpacking(parcel).take<Index>();
    };
    auto first = static_cast<Index>(stay.size());
    for (const Parcel& parcel : in) {
        stay.insert(stay.end(), at(count_of(parcel)), -1);
    }
    if (stay.size() == owner.size() && first == static_cast<Index>(owner.size())) {
        return;
    }
    store.gather(stay, room);
    for (const Parcel& parcel : in) {
        if (!parcel.empty()) {
            Unpacking from(parcel);
            const auto count = from.take<Index>();
            take_rows(from, store, rows_from(first, count));
            first += count;
        }
    }
}

void Delivery::pack(const Comm& comm, std::vector<Parcel>& out, std::vector<Parcel>& in) const
{
    const auto ranks = at(comm.size());
    out.resize(ranks);
    in.resize(ranks);
    for (std::size_t r = 0; r < ranks; ++r) {
        std::size_t sent = 0;
        std::size_t received = 0;
        for (const Part& part : parts_) {
            sent += part.bytes * part.links->out[r].size();
            received += part.bytes * part.links->in[r].size();
        }
        out[r].resize(sent);
        in[r].resize(received);
        std::byte* next = out[r].data();
        for (const Part& part : parts_) {
            for (const std::int32_t value : part.links->out[r]) {
                const std::int32_t place = part.row == nullptr ? value : part.row[value];
                std::memcpy(next, part.from + part.bytes * at(place), part.bytes);
                next += part.bytes;
            }
        }
    }
}

void Delivery::unpack(const std::vector<Parcel>& in) const
{
    for (std::size_t r = 0; r < in.size(); ++r) {
        const std::byte* next = in[r].data();
        for (const Part& part : parts_) {
            for (const std::int32_t place : part.links->in[r]) {
                std::memcpy(part.to + part.bytes * at(place), next, part.bytes);
                next += part.bytes;
            }
        }
    }
}

} // namespace hyoryu
