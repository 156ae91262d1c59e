// SPDX-License-Identifier: MIT
#include "hyoryu/sim/checkpoint.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

using Numbers = std::vector<double>;

// The most fluid particles that have been inside solids; left out while there were none.
constexpr const char* in_solids = "in_solids";

void put(Numbers& out, double value)
{
    out.push_back(value);
}
void put(Numbers& out, const Vec3& v)
{
    out.insert(out.end(), v.begin(), v.end());
}

void add(Snapshot& snapshot, const std::string& name, Numbers numbers)
{
    snapshot.arrays[name] = {name, "", 1, std::move(numbers)};
}

template <class T>
void add_values(Snapshot& snapshot, const std::string& name, std::span<const T> values)
{
    snapshot.arrays[name] = {name, "", 1, std::vector<T>(values.begin(), values.end())};
}

template <class T>
const std::vector<T>& values(const Snapshot& snapshot, const std::string& name)
{
    const auto found = snapshot.arrays.find(name);
    const auto* stored = found == snapshot.arrays.end()
                             ? nullptr
                             : std::get_if<std::vector<T>>(&found->second.values);
    if (stored == nullptr) {
        throw IoError(fmt::format("the checkpoint has no `{}`: it belongs to another case", name));
    }
    return *stored;
}

// Reads numbers in the order in which they were put.
class Reader {
public:
    Reader(const Snapshot& snapshot, const std::string& name)
        : name_(name), numbers_(values<double>(snapshot, name))
    {
    }
    double number()
    {
        if (next_ >= numbers_.size()) {
            throw IoError(fmt::format(
                "`{}` of the checkpoint is too short: it belongs to another case", name_));
        }
        return numbers_[next_++];
    }
    Vec3 vector()
    {
        const double x = number();
        const double y = number();
        return {x, y, number()};
    }
    const Numbers& all() const { return numbers_; }

private:
    std::string name_;
    const Numbers& numbers_;
    std::size_t next_ = 0;
};

Numbers flat(std::span<const Vec3> column)
{
    Numbers numbers(3 * column.size());
    for (std::size_t k = 0; k < column.size(); ++k) {
        std::copy(column[k].begin(), column[k].end(), &numbers[3 * k]);
    }
    return numbers;
}
Numbers flat(std::span<const real> column)
{
    return {column.begin(), column.end()};
}

template <class T>
void unflat(std::span<const double> numbers, std::span<T> column)
{
    constexpr std::size_t n = std::is_same_v<T, Vec3> ? 3 : 1;
    if (numbers.size() != n * column.size()) {
        throw IoError("a column of the checkpoint has another length: it belongs to another case");
    }
    for (std::size_t k = 0; k < column.size(); ++k) {
        if constexpr (n == 3) {
            column[k] = Eigen::Map<const Vec3>(&numbers[3 * k]);
        } else {
            column[k] = numbers[k];
        }
    }
}

// The tiles of the last list build, from which the lists are built again.
void save_tiles(const Tiles& tiles, const std::string& name, Snapshot& snapshot)
{
    add_values(
        snapshot, name + "/number",
        std::span(reinterpret_cast<const std::int64_t*>(tiles.tile.data()), tiles.tile.size()));
    add_values(snapshot, name + "/start", std::span<const std::int32_t>(tiles.start));
    add_values(snapshot, name + "/row", std::span<const std::int32_t>(tiles.row));
    add_values(snapshot, name + "/x", std::span<const float>(tiles.x));
    add_values(snapshot, name + "/y", std::span<const float>(tiles.y));
    add_values(snapshot, name + "/z", std::span<const float>(tiles.z));
}

// Lists are made from tiles by index: those of a damaged checkpoint would lead anywhere.
void check_tiles(const Tiles& tiles, Rows rows)
{
    const auto is_finite = [](float a) { return std::isfinite(a); };
    const auto is_a_row = [&](std::int32_t row) { return row >= rows.begin && row < rows.end; };
    const bool whole =
        tiles.start.size() == tiles.tile.size() + 1 && tiles.start.front() == 0 &&
        tiles.start.back() == tiles.count() && tiles.count() <= rows.size() &&
        tiles.x.size() == tiles.row.size() && tiles.y.size() == tiles.row.size() &&
        tiles.z.size() == tiles.row.size() && std::ranges::is_sorted(tiles.start) &&
        std::ranges::is_sorted(tiles.tile) && std::ranges::all_of(tiles.row, is_a_row) &&
        std::ranges::all_of(tiles.x, is_finite) && std::ranges::all_of(tiles.y, is_finite) &&
        std::ranges::all_of(tiles.z, is_finite);
    if (!whole) {
        throw IoError("the checkpoint has tiles that do not fit its particles: it is damaged");
    }
}

void restore_tiles(Tiles& tiles, const Store& store, const std::string& name,
                   const Snapshot& snapshot)
{
    const auto& number = values<std::int64_t>(snapshot, name + "/number");
    tiles.tile.assign(number.begin(), number.end());
    tiles.start = values<std::int32_t>(snapshot, name + "/start");
    tiles.row = values<std::int32_t>(snapshot, name + "/row");
    tiles.x = values<float>(snapshot, name + "/x");
    tiles.y = values<float>(snapshot, name + "/y");
    tiles.z = values<float>(snapshot, name + "/z");
    check_tiles(tiles, store.rows());
}

// Of solid particles: friction, which acts a step later, and the image that the lists know.
using LastingOfSolids = Fields<Position, ViscousForce>;

bool lasts(const Fluid& fluid, Position)
{
    return fluid.moving_walls && fluid.period != Vec3(0, 0, 0);
}
bool lasts(const Fluid& fluid, ViscousForce)
{
    return sticks_to_solids(fluid) && fluid.particles.wall.has(field::viscous_force);
}

void save_fluid(const Fluid& fluid, Snapshot& snapshot)
{
    const Store& store = fluid.particles.fluid;
    store.for_each_column([&]<class T>(const FieldInfo& column, const ColumnValues<T>& values_of) {
        if (column.state) {
            add(snapshot, fmt::format("fluid/{}", column.name),
                flat(std::span<const T>(values_of)));
        }
    });
    for_each(LastingOfSolids{}, [&](auto column) {
        if (lasts(fluid, column)) {
            Numbers both = flat(std::span(fluid.particles.wall[column]));
            const Numbers bodies = flat(std::span(fluid.particles.body[column]));
            both.insert(both.end(), bodies.begin(), bodies.end());
            add(snapshot, fmt::format("solids/{}", column.info.name), std::move(both));
        }
    });
    add_values(snapshot, "fluid/id", std::span(store.id()));
    save_tiles(fluid.neighbours.fluid, "fluid/tiles", snapshot);
    if (fluid.moving_walls) {
        save_tiles(fluid.neighbours.wall, "fluid/wall_tiles", snapshot);
    }
    save_tiles(fluid.neighbours.body, "fluid/body_tiles", snapshot);
    Numbers numbers;
    put(numbers, static_cast<double>(store.size()));
    put(numbers, static_cast<double>(fluid.neighbours.builds));
    put(numbers, static_cast<double>(fluid.neighbours.steps));
    put(numbers, fluid.neighbours.skins.fluid);
    put(numbers, fluid.neighbours.skins.solid);
    put(numbers, static_cast<double>(fluid.lost.count));
    put(numbers, fluid.lost.momentum);
    put(numbers, fluid.lost.energy);
    add(snapshot, "fluid/numbers", std::move(numbers));
}

// The search for neighbours turns places into numbers of cells.
void check_places(const Numbers& places)
{
    if (!std::all_of(places.begin(), places.end(), [](double x) { return std::isfinite(x); })) {
        throw IoError("the checkpoint has particles without a finite position: it is damaged");
    }
}

// Which fixed walls have rows follows from the tiles of fluid and bodies.
void restore_solids(Fluid& fluid, const Snapshot& snapshot)
{
    Store& wall = fluid.particles.wall;
    Store& body = fluid.particles.body;
    restore_tiles(fluid.neighbours.body, body, "fluid/body_tiles", snapshot);
    place_fixed_walls(fluid);
    for_each(LastingOfSolids{}, [&](auto column) {
        if (lasts(fluid, column)) {
            const Reader saved(snapshot, fmt::format("solids/{}", column.info.name));
            const std::span<const double> both(saved.all());
            const auto of_walls = std::min(both.size(), wall[column].size_bytes() / sizeof(real));
            unflat(both.first(of_walls), std::span(wall[column]));
            unflat(both.subspan(of_walls), std::span(body[column]));
        }
    });
    if (fluid.moving_walls) {
        restore_tiles(fluid.neighbours.wall, wall, "fluid/wall_tiles", snapshot);
    }
}

void restore_fluid(Fluid& fluid, const Snapshot& snapshot)
{
    Store& store = fluid.particles.fluid;
    Reader numbers(snapshot, "fluid/numbers");
    const double stored = numbers.number();
    if (!(stored >= 0 && stored <= static_cast<double>(store.size()))) {
        throw IoError(fmt::format("the checkpoint has {} fluid particles, which cannot be of the "
                                  "{} of this case: it belongs to another case",
                                  stored, store.size()));
    }
    const auto kept = static_cast<Index>(stored);
    // Particles that were lost before the checkpoint leave the store; which rows go does not
    // matter.
    std::vector<std::int32_t> order(static_cast<std::size_t>(kept));
    for (std::size_t k = 0; k < order.size(); ++k) {
        order[k] = static_cast<std::int32_t>(k);
    }
    store.gather(order);
    fluid.neighbours.builds = static_cast<long long>(numbers.number());
    fluid.neighbours.steps = static_cast<long long>(numbers.number());
    fluid.neighbours.skins.fluid = numbers.number();
    fluid.neighbours.skins.solid = numbers.number();
    fluid.lost.count = static_cast<Index>(numbers.number());
    fluid.lost.momentum = numbers.vector();
    fluid.lost.energy = numbers.number();
    const auto rows = static_cast<std::size_t>(kept);
    store.for_each_column([&]<class T>(const FieldInfo& column, ColumnValues<T>& values_of) {
        if (column.state) {
            const Reader saved(snapshot, fmt::format("fluid/{}", column.name));
            unflat(saved.all(), std::span<T>(values_of));
        }
    });
    const auto& id = values<std::int64_t>(snapshot, "fluid/id");
    if (id.size() != rows) {
        throw IoError("the checkpoint has other particle numbers: it belongs to another case");
    }
    std::copy(id.begin(), id.end(), store.id().begin());
    check_places(flat(std::span(store[field::position])));
    restore_tiles(fluid.neighbours.fluid, store, "fluid/tiles", snapshot);
    restore_solids(fluid, snapshot);
    rebuild_neighbours(fluid);
}

void save_rigid(const Rigid& rigid, Snapshot& snapshot)
{
    Numbers numbers;
    for (const Body& body : rigid.bodies) {
        put(numbers, body.position);
        const Quat& q = body.orientation;
        for (const double c : {q.w(), q.x(), q.y(), q.z()}) {
            put(numbers, c);
        }
        put(numbers, body.velocity);
        put(numbers, body.angular_momentum);
    }
    add(snapshot, "rigid/bodies", std::move(numbers));
    add(snapshot, "rigid/memory", save_memory(rigid));
    const RigidCounters& c = rigid.counters;
    add(snapshot, "rigid/counters",
        {static_cast<double>(c.impacts), static_cast<double>(c.rounds),
         static_cast<double>(c.events), static_cast<double>(c.tangential_impacts),
         static_cast<double>(c.capped_steps), c.worst_residual, c.worst_penetration});
}

void restore_rigid(Rigid& rigid, const Snapshot& snapshot)
{
    Reader numbers(snapshot, "rigid/bodies");
    for (Body& body : rigid.bodies) {
        body.position = numbers.vector();
        const double w = numbers.number();
        const Vec3 xyz = numbers.vector();
        body.orientation = Quat(w, xyz.x(), xyz.y(), xyz.z());
        body.velocity = numbers.vector();
        body.angular_momentum = numbers.vector();
    }
    const Reader memory(snapshot, "rigid/memory");
    load_memory(rigid, memory.all());
    Reader counters(snapshot, "rigid/counters");
    RigidCounters& c = rigid.counters;
    for (long long* count :
         {&c.impacts, &c.rounds, &c.events, &c.tangential_impacts, &c.capped_steps}) {
        *count = static_cast<long long>(counters.number());
    }
    c.worst_residual = counters.number();
    c.worst_penetration = counters.number();
}

Numbers numbers_of(const Conservation& sums)
{
    const Totals& t = sums.start;
    Numbers n{t.fluid_kinetic, t.fluid_potential, t.fluid_internal, t.body_kinetic,
              t.body_potential};
    put(n, t.momentum);
    put(n, t.momentum_scale);
    put(n, sums.contact_loss);
    put(n, sums.wall_impulse);
    put(n, sums.gravity_impulse);
    put(n, sums.worst_closure);
    put(n, sums.worst_density_error);
    return n;
}

void restore_conservation(Conservation& sums, const Snapshot& snapshot)
{
    Reader n(snapshot, "ledger");
    Totals& t = sums.start;
    for (double* value : {&t.fluid_kinetic, &t.fluid_potential, &t.fluid_internal, &t.body_kinetic,
                          &t.body_potential}) {
        *value = n.number();
    }
    t.momentum = n.vector();
    t.momentum_scale = n.number();
    sums.contact_loss = n.number();
    sums.wall_impulse = n.vector();
    sums.gravity_impulse = n.vector();
    sums.worst_closure = n.number();
    sums.worst_density_error = n.number();
    const bool any = snapshot.arrays.contains(in_solids);
    sums.worst_in_solids = any ? static_cast<Index>(Reader(snapshot, in_solids).number()) : 0;
}

} // namespace

Snapshot save(const Simulation& sim)
{
    Snapshot snapshot;
    const Clock& c = sim.clock;
    add(snapshot, clock_array,
        {c.time, static_cast<double>(c.step), c.dt, static_cast<double>(c.frame),
         static_cast<double>(c.history), c.share});
    if (c.frame_offset != 0) {
        add(snapshot, frame_offset_array, {static_cast<double>(c.frame_offset)});
    }
    add(snapshot, "ledger", numbers_of(sim.conservation));
    if (sim.conservation.worst_in_solids > 0) {
        add(snapshot, in_solids, {static_cast<double>(sim.conservation.worst_in_solids)});
    }
    Numbers loads;
    for (const Wrench& load : sim.loads.bodies) {
        put(loads, load.force);
        put(loads, load.torque);
    }
    add(snapshot, "loads", std::move(loads));
    if (!sim.scene.gauges.empty()) {
        Numbers gauges = numbers_of(sim.gauges);
        put(gauges, static_cast<double>(c.gauge));
        add(snapshot, gauges_array, std::move(gauges));
    }
    if (!sim.seepage.open.empty()) {
        Numbers joints{static_cast<double>(sim.seepage.joined.size())};
        for (const auto& [body, face] : sim.seepage.joined) {
            put(joints, static_cast<double>(body));
            put(joints, static_cast<double>(face));
        }
        add(snapshot, "joints", std::move(joints));
    }
    save_rigid(sim.rigid, snapshot);
    if (sim.fluid) {
        save_fluid(*sim.fluid, snapshot);
    }
    return snapshot;
}

void restore(Simulation& sim, const Snapshot& snapshot)
{
    Reader clock(snapshot, clock_array);
    sim.clock.time = clock.number();
    sim.clock.step = static_cast<std::int64_t>(clock.number());
    sim.clock.dt = clock.number();
    sim.clock.frame = static_cast<std::int64_t>(clock.number());
    sim.clock.history = static_cast<std::int64_t>(clock.number());
    sim.clock.share = clock.number();
    const bool shifted = snapshot.arrays.contains(frame_offset_array);
    sim.clock.frame_offset =
        shifted ? static_cast<std::int64_t>(Reader(snapshot, frame_offset_array).number()) : 0;
    restore_conservation(sim.conservation, snapshot);
    Reader loads(snapshot, "loads");
    for (Wrench& load : sim.loads.bodies) {
        load.force = loads.vector();
        load.torque = loads.vector();
    }
    if (!sim.scene.gauges.empty()) {
        const Reader gauges(snapshot, gauges_array);
        const std::span<const double> numbers(gauges.all());
        restore(sim.gauges, numbers.first(std::max<std::size_t>(numbers.size(), 1) - 1));
        sim.clock.gauge = static_cast<std::int64_t>(numbers.back());
    }
    if (!sim.seepage.open.empty()) {
        const Reader joints(snapshot, "joints");
        restore_joints(sim.seepage, joints.all());
    }
    restore_rigid(sim.rigid, snapshot);
    if (sim.fluid) {
        restore_fluid(*sim.fluid, snapshot);
    }
}

} // namespace hyoryu
