// SPDX-License-Identifier: MIT
#include "lists.hpp"

#include "sharing.hpp"

#include <algorithm>

namespace hyoryu {

namespace {

// Finds the own tiles that touch ghost tiles.
void connect_ghosts(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    Ghosts& g = *fluid.ghosts;
    for (GhostsOfKind* const kind : {&g.fluid, &g.body}) {
        find_touching(kind->tiles, n.fluid, kind->motion.fluid);
        find_touching(kind->tiles, measured_walls(fluid), kind->motion.wall);
        find_touching(kind->tiles, n.body, kind->motion.body);
    }
}

// Finds the touching tiles, and the wall tiles with neighbour lists.
void connect(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    find_touching(n.fluid, n.fluid, n.fluid_motion.fluid);
    find_touching(n.fluid, measured_walls(fluid), n.fluid_motion.wall);
    find_touching(n.fluid, n.body, n.fluid_motion.body);
    find_touching(n.body, measured_walls(fluid), n.body_motion.wall);
    find_touching(n.body, n.body, n.body_motion.body);
    if (fluid.ghosts) {
        connect_ghosts(fluid);
    }
    n.wet_walls.clear();
    std::vector<std::uint8_t>& wet = n.met;
    wet.assign(n.wall.tile.size(), 0);
    for (const PairList* list : {&n.wall_fluid, &n.wall_body}) {
        for (const ListBlock& block : list->blocks()) {
            const auto after = std::upper_bound(n.wall.start.begin(), n.wall.start.end(),
                                                block.first - n.wall.first_slot);
            wet[at(after - n.wall.start.begin() - 1)] = 1;
        }
    }
    for (std::size_t tile = 0; tile < wet.size(); ++tile) {
        if (wet[tile] != 0) {
            n.wet_walls.push_back(static_cast<std::int32_t>(tile));
        }
    }
}

// The owners of solid particles, by slot from the first wall slot on.
void collect_owners(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    n.owner.clear();
    const auto append = [&](const Tiles& tiles, const Store& store) {
        for (const std::int32_t row : tiles.row) {
            n.owner.push_back(store.owner()[row]);
        }
    };
    append(n.wall, fluid.particles.wall);
    append(n.body, fluid.particles.body);
    if (const Ghosts* const g = fluid.ghosts.get()) {
        n.owner.resize(n.owner.size() + at(g->fluid.tiles.count())); // no owners
        append(g->wall.tiles, g->particles.wall);
        append(g->body.tiles, g->particles.body);
    }
}

int pack_lanes(const Fluid& fluid)
{
    return std::visit(
        [&]<class Real>(const PairData<Real>&) {
            return std::get<PairLoops<Real>>(fluid_loops(fluid.instruction_set)).lanes;
        },
        fluid.pair_data);
}

void clear_lists(std::initializer_list<PairList*> lists)
{
    for (PairList* list : lists) {
        list->clear();
    }
}

// Numbers the slots: fluid, walls and bodies of this rank, then ghosts. Returns how many.
Index number_slots(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    Index next = 0;
    const auto number = [&](Tiles& tiles) {
        tiles.first_slot = next;
        next += tiles.count();
    };
    number(n.fluid);
    number(n.wall);
    number(n.body);
    if (Ghosts* const g = fluid.ghosts.get()) {
        number(g->fluid.tiles);
        number(g->wall.tiles);
        number(g->body.tiles);
    }
    return next;
}

// The points of all kinds, own and ghosts, as sources of lists.
struct Sources {
    ListSource fluid, wall, body;
};
Sources sources_of(const Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const Ghosts* const g = fluid.ghosts.get();
    return {{&n.fluid, g != nullptr ? &g->fluid.tiles : nullptr},
            {&n.wall, g != nullptr ? &g->wall.tiles : nullptr},
            {&n.body, g != nullptr ? &g->body.tiles : nullptr}};
}

// Marks the points that are a neighbour in a list of any rank.
void mark_met(Fluid& fluid, const PairList& list, Index slots)
{
    FluidNeighbours& n = fluid.neighbours;
    n.met.assign(at(slots), 0);
    list.mark_met(n.met);
    if (Ghosts* const g = fluid.ghosts.get()) {
        const auto tell = [&](const GhostsOfKind& kind, const Tiles& own) {
            return_marks(g->comm, kind.halo, n.met, own.first_slot, kind.tiles.first_slot);
        };
        tell(g->wall, n.wall);
        tell(g->body, n.body);
    }
}

// Counts the list entries of all ranks, and those that this rank processes in a step.
void count_entries(Fluid& fluid)
{
    FluidNeighbours& n = fluid.neighbours;
    const Index of_fluid_alone = n.fluid_fluid.entries();
    const Index with_solids =
        n.fluid_solid.entries() + n.wall_fluid.entries() + n.body_fluid.entries();
    const Index films = n.body_solid.entries() + n.wall_body.entries();
    std::array<std::int64_t, 2> entries{of_fluid_alone, with_solids + films};
    if (fluid.ghosts) {
        fluid.ghosts->comm.add(entries);
    }
    n.entries = {entries[0], entries[1]};
    // Pressure and velocity loops of the fluid; extrapolation and loads of the solids; films.
    n.visits = 2 * (of_fluid_alone + with_solids) + films;
}

} // namespace

void build_lists(Fluid& fluid)
{
    const Particles& particles = fluid.particles;
    FluidNeighbours& n = fluid.neighbours;
    const Index slots = number_slots(fluid);
    const PairList::Settings of_pairs{fluid.kernel.support + n.skins.fluid, pack_lanes(fluid),
                                      fluid.instruction_set};
    PairList::Settings settings = of_pairs;
    settings.radius = fluid.kernel.support + n.skins.solid;
    const Sources sources = sources_of(fluid);
    const ListSource of_fluid[] = {sources.fluid};
    const ListSource of_bodies[] = {sources.body};
    const ListSource of_solids[] = {sources.wall, sources.body};
    n.fluid_fluid.build(n.fluid, of_fluid, of_pairs);
    if (has_solids(fluid)) {
        n.fluid_solid.build(n.fluid, of_solids, settings);
        // Wall particles away from fluid are in no list and need none of their own.
        mark_met(fluid, n.fluid_solid, slots);
        n.wall_fluid.build(n.wall, of_fluid, settings, {.wanted = n.met});
        n.body_fluid.build(n.body, of_fluid, settings, {.wanted = n.met});
    } else { // the last body may have left
        clear_lists({&n.fluid_solid, &n.wall_fluid, &n.body_fluid});
    }
    if (particles.body.size() > 0) {
        collect_owners(fluid);
        n.body_solid.build(n.body, of_solids, settings,
                           {.owner = n.owner, .first_owner = n.wall.first_slot});
        mark_met(fluid, n.body_solid, slots);
        n.wall_body.build(n.wall, of_bodies, settings, {.wanted = n.met});
    } else {
        clear_lists({&n.body_solid, &n.wall_body});
    }
    choose_links(fluid);
    connect(fluid);
    count_entries(fluid);
    std::visit(
        [&](auto& data) {
            data.slots = slots;
            data.records().load(particles.wall, n.wall, Stored{});
        },
        fluid.pair_data);
}

} // namespace hyoryu
