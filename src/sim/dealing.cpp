// SPDX-License-Identifier: MIT
#include "hyoryu/sim/dealing.hpp"

#include "hyoryu/sim/checkpoint.hpp"

#include "tiles_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

namespace hyoryu {

namespace {

std::size_t at(Index k)
{
    return static_cast<std::size_t>(k);
}

// The datasets with a value for each fluid particle.
std::set<std::string> fluid_columns(const Store& fluid)
{
    std::set<std::string> names{"fluid/id"};
    fluid.for_each_column([&](const FieldInfo& column, const auto&) {
        if (column.state) {
            names.insert(fmt::format("fluid/{}", column.name));
        }
    });
    return names;
}

// Where the fluid of a rank is in a state: in the order of the tiles.
struct FluidShare {
    std::size_t first = 0, last = 0; // of its tiles
    std::span<const std::int32_t> row;
};

FluidShare fluid_share(const Tiles& tiles, const TileRange& own)
{
    const auto place = [&](std::uint64_t tile) {
        return static_cast<std::size_t>(std::ranges::lower_bound(tiles.tile, tile) -
                                        tiles.tile.begin());
    };
    const std::size_t first = place(own.begin);
    const std::size_t last = std::max(first, place(own.end));
    const auto begin = at(tiles.start[first]);
    return {first, last, std::span(tiles.row).subspan(begin, at(tiles.start[last]) - begin)};
}

Column some_rows(const Column& column, std::span<const std::int32_t> rows)
{
    Column some{column.name, column.unit, column.components, {}};
    const auto n = at(column.components);
    std::visit(
        [&]<class T>(const std::vector<T>& values) {
            std::vector<T> of_rows;
            of_rows.reserve(rows.size() * n);
            for (const std::int32_t row : rows) {
                const auto first = values.begin() + static_cast<std::ptrdiff_t>(at(row) * n);
                of_rows.insert(of_rows.end(), first, first + column.components);
            }
            some.values = std::move(of_rows);
        },
        column.values);
    return some;
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

void put_column(Parcel& parcel, const std::string& name, const Column& column)
{
    put_text(parcel, name);
    put_text(parcel, column.unit);
    put(parcel, column.components);
    put(parcel, column.values.index());
    std::visit([&](const auto& values) { put_list(parcel, values); }, column.values);
}

template <std::size_t index = 0>
void take_values(Unpacking& from, std::size_t which, Column& column)
{
    if constexpr (index < std::variant_size_v<decltype(column.values)>) {
        if (which != index) {
            return take_values<index + 1>(from, which, column);
        }
        using Values = std::variant_alternative_t<index, decltype(column.values)>;
        column.values = take_list<typename Values::value_type>(from);
    }
}

Column take_column(Unpacking& from)
{
    Column column{take_text(from), take_text(from), from.take<int>(), {}};
    take_values(from, from.take<std::size_t>(), column);
    return column;
}

// A state as rank 0 deals it out: each rank gets its fluid, and all else as it is.
class StateDeck {
public:
    StateDeck(const Simulation& sim, const Snapshot& state, int ranks) : state_(&state)
    {
        expect_particles_of_case(sim, state);
        if (!sim.fluid) {
            return;
        }
        StateReader reader(state);
        describe_tiles(reader, tiles_, "fluid/tiles");
        columns_ = fluid_columns(sim.fluid->particles.fluid);
        check_columns();
        std::vector<double> weights;
        for (Index t = 0; t < tiles_.tiles(); ++t) {
            weights.push_back(tiles_.start[at(t + 1)] - tiles_.start[at(t)]);
        }
        cuts_ = cut_evenly(tiles_.tile, weights, ranks);
    }

    Parcel parcel_of(int rank) const
    {
        Parcel parcel;
        put_list(parcel, cuts_.first);
        const Snapshot own = columns_.empty() ? Snapshot{} : fluid_of(rank);
        put(parcel, state_->arrays.size());
        for (const auto& [name, column] : state_->arrays) {
            const auto found = own.arrays.find(name);
            put_column(parcel, name, found == own.arrays.end() ? column : found->second);
        }
        return parcel;
    }

private:
    Snapshot fluid_of(int rank) const
    {
        const FluidShare share = fluid_share(tiles_, cuts_.range(rank));
        Snapshot own;
        StateWriter writer(own);
        const Tiles tiles = tiles_of(tiles_, share);
        describe_tiles(writer, tiles, "fluid/tiles");
        for (const std::string& name : columns_) {
            own.arrays[name] = some_rows(state_->arrays.at(name), share.row);
        }
        return own;
    }
    // Rows of columns are dealt out by index, and all of them are.
    void check_columns() const
    {
        check_tiles(tiles_, {0, tiles_.count()});
        for (const std::string& name : columns_) {
            const auto found = state_->arrays.find(name);
            if (found == state_->arrays.end()) {
                throw IoError(
                    fmt::format("the checkpoint has no `{}`: it belongs to another case", name));
            }
            const Column& column = found->second;
            const std::size_t values =
                std::visit([](const auto& v) { return v.size(); }, column.values);
            if (values != tiles_.row.size() * at(column.components)) {
                throw IoError(
                    fmt::format("`{}` of the checkpoint does not fit its tiles: it is damaged or "
                                "belongs to another case",
                                name));
            }
        }
    }

    const Snapshot* state_;
    Tiles tiles_;
    std::set<std::string> columns_;
    Cuts cuts_;
};

} // namespace

void deal_plan(Comm& comm, const Scene& scene, const Filling& filling, Plan& plan)
{
    std::vector<Parcel> out(at(comm.size()));
    if (comm.rank() == 0) {
        const PlanFacts facts = facts_of(scene, filling);
        Parcel parcel;
        put(parcel, facts.fluid);
        put(parcel, facts.wall);
        put(parcel, facts.particle_volume);
        put(parcel, facts.expected_speed);
        put_list(parcel, facts.body_points);
        put_list(parcel, facts.surface_points);
        std::ranges::fill(out, parcel);
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    if (comm.rank() > 0) {
        Unpacking from(in.front());
        PlanFacts facts;
        facts.fluid = from.take<Index>();
        facts.wall = from.take<Index>();
        facts.particle_volume = from.take<double>();
        facts.expected_speed = from.take<double>();
        facts.body_points = take_list<Index>(from);
        facts.surface_points = take_list<Index>(from);
        plan = plan_of(scene, facts);
    }
}

void restore(Simulation& sim, Comm* comm, const Snapshot* state)
{
    if (comm == nullptr) {
        restore(sim, *state);
        return;
    }
    std::optional<StateDeck> deck;
    if (comm->rank() == 0) {
        deck.emplace(sim, *state, comm->size());
    }
    Snapshot own;
    Cuts cuts;
    for (int rank = 0; rank < comm->size(); ++rank) {
        std::vector<Parcel> out(at(comm->size()));
        if (deck) {
            out[at(rank)] = deck->parcel_of(rank);
        }
        const std::vector<Parcel> in = comm->exchange(std::move(out));
        if (rank == comm->rank()) {
            Unpacking from(in.front());
            cuts.first = take_list<std::uint64_t>(from);
            for (auto left = from.take<std::size_t>(); left > 0; --left) {
                Column column = take_column(from);
                own.arrays.emplace(column.name, std::move(column));
            }
        }
    }
    if (sim.fluid) {
        share(*sim.fluid, *comm, cuts);
    }
    restore_share(sim, own);
}

} // namespace hyoryu
