// SPDX-License-Identifier: MIT
// Particles of several ranks, put together.
#include "particle_arrays.hpp"

#include "hyoryu/ranks/columns.hpp"
#include "hyoryu/sim/state_parts.hpp"

#include "tiles_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace hyoryu {

namespace {

const std::string wall_tiles = "wall/tiles";
const std::string body_tiles = "body/tiles";

bool is_of_tiles(const std::string& name)
{
    return name.starts_with(std::string(tiles_of_fluid) + "/") ||
           name.starts_with(wall_tiles + "/") || name.starts_with(body_tiles + "/");
}

bool is_of_particles(const std::string& name, const std::set<std::string>& of_fluid)
{
    return name.starts_with("wall/") || name.starts_with("body/") || is_of_tiles(name) ||
           of_fluid.contains(name);
}

std::int64_t fixed_rows_of(const Snapshot& particles)
{
    std::int64_t rows = 0;
    if (particles.arrays.contains(rows_of_fixed_walls)) {
        StateReader reader(particles);
        reader(rows_of_fixed_walls, "", rows);
    }
    return rows;
}

// Merges rows that all ranks have; each rank has set the rows in its own tiles.
void overwrite(Column& all, const Column& next, std::span<const std::int32_t> rows,
               const std::string& name)
{
    const auto width = std::ptrdiff_t{all.components};
    const bool fits =
        all.values.index() == next.values.index() && all.components == next.components;
    const auto count = std::min(rows_of(all), rows_of(next));
    for (const std::int32_t row : rows) {
        if (!fits || row < 0 || at(row) >= count) {
            refuse_rows(name);
        }
        std::visit(
            [&]<class T>(std::vector<T>& values) {
                const auto& others = std::get<std::vector<T>>(next.values);
                std::copy_n(others.begin() + row * width, width, values.begin() + row * width);
            },
            all.values);
    }
}

// Tiles of the next part, whose rows from `first` on come behind those before.
void append_tiles(Snapshot& all, const Snapshot& next, const std::string& name, Index first,
                  Index shift)
{
    if (!all.arrays.contains(name + "/number")) {
        return;
    }
    Tiles tiles = tiles_in(all, name);
    const Tiles more = tiles_in(next, name);
    if (tiles.start.empty()) {
        refuse_rows(name);
    }
    const std::int32_t entries = tiles.start.back();
    const auto add = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    add(tiles.tile, more.tile);
    for (std::size_t t = 1; t < more.start.size(); ++t) {
        tiles.start.push_back(entries + more.start[t]);
    }
    for (const std::int32_t row : more.row) {
        tiles.row.push_back(row + (row >= first ? static_cast<std::int32_t>(shift) : 0));
    }
    for (const auto column : {&Tiles::x, &Tiles::y, &Tiles::z}) {
        add(tiles.*column, more.*column);
    }
    StateWriter writer(all);
    describe_tiles(writer, std::as_const(tiles), name);
}

const Column& same_of(const Snapshot& next, const std::string& name)
{
    const auto found = next.arrays.find(name);
    if (found == next.arrays.end()) {
        throw IoError(fmt::format("a part of the checkpoint has no `{}`: it is damaged or belongs "
                                  "to another case",
                                  name));
    }
    return found->second;
}

// Rows of walls that move come first and are on all ranks; then come those of fixed walls.
void append_wall_column(Column& all, const Column& next, Index moving,
                        std::span<const std::int32_t> rows, const std::string& name)
{
    std::vector<std::int32_t> of_moving;
    std::ranges::copy_if(rows, std::back_inserter(of_moving),
                         [&](std::int32_t row) { return row < moving; });
    if (std::ssize(of_moving) > 0) {
        overwrite(all, next, of_moving, name);
    }
    const auto count = static_cast<std::int64_t>(rows_of(next));
    if (count < moving) {
        refuse_rows(name);
    }
    std::vector<std::int32_t> fixed(at(count - moving));
    std::iota(fixed.begin(), fixed.end(), static_cast<std::int32_t>(moving));
    append_rows(all, some_rows(next, fixed));
}

} // namespace

std::set<std::string> fluid_columns(const Simulation& sim)
{
    std::set<std::string> names{"fluid/id"};
    sim.fluid->particles.fluid.for_each_column([&](const FieldInfo& column, const auto&) {
        if (column.state) {
            names.insert(fmt::format("fluid/{}", column.name));
        }
    });
    return names;
}

Tiles tiles_in(const Snapshot& state, const std::string& name)
{
    Tiles tiles;
    if (state.arrays.contains(name + "/number")) {
        StateReader reader(state);
        describe_tiles(reader, tiles, name);
    }
    return tiles;
}

void refuse_rows(const std::string& name)
{
    throw IoError(fmt::format("`{}` of the checkpoint does not fit its tiles: it is damaged or "
                              "belongs to another case",
                              name));
}

namespace {

// Moves the arrays of particles from one map to another, selected by name.
template <class Map>
void move_particles(const Simulation& sim, Map& from, Map& to)
{
    const std::set<std::string> of_fluid = fluid_columns(sim);
    for (auto entry = from.begin(); entry != from.end();) {
        const auto next = std::next(entry);
        if (is_of_particles(entry->first, of_fluid)) {
            to.insert(from.extract(entry));
        }
        entry = next;
    }
}

} // namespace

Snapshot take_particles(const Simulation& sim, Snapshot& state)
{
    Snapshot particles;
    move_particles(sim, state.arrays, particles.arrays);
    return particles;
}

StateOnDemand take_particles(const Simulation& sim, StateOnDemand& state)
{
    StateOnDemand particles{.bytes = {}, .array = state.array, .texts = {}};
    move_particles(sim, state.bytes, particles.bytes);
    return particles;
}

void append_particles(const Simulation& sim, Snapshot& all, Snapshot next)
{
    if (all.arrays.empty()) {
        all = std::move(next);
        return;
    }
    const std::set<std::string> of_fluid = fluid_columns(sim);
    const Index moving = sim.fluid->fixed_walls.moving_rows;
    const auto fluid = static_cast<Index>(rows_of(same_of(all, "fluid/id")));
    const std::vector<std::int32_t> wall_rows = tiles_in(next, wall_tiles).row;
    const std::vector<std::int32_t> body_rows = tiles_in(next, body_tiles).row;
    for (auto& [name, column] : all.arrays) {
        if (is_of_tiles(name) || name == rows_of_fixed_walls) {
            continue;
        }
        const Column& more = same_of(next, name);
        if (of_fluid.contains(name)) {
            append_rows(column, more);
        } else if (name.starts_with("wall/")) {
            append_wall_column(column, more, moving, wall_rows, name);
        } else {
            overwrite(column, more, body_rows, name);
        }
    }
    const std::int64_t fixed = fixed_rows_of(all);
    append_tiles(all, next, tiles_of_fluid, 0, fluid);
    append_tiles(all, next, wall_tiles, moving, fixed);
    append_tiles(all, next, body_tiles, 0, 0);
    StateWriter writer(all);
    writer(rows_of_fixed_walls, "", fixed + fixed_rows_of(next));
}

void put_particles(Snapshot& state, Snapshot particles)
{
    particles.arrays.erase(rows_of_fixed_walls);
    state.arrays.merge(particles.arrays);
}

} // namespace hyoryu
