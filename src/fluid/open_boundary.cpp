// SPDX-License-Identifier: MIT
// Open boundaries: the flow at the plane from the Riemann invariants, and the state of the carpet
// particles.
#include "hyoryu/fluid/totals.hpp"

#include "carpet.hpp"
#include "places.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

int least_carpet_columns(real smoothing_ratio)
{
    constexpr int spare = 3;
    return static_cast<int>(std::ceil(2 * smoothing_ratio - 1e-9)) + spare;
}

int OpenSide::lane(const Vec3& x) const
{
    if (flat) {
        return 0;
    }
    const auto k = static_cast<int>(std::floor((x[1 - axis] - first) / lane_width));
    return repeats ? (k % lanes() + lanes()) % lanes() : k;
}

namespace {

// The open lanes of a station at a level, and the sum of a ground over them.
struct OpenLanes {
    int count = 0;
    real ground = 0;
    real mean() const { return count > 0 ? ground / count : infinity; }
};

OpenLanes open_at(const OpenSide& side, const std::vector<real>& ground, int station, real level)
{
    const int begin = station * side.station_lanes;
    const int end = std::min(begin + side.station_lanes, side.lanes());
    OpenLanes open;
    for (int lane = begin; lane < end; ++lane) {
        if (side.is_open(lane, level)) {
            ++open.count;
            open.ground += ground[at(lane)];
        }
    }
    return open.count > 0 || level == infinity ? open : open_at(side, ground, station, infinity);
}

} // namespace

int OpenSide::open_lanes(int station, real level) const
{
    return open_at(*this, bed, station, level).count;
}

real OpenSide::station_bed(int station, real level) const
{
    return open_at(*this, bed, station, level).mean();
}

real OpenSide::station_strip(int station) const
{
    return open_at(*this, strip, station, -infinity).mean();
}

namespace {

// The flow at a prescribed discharge: inflow is at least as deep as the critical depth.
StationFlow with_discharge(StationFlow flow, real q, const StationGround& ground, real gravity)
{
    const real inside = std::max(flow.depth + ground.strip - ground.bed, real(0));
    const real critical = std::cbrt(sq(q) / gravity);
    const real depth = std::max(inside, critical);
    flow.velocity = depth > 0 ? q / depth : 0;
    flow.velocity = std::max(flow.velocity, -std::sqrt(gravity * inside)); // limit of the outflow
    flow.level = ground.bed + (q > 0 ? depth : inside);
    return flow;
}

// u_n from the incoming invariant, u + 2 sqrt(g h) = `invariant`, and the depth inside. If the
// depth is so small that the outgoing wave would not reach the plane, the flow there is critical: h
// is at least (R/3)^2/g. Outflow is at most critical, as no wave from outside accelerates it.
StationFlow with_invariant(StationFlow flow, real invariant, const StationGround& ground,
                           real gravity)
{
    const real inside = std::max(flow.depth + ground.strip - ground.bed, real(0));
    const real least = invariant > 0 ? sq(invariant) / (9 * gravity) : 0;
    const real depth = std::max(inside, least);
    const real wave = std::sqrt(gravity * depth);
    flow.velocity = std::max(invariant - 2 * wave, -wave);
    flow.level = ground.bed + depth;
    return flow;
}

} // namespace

StationFlow flow_at(const AskedFlow& asked, const StationFlow& before, const StationGround& ground,
                    real gravity)
{
    StationFlow flow = before;
    const real inside = std::max(flow.depth, real(0));
    const real wave = std::sqrt(gravity * inside);
    flow.passes = inside > 0 && flow.drift < -wave;
    if (asked.free) {
        flow.velocity = std::min(flow.drift, real(0));
        flow.level = ground.strip + inside;
        return flow;
    }
    if (asked.discharge) {
        return with_discharge(flow, *asked.discharge, ground, gravity);
    }
    const real depth = std::max(asked.level.value_or(ground.bed) - ground.bed, real(0));
    const real fastest = std::sqrt(gravity * depth);
    const real u =
        asked.velocity ? *asked.velocity : 2 * fastest - 2 * std::sqrt(gravity * asked.still);
    if (u > fastest) { // supercritical inflow: nothing from inside counts
        flow.velocity = u;
        flow.level = ground.bed + depth;
        flow.passes = false;
        return flow;
    }
    return with_invariant(flow, u + 2 * fastest, ground, gravity);
}

namespace {

bool in_reach(const OpenSide& side, const Vec3& x, real outward, real inward)
{
    const real s = side.distance(x);
    const int lane = side.lane(x);
    return s > -outward && s < inward && lane >= -2 && lane <= side.lanes() + 1;
}

real outer_reach(const OpenSide& side, real spacing)
{
    return (side.columns + 3) * spacing;
}

} // namespace

bool is_behind(const OpenBoundary& open, const Vec3& x)
{
    return std::ranges::any_of(open.carpets, [&](const Carpet& carpet) {
        const int lane = carpet.side.lane(x);
        return carpet.side.distance(x) < 0 && lane >= -2 && lane <= carpet.side.lanes() + 1;
    });
}

void find_rows(const Fluid& fluid, OpenBoundary& open)
{
    const FluidParameters& f = fluid.parameters;
    const auto x = fluid.particles.fluid[field::position];
    // Between two rebuilds no particle moves farther than the support.
    const real inward = 2 * strip_half * f.spacing + fluid.kernel.support;
    for (Carpet& carpet : open.carpets) {
        carpet.near.clear();
        for (Index row = 0; row < fluid.particles.fluid.size(); ++row) {
            if (in_reach(carpet.side, x[row], outer_reach(carpet.side, f.spacing), inward)) {
                carpet.near.push_back(static_cast<std::int32_t>(row));
            }
        }
        carpet.behind.resize(carpet.near.size());
        for (std::size_t k = 0; k < carpet.near.size(); ++k) {
            carpet.behind[k] = carpet.side.distance(x[carpet.near[k]]) < 0 ? 1 : 0;
        }
    }
}

void mark_beside_bodies(const Fluid& fluid, OpenBoundary& open)
{
    constexpr int kept = 4; // columns
    const real dp = fluid.parameters.spacing;
    const real reach = fluid.kernel.support;
    const auto x = fluid.particles.fluid[field::position];
    const auto solid = fluid.particles.body[field::position];
    for (Carpet& carpet : open.carpets) {
        carpet.beside_body.clear();
        carpet.near_bodies.clear();
        real farthest = infinity; // of a body particle, along the way into the domain
        for (Index row = 0; row < fluid.particles.body.size(); ++row) {
            if (in_reach(carpet.side, solid[row], outer_reach(carpet.side, dp),
                         2 * strip_half * dp + reach)) {
                carpet.near_bodies.push_back(static_cast<std::int32_t>(row));
                farthest = std::min(farthest, carpet.side.distance(solid[row]));
            }
        }
        if (!(farthest < reach)) {
            continue;
        }
        Places bodies(reach);
        for (const std::int32_t row : carpet.near_bodies) {
            if (carpet.side.distance(solid[row]) < reach) {
                bodies.add(solid[row]);
            }
        }
        carpet.beside_body.resize(carpet.near.size());
        const real far = std::max((kept - carpet.side.columns) * dp, farthest - reach);
        for (std::size_t k = 0; k < carpet.near.size(); ++k) {
            const real s = carpet.side.distance(x[carpet.near[k]]);
            const bool near = s < 0 && s > far && !bodies.is_free(x[carpet.near[k]]);
            carpet.beside_body[k] = near ? 1 : 0;
        }
    }
}

void count_crossings(const Fluid& fluid, OpenBoundary& open)
{
    const FluidParameters& f = fluid.parameters;
    const Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const auto rho = store[field::density];
    struct Crossing {
        int inward = 0;
        real energy = 0; // carried in [J]
    };
    for (Carpet& carpet : open.carpets) {
        std::vector<Crossing> own;
        for (std::size_t k = 0; k < carpet.near.size(); ++k) {
            const auto row = at(carpet.near[k]);
            const std::uint8_t now = carpet.side.distance(x[row]) < 0 ? 1 : 0;
            if (now == carpet.behind[k]) {
                continue;
            }
            carpet.behind[k] = now;
            const real energy = f.mass * (0.5 * v[row].squaredNorm() - f.gravity.dot(x[row]) +
                                          std::max(f.eos.pressure(rho[row]), real(0)) / rho[row]);
            own.push_back(now == 0 ? Crossing{1, energy} : Crossing{0, -energy});
        }
        for (const Crossing& crossing : terms_of_all(fluid, std::move(own))) {
            (crossing.inward == 1 ? carpet.in : carpet.out) += 1;
            open.energy += crossing.energy;
        }
    }
}

bool carpets_due(const Fluid& fluid, const OpenBoundary& open)
{
    return std::ranges::any_of(open.carpets, [&](const Carpet& carpet) {
        return carpet.moved >= fluid.parameters.spacing / 2;
    });
}

real speed_at(const Carpet& carpet, const StationFlow& flow, real bed, real z)
{
    const real depth = flow.level - bed;
    if (!carpet.power_profile || !(depth > 0)) {
        return flow.velocity;
    }
    constexpr real p = 7;
    const real part = std::clamp((z - bed) / depth, real(0), real(1));
    return flow.velocity * (1 + 1 / p) * std::pow(part, 1 / p);
}

real density_at(const FluidParameters& f, real level, real z)
{
    const real below = std::max(level - z, real(0));
    return f.eos.rho0 * std::exp(f.gravity.norm() * below / sq(f.eos.c0));
}

const StationFlow& station_of(const Carpet& carpet, int lane)
{
    const int inside = std::clamp(lane, 0, carpet.side.lanes() - 1);
    return carpet.stations[at(inside / carpet.side.station_lanes)];
}

namespace {

// Calls f(k, row, lane) for the rows behind the plane, each the k-th of those near it.
void for_carpet(const Fluid& fluid, const Carpet& carpet, const auto& f)
{
    const auto x = fluid.particles.fluid[field::position];
    for (std::size_t k = 0; k < carpet.near.size(); ++k) {
        if (carpet.behind[k] != 0) {
            const auto row = at(carpet.near[k]);
            f(k, row, carpet.side.lane(x[row]));
        }
    }
}

} // namespace

void set_densities(Fluid& fluid, const OpenBoundary& open)
{
    Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto rho = store[field::density];
    for (const Carpet& carpet : open.carpets) {
        for_carpet(fluid, carpet, [&](std::size_t, std::size_t row, int lane) {
            rho[row] = density_at(fluid.parameters, station_of(carpet, lane).level, x[row].z());
            for_each(Fields<Gap, Cavity, Correction>{}, [&](auto field) {
                if (store.has(field)) {
                    store[field][row] = 0;
                }
            });
        });
    }
}

void keep_velocities(const Fluid& fluid, OpenBoundary& open)
{
    const auto v = fluid.particles.fluid[field::velocity];
    for (Carpet& carpet : open.carpets) {
        carpet.kept.clear();
        for_carpet(fluid, carpet,
                   [&](std::size_t, std::size_t row, int) { carpet.kept.push_back(v[row]); });
    }
}

void set_velocities(Fluid& fluid, OpenBoundary& open, real dt)
{
    Store& store = fluid.particles.fluid;
    const auto x = store[field::position];
    const auto v = store[field::velocity];
    const real dp = fluid.parameters.spacing;
    const real gravity = fluid.parameters.gravity.norm();
    Vec3 change = Vec3::Zero();
    for (Carpet& carpet : open.carpets) {
        const OpenSide& side = carpet.side;
        std::size_t next = 0;
        real fastest = 0;
        std::vector<Vec3> changes;
        for_carpet(fluid, carpet, [&](std::size_t k, std::size_t row, int lane) {
            const StationFlow& flow = station_of(carpet, lane);
            const Vec3& before = carpet.kept[next++];
            const real bed = side.bed[at(std::clamp(lane, 0, side.lanes() - 1))];
            const real u = speed_at(carpet, flow, bed, x[row].z());
            Vec3 set = flow.passes ? Vec3(before.x(), before.y(), 0) : Vec3(u * side.normal());
            if (carpet.is_beside_body(k)) {
                const real wave = std::sqrt(gravity * std::max(flow.depth, dp));
                set = v[row] - std::expm1(-dt * wave / (strip_half * dp)) * (set - v[row]);
            }
            changes.push_back(set - v[row]);
            v[row] = set;
            fastest = std::max(fastest, std::abs(set[side.axis]));
        });
        fastest = largest_of_all(fluid, fastest);
        for (const Vec3& one : terms_of_all(fluid, std::move(changes))) {
            change += one;
        }
        for (int c = 0; c < side.stations(); ++c) {
            const StationFlow& flow = carpet.stations[at(c)];
            const real width = side.open_width(c, flow.level);
            if (width > 0) {
                const real depth = std::max(flow.level - side.station_bed(c, flow.level), real(0));
                const bool wet = depth >= least_rows * dp || flow.velocity < 0;
                carpet.volume_asked += wet ? dt * depth * flow.velocity * width : 0;
                fastest = std::max(fastest, std::abs(flow.velocity));
            }
        }
        carpet.moved += dt * fastest;
    }
    open.impulse += fluid.parameters.mass * change - dt * open.dropped_force;
    open.dropped_force.setZero();
}

} // namespace hyoryu
