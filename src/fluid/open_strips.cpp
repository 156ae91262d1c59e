// SPDX-License-Identifier: MIT
// Depth and velocity of the water in the strips before open sides.
#include "hyoryu/fluid/totals.hpp"

#include "carpet.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

real strip_weight(real distance, real spacing)
{
    const real a = strip_half * spacing;
    return std::max(real(0), 1 - std::abs(distance - a) / a);
}

namespace {

struct StripSums {
    real volume = 0, moved = 0; // of the water: sum of w V and of w V u
    real displaced = 0;         // sum of w V of what bodies displace
};

// Calls f(station, share) for the stations over which a particle in the window lies, whose cell is
// a cube of the spacing. By its middle alone the depth of a station would err by up to a part in
// the number of its lanes where the lattice of the water is not that of the lanes, and stations at
// rest would drive a flow between them.
void for_stations(const OpenSide& side, const Vec3& x, real spacing, const auto& f)
{
    const int own = side.lane(x);
    if (own < 0 || own >= side.lanes()) {
        return;
    }
    const int station = own / side.station_lanes;
    const int begin = station * side.station_lanes;
    const int end = std::min(begin + side.station_lanes, side.lanes());
    const real lanes = (x[1 - side.axis] - side.first) / side.lane_width;
    const real middle = lanes - std::floor(lanes) + static_cast<real>(own - begin);
    const real cell = spacing / side.lane_width;
    real share = 1;
    const auto give = [&](int beside, real beyond) {
        const int count = side.stations();
        const int other = side.repeats ? (beside + count) % count : beside;
        if (beyond > 0 && other >= 0 && other < count && side.open_lanes(other) > 0) {
            f(other, beyond / cell);
            share -= beyond / cell;
        }
    };
    if (!side.flat && side.stations() > 1) {
        give(station - 1, cell / 2 - middle);
        give(station + 1, middle + cell / 2 - static_cast<real>(end - begin));
    }
    f(station, share);
}

// The contribution of a particle to the sums of its station.
struct StripTerm {
    std::int64_t number = 0; // of the particle
    int station = 0;
    real volume = 0, moved = 0;
};

// The water in the strips of all stations, in the order of the rows.
std::vector<StripTerm> strip_terms(const Fluid& fluid, const Carpet& carpet)
{
    const OpenSide& side = carpet.side;
    const Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    const real dp = fluid.parameters.spacing;
    std::vector<StripTerm> own;
    for (std::size_t k = 0; k < carpet.near.size(); ++k) {
        const auto row = at(carpet.near[k]);
        const real s = side.distance(x[row]);
        const real w = s >= 0 ? strip_weight(s, dp) : 0;
        if (w > 0) {
            for_stations(side, x[row], dp, [&](int station, real share) {
                const real V = share * w * fluid.parameters.mass / rho[row];
                own.push_back({store.id()[row], station, V, V * side.into * v[row][side.axis]});
            });
        }
    }
    return terms_of_all(fluid, std::move(own));
}

std::vector<StripSums> strip_sums(const OpenSide& side, std::span<const StripTerm> terms)
{
    std::vector<StripSums> sums(at(side.stations()));
    for (const StripTerm& term : terms) {
        sums[at(term.station)].volume += term.volume;
        sums[at(term.station)].moved += term.moved;
    }
    return sums;
}

// Adds the volume that bodies displace to the strips: the level of water with a floating body is
// that with the submerged part of the body replaced by water. The surface is given by the `depth`
// of the stations.
void add_displaced(const Fluid& fluid, const Carpet& carpet, std::vector<StripSums>& sums)
{
    const OpenSide& side = carpet.side;
    const Store& store = fluid.particles.body;
    const real dp = fluid.parameters.spacing;
    for (const std::int32_t row : carpet.near_bodies) {
        const Vec3& x = store[field::position][row];
        const real s = side.distance(x);
        const real w = s >= 0 ? strip_weight(s, dp) : 0;
        if (!(w > 0)) {
            continue;
        }
        for_stations(side, x, dp, [&](int c, real share) {
            const real surface = side.station_strip(c) + carpet.stations[at(c)].depth;
            const real wet = std::clamp((surface - x.z()) / dp + 0.5, real(0), real(1));
            sums[at(c)].displaced +=
                share * w * wet * store[field::displaced_mass][row] / fluid.parameters.eos.rho0;
        });
    }
}

// Area of a station seen from above, through which the strip is weighed [m2]; m in two dimensions.
real strip_area(const Fluid& fluid, const OpenSide& side, int station)
{
    return strip_half * fluid.parameters.spacing * side.open_width(station);
}

// What a station measures, without a filter.
struct Measured {
    real depth = 0, drift = 0; // [m], [m/s]
};

real drift_of(const StripSums& sums)
{
    return sums.volume > 0 ? sums.moved / sums.volume : 0;
}

Measured measured_without_walls(const StripSums& sums, real area)
{
    return {area > 0 ? (sums.volume + sums.displaced) / area : 0, drift_of(sums)};
}

// Stations whose water is measured together.
struct Pool {
    std::vector<int> stations;
    StripSums sums;
    real area = 0; // without walls [m2], [m]
};

// A level of a pool, and the space there for each metre of rise.
struct PoolLevel {
    real level = 0, area = 0;
};

// The level to which a volume fills the space of a pool; above the levels of the table the space
// goes on as it is at its top.
PoolLevel level_of(const OpenSide& side, const Pool& pool, real volume)
{
    const StripSpace& levels = side.space.front();
    const auto below = [&](std::size_t k) {
        real total = 0;
        for (const int c : pool.stations) {
            total += side.space[at(c)].below[k];
        }
        return total;
    };
    std::size_t low = 0;
    std::size_t high = levels.below.size() - 1;
    while (high - low > 1) { // the last interval that begins at less than the volume
        const std::size_t middle = (low + high) / 2;
        (below(middle) < volume ? low : high) = middle;
    }
    const real rise = below(high) - below(low);
    const real part = rise > 0 ? (volume - below(low)) / rise : 0;
    return {levels.low + (static_cast<real>(low) + part) * levels.step, rise / levels.step};
}

// The stations from -`reach` to +`reach` about one.
Pool pool_about(const Fluid& fluid, const OpenSide& side, std::span<const StripSums> sums, int c,
                int reach)
{
    Pool pool;
    const int count = side.stations();
    const bool all = 2 * reach + 1 >= count;
    for (int k = all ? 0 : c - reach; k <= (all ? count - 1 : c + reach); ++k) {
        const int m = side.repeats ? (k + count) % count : k;
        if (m >= 0 && m < count) {
            pool.stations.push_back(m);
            pool.sums.volume += sums[at(m)].volume;
            pool.sums.moved += sums[at(m)].moved;
            pool.sums.displaced += sums[at(m)].displaced;
            pool.area += strip_area(fluid, side, m);
        }
    }
    return pool;
}

// The measurement where walls stand in the strip. The level is that to which the water fills the
// space between them; where this is less than half of the strip, with its neighbours, since the
// fewer particles the greater their share in an error. The velocity is that of the same discharge
// through a section without walls, as at the plane.
Measured measured_beside_walls(const Fluid& fluid, const OpenSide& side,
                               std::span<const StripSums> sums, int c)
{
    const real half = strip_area(fluid, side, c) / 2;
    for (int reach = 0; half > 0; ++reach) {
        const Pool pool = pool_about(fluid, side, sums, c, reach);
        const real volume = pool.sums.volume + pool.sums.displaced;
        const PoolLevel found = level_of(side, pool, volume);
        if (found.area < half && std::ssize(pool.stations) < side.stations() &&
            reach < side.stations()) {
            continue;
        }
        const real depth = volume > 0 ? found.level - side.station_strip(c) : 0;
        const real open = depth * pool.area;
        const real share = open > volume ? volume / open : 1;
        return {depth, share * drift_of(pool.sums)};
    }
    return {};
}

Measured measured(const Fluid& fluid, const OpenSide& side, std::span<const StripSums> sums, int c)
{
    const bool has_wall = !side.space.empty() && side.space[at(c)].has_wall;
    return has_wall ? measured_beside_walls(fluid, side, sums, c)
                    : measured_without_walls(sums[at(c)], strip_area(fluid, side, c));
}

} // namespace

void measure_start(const Fluid& fluid, OpenBoundary& open)
{
    constexpr int turns = 4; // surface and displaced volume depend on each other
    for (Carpet& carpet : open.carpets) {
        // Sorted by particle number, since before the first lists the rows of ranks are not sorted
        // by tiles.
        std::vector<StripTerm> terms = strip_terms(fluid, carpet);
        std::ranges::sort(terms, {}, &StripTerm::number);
        for (int turn = 0; turn < turns; ++turn) {
            std::vector<StripSums> sums = strip_sums(carpet.side, terms);
            add_displaced(fluid, carpet, sums);
            for (int c = 0; c < carpet.side.stations(); ++c) {
                StationFlow& flow = carpet.stations[at(c)];
                const Measured now = measured(fluid, carpet.side, sums, c);
                flow.depth = now.depth;
                flow.drift = now.drift;
            }
        }
    }
}

void measure_strips(const Fluid& fluid, OpenBoundary& open, real dt)
{
    const real dp = fluid.parameters.spacing;
    for (Carpet& carpet : open.carpets) {
        std::vector<StripSums> sums = strip_sums(carpet.side, strip_terms(fluid, carpet));
        add_displaced(fluid, carpet, sums);
        for (int c = 0; c < carpet.side.stations(); ++c) {
            StationFlow& flow = carpet.stations[at(c)];
            const real tau = strip_half * dp /
                             std::sqrt(fluid.parameters.gravity.norm() * std::max(flow.depth, dp));
            const real share = -std::expm1(-dt / tau);
            const Measured now = measured(fluid, carpet.side, sums, c);
            flow.depth += share * (now.depth - flow.depth);
            flow.drift += share * (now.drift - flow.drift);
        }
    }
}

} // namespace hyoryu
