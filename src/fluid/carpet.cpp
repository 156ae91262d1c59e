// SPDX-License-Identifier: MIT
// Emission and removal of the particles of the carpets (buffer zones) of open sides. A carpet is a
// lattice that moves with its flow: the next column of a row stands a fixed distance behind its
// outermost particle, so that the places of the particles are all that a carpet remembers.
#include "hyoryu/fluid/totals.hpp"

#include "carpet.hpp"
#include "places.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace hyoryu {

namespace {

constexpr real least_distance = 0.6; // of a new particle from any other of the water [spacings]
// From body particles: the lattice of a body is stretched to its size, so that a place inside it
// may be farther than `least_distance` from its particles [spacings].
constexpr real least_from_body = 1;
constexpr real highest = 0.75;   // above the level, of a particle that stays [spacings]
constexpr real step_back = 0.25; // of a place that is taken [spacings]

// A particle to be made.
struct NewParticle {
    Vec3 place, velocity;
    real density = 0;
};

// The rows of one lane: distances from the plane of the particles of each, negative.
using LaneRows = std::vector<std::vector<real>>;

// Places of the water and of bodies near a carpet.
struct Taken {
    Places water, bodies;
};

// Emits the particles of one lane after another.
class Emitter {
public:
    Emitter(const Fluid& fluid, Carpet& carpet, Taken& taken, std::vector<NewParticle>& made)
        : f_(fluid.parameters), carpet_(carpet), taken_(taken), made_(made),
          far_(-(carpet.side.columns - 0.5) * f_.spacing)
    {
    }

    // `own`: the particles of the lane behind the plane; `inside`: distance of the nearest particle
    // of the lowest row in front of it.
    void fill_lane(int lane, const std::vector<Vec3>& own, real inside)
    {
        const real dp = f_.spacing;
        const StationFlow& flow = station_of(carpet_, lane);
        lane_ = lane;
        bed_ = carpet_.side.bed[at(lane)];
        const real rows = bed_ < infinity ? (flow.level - bed_) / dp : 0;
        if (flow.passes || !(rows >= least_rows)) {
            return;
        }
        const auto full = static_cast<int>(std::floor(rows + 1e-9));
        const real part = std::max(rows - full, real(0));
        LaneRows s(at(full + 1));
        for (const Vec3& x : own) {
            const real k = std::floor((x.z() - bed_) / dp);
            if (k >= 0 && k <= full) {
                s[at(static_cast<Index>(k))].push_back(carpet_.side.distance(x));
            }
        }
        for (int k = 0; k < full; ++k) {
            std::vector<real> added;
            if (k > 0) {
                added = stack(k, s[at(k - 1)], s[at(k)]);
            }
            const real begin = std::min(inside, dp) < dp ? inside : dp / 2;
            const std::vector<real> more = extend(k, s[at(k)], begin);
            added.insert(added.end(), more.begin(), more.end());
            if (k == full - 1) {
                cover(full, part, added);
            }
        }
    }

private:
    Vec3 place(real s, int row) const
    {
        const OpenSide& side = carpet_.side;
        Vec3 x = Vec3::Zero();
        x[side.axis] = side.plane + side.into * s;
        x[1 - side.axis] = side.middle(lane_);
        x.z() = bed_ + (static_cast<real>(row) + 0.5) * f_.spacing;
        return x;
    }
    bool emit(real s, int row)
    {
        const Vec3 x = place(s, row);
        if (!taken_.water.is_free(x) || !taken_.bodies.is_free(x)) {
            return false;
        }
        const StationFlow& flow = station_of(carpet_, lane_);
        made_.push_back({x, speed_at(carpet_, flow, bed_, x.z()) * carpet_.side.normal(),
                         density_at(f_, flow.level, x.z())});
        taken_.water.add(x);
        return true;
    }
    // Appends columns at the far end of a row; returns the new ones.
    std::vector<real> extend(int row, std::vector<real>& s, real begin)
    {
        const real dp = f_.spacing;
        const real column = carpet_.side.column(dp);
        real outermost = s.empty() ? begin : *std::ranges::min_element(s);
        std::vector<real> added;
        while (outermost > far_ + 1e-6 * dp) { // with a tolerance for rounding
            if (emit(outermost - column, row)) {
                outermost -= column;
                s.push_back(outermost);
                added.push_back(outermost);
            } else {
                outermost -= step_back * dp;
            }
        }
        return added;
    }
    // Adds particles above those of the row below if the level has risen; returns the new ones.
    std::vector<real> stack(int row, const std::vector<real>& below, std::vector<real>& s)
    {
        std::vector<real> added;
        for (std::size_t k = 0; k < below.size() && s.size() < below.size(); ++k) {
            if (emit(below[k], row)) {
                s.push_back(below[k]);
                added.push_back(below[k]);
            }
        }
        return added;
    }
    // Fills the top row in part: the share `part` of the new columns gets one more particle, so
    // that the volume of the water matches the level. A particle whose place is taken is omitted
    // for good.
    void cover(int row, real part, const std::vector<real>& added)
    {
        real& carry = carpet_.carry[at(lane_)];
        for (const real s : added) {
            carry += part;
            if (carry >= 0.5 && emit(s, row)) {
                carry -= 1;
            }
        }
        carry = std::clamp(carry, real(-1), real(1));
    }

    const FluidParameters& f_;
    Carpet& carpet_;
    Taken& taken_;
    std::vector<NewParticle>& made_;
    real far_; // outermost place from which a column is missing behind [m]
    int lane_ = 0;
    real bed_ = 0;
};

// Whether a row behind the plane has left the carpet.
bool has_left(const Fluid& fluid, const Carpet& carpet, const Vec3& x, bool beside_body)
{
    const real dp = fluid.parameters.spacing;
    const int lane = carpet.side.lane(x);
    const int inside = std::clamp(lane, 0, carpet.side.lanes() - 1);
    const real bed = carpet.side.bed[at(inside)];
    const StationFlow& flow = station_of(carpet, lane);
    const bool keeps_level = !flow.passes && !beside_body;
    return carpet.side.distance(x) < -(carpet.side.columns + 0.5) * dp || lane < -1 ||
           lane > carpet.side.lanes() || !(bed < infinity) || x.z() < bed - dp ||
           (keeps_level && x.z() > flow.level + highest * dp);
}

struct Lanes {
    std::vector<std::vector<Vec3>> own; // behind the plane, by lane
    std::vector<real> inside;           // distance of the nearest of the lowest row inside
};

// A row near a plane, replicated on all ranks.
struct NearRow {
    std::int64_t number = 0; // of the particle
    int rank = 0;
    std::int32_t row = 0;
    int beside_body = 0;
    Vec3 place{0, 0, 0}; // [m]

    std::pair<int, std::int32_t> name() const { return {rank, row}; }
};

// Sorted by particle number, since before the first lists the rows of ranks are not sorted by
// tiles.
std::vector<NearRow> near_rows(const Fluid& fluid, const Carpet& carpet)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto number = fluid.particles.fluid.id();
    const int rank = fluid.ghosts ? fluid.ghosts->comm.rank() : 0;
    std::vector<NearRow> own;
    for (std::size_t k = 0; k < carpet.near.size(); ++k) {
        const std::int32_t row = carpet.near[k];
        own.push_back({number[row], rank, row, carpet.is_beside_body(k) ? 1 : 0, x[row]});
    }
    std::vector<NearRow> all = terms_of_all(fluid, std::move(own));
    std::ranges::sort(all, {}, &NearRow::number);
    return all;
}

// Rows of all ranks that have left.
using LeftRows = std::set<std::pair<int, std::int32_t>>;

// Finds the rows that have left; sorts the others into lanes.
Lanes sort_into_lanes(const Fluid& fluid, const Carpet& carpet, Places& places, LeftRows& left)
{
    const OpenSide& side = carpet.side;
    const real dp = fluid.parameters.spacing;
    Lanes lanes{std::vector<std::vector<Vec3>>(at(side.lanes())),
                std::vector<real>(at(side.lanes()), infinity)};
    for (const NearRow& near : near_rows(fluid, carpet)) {
        const Vec3& p = near.place;
        const real s = side.distance(p);
        if (s < 0 && has_left(fluid, carpet, p, near.beside_body != 0)) {
            left.insert(near.name());
            continue;
        }
        if (s < 2 * dp) {
            places.add(p);
        }
        const int lane = side.lane(p);
        if (lane < 0 || lane >= side.lanes()) {
            continue;
        }
        if (s < 0) {
            lanes.own[at(lane)].push_back(p);
        } else if (p.z() < side.bed[at(lane)] + dp) {
            lanes.inside[at(lane)] = std::min(lanes.inside[at(lane)], s);
        }
    }
    return lanes;
}

void add_bodies(const Fluid& fluid, const Carpet& carpet, Places& places)
{
    const auto x = fluid.particles.body[field::position];
    const real far = (carpet.side.columns + 2) * fluid.parameters.spacing;
    for (Index row = 0; row < fluid.particles.body.size(); ++row) {
        const real s = carpet.side.distance(x[row]);
        if (s < fluid.parameters.spacing && s > -far) {
            places.add(x[row]);
        }
    }
}

// The rows of this rank among those that left, marked.
std::vector<std::uint8_t> own_marks(const Fluid& fluid, const LeftRows& left)
{
    const int rank = fluid.ghosts ? fluid.ghosts->comm.rank() : 0;
    std::vector<std::uint8_t> marks(at(fluid.particles.fluid.size()), 0);
    for (const auto& [of, row] : left) {
        if (of == rank) {
            marks[at(row)] = 1;
        }
    }
    return marks;
}

void record_dropped(const Fluid& fluid, const std::vector<std::uint8_t>& left, OpenBoundary& open)
{
    struct Dropped {
        Vec3 momentum{0, 0, 0}, force{0, 0, 0};
    };
    const Store& store = fluid.particles.fluid;
    const auto v = store[field::velocity];
    const bool viscous = store.has(field::viscous_force);
    std::vector<Dropped> own;
    for (Index row = 0; row < store.size(); ++row) {
        if (left[at(row)] != 0) {
            own.push_back({fluid.parameters.mass * v[row],
                           viscous ? Vec3(store[field::viscous_force][row]) : Vec3(0, 0, 0)});
        }
    }
    Vec3 momentum = Vec3::Zero();
    for (const Dropped& dropped : terms_of_all(fluid, std::move(own))) {
        momentum += dropped.momentum;
        open.dropped_force += dropped.force;
    }
    open.impulse -= momentum;
}

// Appends the new particles to the remaining rows; all on one rank, from which they migrate to
// their owners when lists are built.
void change_rows(Fluid& fluid, const std::vector<std::uint8_t>& left,
                 const std::vector<NewParticle>& made, OpenBoundary& open)
{
    const std::int64_t first_id = open.next_id;
    open.next_id += std::ssize(made);
    for (const NewParticle& particle : made) {
        open.impulse += fluid.parameters.mass * particle.velocity;
    }
    const bool holds = !fluid.ghosts || fluid.ghosts->comm.rank() == 0;
    const std::size_t added = holds ? made.size() : 0;
    Store& store = fluid.particles.fluid;
    std::vector<std::int32_t> from;
    for (Index row = 0; row < store.size(); ++row) {
        if (left[at(row)] == 0) {
            from.push_back(static_cast<std::int32_t>(row));
        }
    }
    const std::size_t kept = from.size();
    if (kept == left.size() && added == 0) {
        return;
    }
    from.resize(kept + added, -1);
    store.gather(from);
    for (std::size_t k = 0; k < added; ++k) {
        const std::size_t row = kept + k;
        store[field::position][row] = made[k].place;
        store[field::velocity][row] = made[k].velocity;
        store[field::density][row] = made[k].density;
        store.id()[row] = first_id + static_cast<std::int64_t>(k);
    }
}

} // namespace

void renew_carpets(Fluid& fluid, OpenBoundary& open)
{
    LeftRows left;
    std::vector<NewParticle> made;
    for (Carpet& carpet : open.carpets) {
        const real dp = fluid.parameters.spacing;
        Taken taken{Places(least_distance * dp), Places(least_from_body * dp)};
        const std::size_t gone = left.size();
        const Lanes lanes = sort_into_lanes(fluid, carpet, taken.water, left);
        add_bodies(fluid, carpet, taken.bodies);
        const std::size_t before = made.size();
        Emitter emitter(fluid, carpet, taken, made);
        for (int lane = 0; lane < carpet.side.lanes(); ++lane) {
            emitter.fill_lane(lane, lanes.own[at(lane)], lanes.inside[at(lane)]);
        }
        carpet.made += static_cast<std::int64_t>(made.size() - before);
        carpet.dropped += static_cast<std::int64_t>(left.size() - gone);
        carpet.moved = 0;
    }
    const std::vector<std::uint8_t> marks = own_marks(fluid, left);
    record_dropped(fluid, marks, open);
    change_rows(fluid, marks, made, open);
}

} // namespace hyoryu
