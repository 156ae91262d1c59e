// SPDX-License-Identifier: MIT
#include "hyoryu/sim/state_parts.hpp"

#include "hyoryu/ranks/columns.hpp"
#include "hyoryu/sim/checkpoint.hpp"

#include "particle_arrays.hpp"
#include "tiles_state.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace hyoryu {

namespace {

// Where the fluid of a range of tiles is in a part: in the order of the tiles.
struct FluidShare {
    std::size_t first = 0, last = 0; // of its tiles
    std::span<const std::int32_t> row;
};

FluidShare fluid_share(const Tiles& tiles, const TileRange& range)
{
    const auto place = [&](std::uint64_t tile) {
        return at(std::ranges::lower_bound(tiles.tile, tile) - tiles.tile.begin());
    };
    const std::size_t first = place(range.begin);
    const std::size_t last = std::max(first, place(range.end));
    const auto begin = at(tiles.start[first]);
    return {first, last, std::span(tiles.row).subspan(begin, at(tiles.start[last]) - begin)};
}

// The tiles of a share, whose rows are numbered anew.
Tiles tiles_of(const Tiles& all, const FluidShare& share)
{
    Tiles own;
    const auto first = static_cast<std::ptrdiff_t>(share.first);
    const auto last = static_cast<std::ptrdiff_t>(share.last);
    const std::int32_t begin = all.start[share.first];
    const std::int32_t end = all.start[share.last];
    own.tile.assign(all.tile.begin() + first, all.tile.begin() + last);
    own.start.clear();
    for (std::size_t t = share.first; t <= share.last; ++t) {
        own.start.push_back(all.start[t] - begin);
    }
    own.row.resize(share.row.size());
    std::iota(own.row.begin(), own.row.end(), 0);
    for (const auto column : {&Tiles::x, &Tiles::y, &Tiles::z}) {
        (own.*column).assign((all.*column).begin() + begin, (all.*column).begin() + end);
    }
    return own;
}

// A part as it is dealt out: each rank gets the fluid of its tiles, and walls and bodies as they
// are.
class PartDeck {
public:
    PartDeck(const Simulation& sim, Snapshot particles)
        : particles_(std::move(particles)), columns_(fluid_columns(sim))
    {
        StateReader reader(particles_);
        describe_tiles(reader, tiles_, tiles_of_fluid);
        check();
    }

    const Tiles& tiles() const { return tiles_; }

    Snapshot share_of(const TileRange& range) const
    {
        const FluidShare share = fluid_share(tiles_, range);
        Snapshot own;
        StateWriter writer(own);
        const Tiles tiles = tiles_of(tiles_, share);
        describe_tiles(writer, tiles, tiles_of_fluid);
        for (const auto& [name, column] : particles_.arrays) {
            if (columns_.contains(name)) {
                own.arrays[name] = some_rows(column, share.row);
            } else if (!own.arrays.contains(name)) {
                own.arrays[name] = column;
            }
        }
        return own;
    }

private:
    // Rows of columns are dealt out by index, and all of them are.
    void check() const
    {
        check_tiles(tiles_, {0, tiles_.count()});
        for (const std::string& name : columns_) {
            const auto found = particles_.arrays.find(name);
            if (found == particles_.arrays.end()) {
                throw IoError(
                    fmt::format("the checkpoint has no `{}`: it belongs to another case", name));
            }
            if (rows_of(found->second) != tiles_.row.size()) {
                refuse_rows(name);
            }
        }
    }

    Snapshot particles_;
    std::set<std::string> columns_;
    Tiles tiles_;
};

// Calls f(part) for the parts that this rank reads. In a last round in which only some ranks have a
// part, the others call f(none).
void for_own_parts(const Comm& comm, int count, const auto& f)
{
    for (int first = 0; first < count; first += comm.size()) {
        const int part = first + comm.rank();
        f(part < count ? std::optional(part) : std::nullopt);
    }
}

// Cuts by which the ranks have about as many particles each.
Cuts cuts_of(const Simulation& sim, Comm& comm, const StateParts& state)
{
    TileWeights own;
    std::int64_t particles = 0;
    for_own_parts(comm, state.count, [&](std::optional<int> part) {
        if (part) {
            const Tiles tiles = PartDeck(sim, state.particles(*part)).tiles();
            for (std::size_t t = 0; t < tiles.tile.size(); ++t) {
                own[tiles.tile[t]] += tiles.start[t + 1] - tiles.start[t];
            }
            particles += tiles.start.back();
        }
    });
    comm.add({&particles, 1});
    expect_particles_of_case(sim, particles);
    return cut_evenly(comm, own);
}

// The particles that this rank gets of all parts. Messages go to one rank after the other, so that
// none holds those to all of them.
Snapshot deal_particles(const Simulation& sim, Comm& comm, const StateParts& state,
                        const Cuts& cuts)
{
    std::map<int, Snapshot> in_order; // of the parts
    const int size = comm.size();
    int round = 0;
    for_own_parts(comm, state.count, [&](std::optional<int> part) {
        std::optional<PartDeck> deck;
        if (part) {
            deck.emplace(sim, state.particles(*part));
            in_order[*part] = deck->share_of(cuts.range(comm.rank()));
        }
        for (int step = 1; step < size; ++step) {
            std::vector<Parcel> out(at(size));
            const int to = (comm.rank() + step) % size;
            if (deck) {
                put_arrays(out[at(to)], deck->share_of(cuts.range(to)));
            }
            const std::vector<Parcel> in = comm.exchange(std::move(out));
            const int from = (comm.rank() - step + size) % size;
            if (const int sent = round * size + from; sent < state.count) {
                Unpacking parcel(in[at(from)]);
                in_order[sent] = take_arrays(parcel);
            }
        }
        ++round;
    });
    Snapshot all;
    while (!in_order.empty()) {
        append_particles(sim, all, std::move(in_order.extract(in_order.begin()).mapped()));
    }
    return all;
}

Snapshot common_of_root(Comm& comm, const Snapshot& common)
{
    std::vector<Parcel> out(at(comm.size()));
    if (comm.rank() == 0) {
        put_arrays(out.front(), common);
        std::fill(out.begin() + 1, out.end(), out.front());
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    Unpacking from(in.front());
    return take_arrays(from);
}

} // namespace

Snapshot gather_particles(const Simulation& sim, Comm& comm, const Groups& groups, Snapshot own)
{
    if (groups.count == groups.ranks) {
        return own;
    }
    Snapshot all;
    const auto pack = [&] {
        Parcel parcel;
        put_arrays(parcel, std::exchange(own, {}));
        return parcel;
    };
    gather_in_groups(comm, groups, pack,
                     [&](Unpacking from) { append_particles(sim, all, take_arrays(from)); });
    return all;
}

Snapshot save_whole(const Simulation& sim, Comm& comm)
{
    Snapshot state = save(sim);
    if (sim.fluid) {
        put_particles(state, gather_particles(sim, comm, group_ranks(comm.size(), 1),
                                              take_particles(sim, state)));
    }
    return comm.rank() == 0 ? state : Snapshot{};
}

std::function<Snapshot(int)> given_twice(Snapshot part)
{
    return [part = std::move(part), times = 0](int) mutable {
        return ++times == 1 ? part : std::move(part);
    };
}

StateParts one_part(const Simulation& sim, Snapshot state)
{
    StateParts parts;
    if (sim.fluid) {
        parts.count = 1;
        parts.particles = given_twice(take_particles(sim, state));
    }
    parts.common = std::move(state);
    return parts;
}

void restore(Simulation& sim, Comm* comm, const StateParts& state)
{
    if (comm == nullptr) {
        Snapshot whole = state.common;
        Snapshot particles;
        for (int part = 0; part < state.count; ++part) {
            append_particles(sim, particles, state.particles(part));
        }
        put_particles(whole, std::move(particles));
        restore(sim, whole);
        return;
    }
    Snapshot own = common_of_root(*comm, state.common);
    if (sim.fluid) {
        const Cuts cuts = cuts_of(sim, *comm, state);
        put_particles(own, deal_particles(sim, *comm, state, cuts));
        share(*sim.fluid, *comm, cuts);
    }
    restore_share(sim, own);
}

} // namespace hyoryu
