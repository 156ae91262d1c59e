// SPDX-License-Identifier: MIT
// Depth and velocity of the water in the strips before open sides.
#include "hyoryu/fluid/totals.hpp"

#include "carpet.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// Hat function of the strip: the sum over a lattice gives the depth independent of its phase.
real strip_weight(real s, real spacing)
{
    const real a = strip_half * spacing;
    return std::max(real(0), 1 - std::abs(s - a) / a);
}

struct StripSums {
    real volume = 0, moved = 0; // of the water: sum of w V and of w V u
    real displaced = 0;         // sum of w V of what bodies displace
};

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
        const int lane = side.lane(x[row], dp);
        if (w > 0 && lane >= 0 && lane < side.lanes()) {
            const real V = w * fluid.parameters.mass / rho[row];
            own.push_back(
                {store.id()[row], lane / side.station_lanes, V, V * side.into * v[row][side.axis]});
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
        const int lane = side.lane(x, dp);
        if (w > 0 && lane >= 0 && lane < side.lanes()) {
            const int c = lane / side.station_lanes;
            const real surface = side.station_strip(c) + carpet.stations[at(c)].depth;
            const real wet = std::clamp((surface - x.z()) / dp + 0.5, real(0), real(1));
            sums[at(c)].displaced +=
                w * wet * store[field::displaced_mass][row] / fluid.parameters.eos.rho0;
        }
    }
}

// Area of a station seen from above, through which the strip is weighed [m2]; m in two dimensions.
real strip_area(const Fluid& fluid, const OpenSide& side, int station)
{
    const real dp = fluid.parameters.spacing;
    const real width =
        fluid.parameters.dimensions == 2 ? 1 : static_cast<real>(side.open_lanes(station)) * dp;
    return strip_half * dp * width;
}

real depth_of(const StripSums& sums, real area)
{
    return area > 0 ? (sums.volume + sums.displaced) / area : 0;
}

real drift_of(const StripSums& sums)
{
    return sums.volume > 0 ? sums.moved / sums.volume : 0;
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
                flow.depth = depth_of(sums[at(c)], strip_area(fluid, carpet.side, c));
                flow.drift = drift_of(sums[at(c)]);
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
            const real depth = depth_of(sums[at(c)], strip_area(fluid, carpet.side, c));
            flow.depth += share * (depth - flow.depth);
            flow.drift += share * (drift_of(sums[at(c)]) - flow.drift);
        }
    }
}

} // namespace hyoryu
