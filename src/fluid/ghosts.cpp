// SPDX-License-Identifier: MIT
// Ghost particles: exchange of the fields that the stages of a step read from other ranks.
#include "hyoryu/fluid/ghosts.hpp"

#include "lists.hpp"
#include "sharing.hpp"
#include "sweeps.hpp"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace hyoryu {

void share(Fluid& fluid, Comm& comm, const Cuts& cuts)
{
    expects(cuts.ranks() == comm.size());
    fluid.ghosts = std::unique_ptr<Ghosts>(new Ghosts{.comm = comm, .cuts = cuts});
}

Comm* comm_of(const Fluid& fluid)
{
    return fluid.ghosts ? &fluid.ghosts->comm : nullptr;
}

TileRange own_tiles(const Fluid& fluid)
{
    return fluid.ghosts ? fluid.ghosts->cuts.range(fluid.ghosts->comm.rank()) : TileRange{};
}

Index count_over_ranks(const Fluid& fluid, Index count)
{
    std::int64_t sum = count;
    if (fluid.ghosts) {
        fluid.ghosts->comm.add(std::span(&sum, 1));
    }
    return sum;
}

real largest_of_all(const Fluid& fluid, real number)
{
    largest_of_all(comm_of(fluid), std::span(&number, 1));
    return number;
}

namespace {

void poison(Store& store)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    store.for_each_column([&]<class T>(const FieldInfo& of, ColumnValues<T>& values) {
        if (&of != &Velocity::info) {
            std::ranges::fill(values, uniform<T>(nan));
        }
    });
}

} // namespace

void poison_ghosts(Ghosts& ghosts, const Fluid& fluid)
{
    Particles& particles = ghosts.particles;
    poison(particles.fluid);
    poison(particles.body);
    if (!fluid.moving_walls) {
        const auto of_walls = particles.wall[field::position];
        const ColumnValues<Vec3> places(of_walls.begin(), of_walls.end());
        poison(particles.wall);
        std::ranges::copy(places, of_walls.begin());
    }
}

void share_places(Fluid& fluid)
{
    if (!fluid.ghosts || fluid.neighbours.builds == 0) {
        return;
    }
    Ghosts& g = *fluid.ghosts;
    if constexpr (debug_build) {
        poison_ghosts(g, fluid);
    }
    FluidNeighbours& n = fluid.neighbours;
    g.moved = measure_own(fluid);
    Delivery delivery;
    delivery.add(g.fluid.halo.tiles, n.fluid_motion.box, g.fluid.motion.box);
    delivery.add(g.body.halo.tiles, n.body_motion.box, g.body.motion.box);
    deliver_fluid(delivery, fluid,
                  Fields<Position, Density, Gap, GradientCorrection, MixedCorrection>{});
    if (fluid.moving_walls) {
        deliver_walls(delivery, fluid, Fields<Position, Velocity>{});
    }
    deliver_bodies(delivery, fluid, Fields<Position, Velocity>{});
    delivery.send(fluid.ghosts->comm, fluid.ghosts->outbox, fluid.ghosts->inbox);
}

void send_pressures(Fluid& fluid)
{
    if (fluid.ghosts) {
        Delivery delivery;
        deliver_walls(delivery, fluid, Fields<Volume, Pressure>{});
        deliver_bodies(delivery, fluid, Fields<Volume, Pressure>{});
        fluid.ghosts->solids.begin(fluid.ghosts->comm, std::move(delivery));
    }
}

void receive_pressures(Fluid& fluid)
{
    if (fluid.ghosts && fluid.ghosts->solids.arrive(fluid.ghosts->comm)) {
        load_ghost_solids(fluid, Fields<Volume, Pressure>{});
    }
}

void send_velocities(Fluid& fluid)
{
    if (!fluid.ghosts) {
        return;
    }
    receive_pressures(fluid); // if no forces were computed
    Delivery delivery;
    deliver_fluid(delivery, fluid, Fields<Velocity>{});
    if (fluid.moving_walls) {
        deliver_walls(delivery, fluid, Fields<Velocity>{});
    }
    deliver_bodies(delivery, fluid, Fields<Velocity>{});
    fluid.ghosts->velocities.begin(fluid.ghosts->comm, std::move(delivery));
}

void receive_velocities(Fluid& fluid)
{
    if (fluid.ghosts && fluid.ghosts->velocities.arrive(fluid.ghosts->comm)) {
        load_ghost_fluid(fluid, Fields<Velocity>{});
        load_ghost_solids(fluid, Fields<Velocity>{});
    }
}

namespace {

// Sends the listed columns of own body particles to all ranks; body rows are the same on all ranks.
template <class... F>
void replicate_bodies(Fluid& fluid, Fields<F...>)
{
    if (!fluid.ghosts) {
        return;
    }
    Store& store = fluid.particles.body;
    Parcel parcel;
    for (const std::int32_t row : fluid.neighbours.body.row) {
        put(parcel, row);
        (put(parcel, store[F{}][row]), ...);
    }
    Comm& comm = fluid.ghosts->comm;
    for (const Parcel& in : comm.exchange(std::vector<Parcel>(at(comm.size()), parcel))) {
        for (Unpacking from(in); !from.empty();) {
            const auto row = from.take<std::int32_t>();
            ((store[F{}][row] = from.take<typename F::type>()), ...);
        }
    }
}

} // namespace

void replicate_body_pressures(Fluid& fluid)
{
    replicate_bodies(fluid, Fields<Pressure, ShepardSum>{});
}

void replicate_body_friction(Fluid& fluid)
{
    replicate_bodies(fluid, Fields<ViscousForce>{});
}

void migrate_fluid(Fluid& fluid, const TileLattice& lattice)
{
    if (!fluid.ghosts) {
        return;
    }
    const Ghosts& g = *fluid.ghosts;
    Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    std::vector<int> owner(at(store.size()));
    parallel_for(0, store.size(), [&](Index i) {
        const bool inside = (x[i].array() >= fluid.domain_min.array()).all() &&
                            (x[i].array() <= fluid.domain_max.array()).all();
        owner[at(i)] = inside ? g.cuts.owner(lattice.tile_of(x[i])) : g.comm.rank();
    });
    std::visit([&](auto& data) { move_rows(g.comm, store, owner, data.common.room()); },
               fluid.pair_data);
}

namespace {

// Fields of ghosts that loops read before a stage sends them again.
using ReadOfGhosts = Fields<Position, Velocity, Density, Gap, GradientCorrection, MixedCorrection>;

void make_ghosts(Ghosts& g, GhostsOfKind& kind, const Tiles& tiles, const Store& own, Store& ghosts)
{
    kind.halo = share_tiles(g.comm, g.cuts, tiles, kind.tiles);
    kind.motion.box.assign(kind.tiles.tile.size(), {Vec3(0, 0, 0), Vec3(0, 0, 0)});
    kind.links = all_links(kind.halo);
    ghosts.reset_like(own, kind.halo.count());
    Delivery delivery;
    deliver(delivery, kind.links, tiles, own, ghosts, ReadOfGhosts{});
    delivery.send(g.comm, g.outbox, g.inbox);
}

} // namespace

void make_ghosts_of_fluid(Fluid& fluid)
{
    if (fluid.ghosts) {
        Ghosts& g = *fluid.ghosts;
        make_ghosts(g, g.fluid, fluid.neighbours.fluid, fluid.particles.fluid, g.particles.fluid);
    }
}

void make_ghosts_of_walls(Fluid& fluid)
{
    if (fluid.ghosts) {
        Ghosts& g = *fluid.ghosts;
        const Store& own = fluid.particles.wall;
        fluid.neighbours.wall.lattice = fluid.neighbours.fluid.lattice; // there may be no own walls
        make_ghosts(g, g.wall, fluid.neighbours.wall, own, g.particles.wall);
        share_owners(g.comm, g.wall.halo, fluid.neighbours.wall, own, g.particles.wall);
    }
}

void make_ghosts_of_bodies(Fluid& fluid)
{
    if (fluid.ghosts) {
        Ghosts& g = *fluid.ghosts;
        const Store& own = fluid.particles.body;
        make_ghosts(g, g.body, fluid.neighbours.body, own, g.particles.body);
        share_owners(g.comm, g.body.halo, fluid.neighbours.body, own, g.particles.body);
    }
}

void choose_links(Fluid& fluid)
{
    if (!fluid.ghosts) {
        return;
    }
    FluidNeighbours& n = fluid.neighbours;
    Ghosts& g = *fluid.ghosts;
    const Index first = g.fluid.tiles.first_slot; // of all ghosts
    g.inner = n.fluid_fluid.split(first);
    std::vector<std::uint8_t> marks(
        at(g.fluid.tiles.count() + g.wall.tiles.count() + g.body.tiles.count()), 0);
    for (const PairList* const list : {&n.fluid_fluid, &n.fluid_solid, &n.wall_fluid, &n.body_fluid,
                                       &n.body_solid, &n.wall_body}) {
        list->mark_looked_at(marks, first);
    }
    std::vector<LookedAt> looked_at;
    for (const GhostsOfKind* const kind : {&g.fluid, &g.wall, &g.body}) {
        looked_at.push_back(
            {&kind->halo, std::span<const std::uint8_t>(marks).subspan(
                              at(kind->tiles.first_slot - first), at(kind->tiles.count()))});
    }
    std::vector<Links> links = needed_links(g.comm, looked_at);
    g.fluid.links = std::move(links[0]);
    g.wall.links = std::move(links[1]);
    g.body.links = std::move(links[2]);
}

FrictionOnTheMove::FrictionOnTheMove(Fluid& fluid, const TileLattice& lattice)
{
    Store& wall = fluid.particles.wall;
    if (!fluid.ghosts || !wall.has(field::viscous_force)) {
        return;
    }
    const Ghosts& g = *fluid.ghosts;
    const auto x = wall[field::position];
    const auto F = wall[field::viscous_force];
    std::vector<Parcel> out(at(g.comm.size()));
    for (const std::int32_t row : fluid.neighbours.wall.row) {
        Parcel& to = out[at(g.cuts.owner(lattice.tile_of(lattice.wrapped(x[row]))))];
        put(to, wall.id()[row]);
        put(to, F[row]);
    }
    wall_ = g.comm.exchange(std::move(out));
    std::ranges::fill(F, Vec3(0, 0, 0)); // rows of moving walls are kept
}

void FrictionOnTheMove::arrive(Fluid& fluid) const
{
    Store& wall = fluid.particles.wall;
    std::unordered_map<std::int64_t, Index> row_of;
    for (Index row = 0; row < wall.size() && !wall_.empty(); ++row) {
        row_of[wall.id()[row]] = row;
    }
    for (const Parcel& parcel : wall_) {
        for (Unpacking from(parcel); !from.empty();) {
            const auto found = row_of.find(from.take<std::int64_t>());
            const Vec3 force = from.take<Vec3>();
            if (found != row_of.end()) { // walls away from fluid are dropped
                wall[field::viscous_force][found->second] = force;
            }
        }
    }
}

} // namespace hyoryu
