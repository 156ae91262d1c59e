// SPDX-License-Identifier: MIT
#include "walls_by_range.hpp"

#include "layer_places.hpp"
#include "open_side.hpp"
#include "overlap_owner.hpp"
#include "walls.hpp"

#include "hyoryu/scene/solid_surface.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace hyoryu {

namespace {

// A place in the layers of a wall. Wall particles are numbered by copy, turn, wall and number.
struct LayerPlace {
    Index turn = 0;        // 1 within several walls, else 0
    std::int32_t copy = 0; // 0: the place itself; else it is shifted by `wall_shifts[copy]`
    std::int32_t wall = 0;
    Index number = 0; // in the layers
    Vec3 home{0, 0, 0};

    auto key() const { return std::tuple(copy, turn, wall, number); }
    bool operator==(const LayerPlace& other) const { return key() == other.key(); }
};

// The places in the part of the layers that this process computes, each of the wall with the best
// claim.
std::vector<LayerPlace> part_of_layers(const Scene& scene, const LayerLattice& lattice,
                                       const std::vector<SolidSurface>& surfaces, Comm& comm)
{
    const OverlapOwner owners(scene, surfaces, lattice.depth());
    std::vector<LayerPlace> places;
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        for_each_place(layer_places(scene.walls[w], surfaces[w], lattice), &comm,
                       [&](Index number, const Vec3& p) {
                           const Owner owner =
                               in_period(scene, p) ? owners.owner(w, p) : Owner::other;
                           if (owner != Owner::other) {
                               places.push_back({owner == Owner::best ? 1 : 0, 0,
                                                 static_cast<std::int32_t>(w), number, p});
                           }
                       });
    }
    return places;
}

FillRegion region_of(const Scene& scene, const Filling& filling, Comm& comm,
                     const std::vector<LayerPlace>& places)
{
    const TileLattice lattice = fill_lattice(scene, filling.domain);
    TileWeights weights;
    for (const Vec3& p : filling.fluid) {
        weights[lattice.tile_of(p)] += 1;
    }
    for (const LayerPlace& place : places) {
        weights[lattice.tile_of(place.home)] += 1;
    }
    return {comm, lattice, weights};
}

// Sends places to the processes that `to(place, send)` calls send(rank) for; returns what came, in
// order.
std::vector<LayerPlace> send(Comm& comm, const std::vector<LayerPlace>& places, const auto& to)
{
    std::vector<std::vector<LayerPlace>> by_rank(at(comm.size()));
    for (const LayerPlace& place : places) {
        to(place, [&](int rank) { by_rank[at(rank)].push_back(place); });
    }
    std::vector<Parcel> out(by_rank.size());
    for (std::size_t rank = 0; rank < out.size(); ++rank) {
        put_list(out[rank], std::exchange(by_rank[rank], {}));
    }
    std::vector<LayerPlace> all;
    for (const Parcel& parcel : comm.exchange(std::move(out))) {
        Unpacking from(parcel);
        take_more(from, all);
    }
    std::ranges::sort(all, {}, &LayerPlace::key);
    return all;
}

// The selection among the places of this process, given that of other processes near it.
std::vector<LayerPlace> with_room(const Scene& scene, const std::vector<LayerPlace>& own,
                                  const std::vector<LayerPlace>& others)
{
    std::vector<Vec3> points;
    WallCrowd crowd(scene, points);
    const auto add = [&](const LayerPlace& place) {
        const bool has_room = crowd.add(place.home, at(place.wall));
        if (has_room) {
            points.push_back(place.home);
        }
        return has_room;
    };
    std::vector<LayerPlace> taken;
    auto other = others.begin();
    for (const LayerPlace& place : own) {
        for (; other != others.end() && other->key() < place.key(); ++other) {
            add(*other);
        }
        if (add(place)) {
            taken.push_back(place);
        }
    }
    return taken;
}

// The places with a particle in the region of this process.
std::vector<LayerPlace> take_places(const Scene& scene, const FillRegion& region,
                                    const std::vector<LayerPlace>& own)
{
    Comm& comm = region.comm();
    // A place is compared with the first one in a cell that is as near: the diagonal of a cell
    // more.
    const double reach = 1.01 * (1 + std::sqrt(3.0)) * Crowd::distance * scene.spacing;
    std::vector<LayerPlace> taken;
    std::vector<LayerPlace> others;
    for (bool news = true; news;) {
        taken = with_room(scene, own, others);
        std::vector<LayerPlace> now = send(comm, taken, [&](const LayerPlace& p, const auto& to) {
            std::ranges::for_each(region.others_about(p.home, reach), to);
        });
        news = sum_of_all(&comm, now == others ? 0 : 1) > 0;
        others = std::move(now);
    }
    return taken;
}

// Wall particles of copy `from` that are shifted outwards by `column` columns. Ordered as one
// process numbers them.
struct NewCopy {
    std::int32_t column = 0;
    std::int32_t from = 0;

    auto operator<=>(const NewCopy&) const = default;
};

// Continues the walls at a window. `shifts`: from the place of the layers to each copy [m].
std::vector<LayerPlace> carry_out(Comm& comm, const CarriedWalls& window,
                                  const std::vector<LayerPlace>& places, std::vector<Vec3>& shifts)
{
    const auto place_of = [&](const LayerPlace& p) { return p.home + shifts[at(p.copy)]; };
    std::set<NewCopy> own;
    for (const LayerPlace& p : places) {
        for (int column = 1; window.is_copied(place_of(p), p.wall) && column <= window.columns();
             ++column) {
            own.insert({column, p.copy});
        }
    }
    std::vector<NewCopy> made = of_all_ranks(&comm, std::vector<NewCopy>(own.begin(), own.end()));
    std::ranges::sort(made);
    made.erase(std::ranges::unique(made).begin(), made.end());
    const auto copies = static_cast<std::int32_t>(shifts.size());
    std::vector<LayerPlace> all;
    for (const LayerPlace& p : places) {
        if (window.stays(place_of(p), p.wall)) {
            all.push_back(p);
        }
        for (int column = 1; window.is_copied(place_of(p), p.wall) && column <= window.columns();
             ++column) {
            const auto found = std::ranges::lower_bound(made, NewCopy{column, p.copy});
            LayerPlace& copy = all.emplace_back(p);
            copy.copy = copies + static_cast<std::int32_t>(found - made.begin());
        }
    }
    for (const NewCopy& copy : made) {
        shifts.emplace_back(shifts[at(copy.from)] + window.shift(copy.column));
    }
    return all;
}

// Places with consecutive numbers.
struct PlaceRun {
    LayerPlace first;
    Index count = 0;
    Index index = 0; // of the first among the wall particles of all processes

    auto key() const { return first.key(); }
    bool goes_on_with(const LayerPlace& p) const
    {
        return p.copy == first.copy && p.wall == first.wall && p.number == first.number + count;
    }
};

// The runs of all processes, numbered; `places`: ascending.
std::vector<PlaceRun> number_runs(Comm& comm, const std::vector<LayerPlace>& places)
{
    std::vector<PlaceRun> own;
    for (const LayerPlace& p : places) {
        if (own.empty() || !own.back().goes_on_with(p)) {
            own.push_back({p});
        }
        own.back().count += 1;
    }
    std::vector<PlaceRun> runs = of_all_ranks(&comm, std::move(own));
    std::ranges::sort(runs, {}, &PlaceRun::key);
    Index index = 0;
    for (PlaceRun& run : runs) {
        run.index = index;
        index += run.count;
    }
    return runs;
}

void set_runs(const std::vector<PlaceRun>& runs, Filling& filling)
{
    const PlaceRun* before = nullptr;
    Index length = 0; // of the run that `before` ends
    for (const PlaceRun& run : runs) {
        const bool goes_on = before != nullptr && before->goes_on_with(run.first);
        if (!goes_on) {
            filling.wall_runs.push_back(
                {run.index, run.first.number, run.first.wall, run.first.copy});
        }
        length += run.count;
        before = &run;
    }
    filling.wall_elsewhere = length - static_cast<Index>(filling.wall.size());
}

void add_particles(const Scene& scene, const std::vector<LayerPlace>& places,
                   const std::vector<SolidSurface>& surfaces, const std::vector<PlaceRun>& runs,
                   Filling& filling)
{
    auto run = runs.begin();
    for (const LayerPlace& p : places) {
        while (run + 1 != runs.end() && (run + 1)->key() <= p.key()) {
            ++run;
        }
        filling.wall_number.push_back(run->index + p.number - run->first.number);
        filling.wall.emplace_back(p.home + filling.wall_shifts[at(p.copy)]);
        filling.wall_owner.push_back(p.wall);
        if (scene.fluid->walls.sticks) {
            const auto w = at(p.wall);
            filling.wall_depth.push_back(
                depth_behind(scene.walls[w], surfaces[w], p.home, scene.dimensions));
        }
    }
}

} // namespace

FillRegion fill_walls_by_range(const Scene& scene, Comm& comm, Filling& filling)
{
    const LayerLattice lattice = layer_lattice(scene, filling.domain);
    const auto surfaces = surfaces_of(scene.walls, lattice.depth(), scene.dimensions);
    std::vector<LayerPlace> places = part_of_layers(scene, lattice, surfaces, comm);
    FillRegion region = region_of(scene, filling, comm, places);
    const auto to_owner = [&](const LayerPlace& p, const auto& to) {
        to(region.owner(p.home + filling.wall_shifts[at(p.copy)]));
    };
    places = send(comm, places, to_owner);
    places = take_places(scene, region, places);
    for (const OpenSettings& open : scene.open) {
        places = carry_out(comm, CarriedWalls(scene, open), places, filling.wall_shifts);
    }
    if (!scene.open.empty()) {
        places = send(comm, places, to_owner);
    }
    const std::vector<PlaceRun> runs = number_runs(comm, places);
    add_particles(scene, places, surfaces, runs, filling);
    set_runs(runs, filling);
    return region;
}

} // namespace hyoryu
