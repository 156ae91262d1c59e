// SPDX-License-Identifier: MIT
#include "hyoryu/sim/gauges.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

Pair<real> pair_at(const Fluid& fluid, const Vec3& r)
{
    return fluid.kernel(Vec<real>{r.x(), r.y(), r.z()});
}

// Fraction of space that fluid fills about a point: sum V W.
double filled(const Fluid& fluid, const std::vector<Index>& near, const Vec3& point)
{
    const auto x = fluid.particles[field::position];
    const auto V = fluid.particles[field::volume];
    double sum_ = 0;
    for (const Index j : near) {
        sum_ += V[at(j)] * pair_at(fluid, point - x[at(j)]).w;
    }
    return sum_;
}

// Highest place of the vertical through (x, y) that is half filled, from above in steps of a
// quarter spacing, then by the line between two of them.
double elevation(const Fluid& fluid, const Vec3& place)
{
    const auto x = fluid.particles[field::position];
    const Rows rows = fluid.particles.fluid();
    const double step = fluid.parameters.spacing / 4;
    std::vector<Index> near;
    double top = -infinity;
    double bottom = infinity;
    for (Index j = rows.begin; j < rows.end; ++j) {
        const Vec3 r = x[at(j)] - place;
        if (std::hypot(r.x(), r.y()) < fluid.kernel.support) {
            near.push_back(j);
            top = std::max(top, x[at(j)].z());
            bottom = std::min(bottom, x[at(j)].z());
        }
    }
    double above = 0;
    for (double z = top + fluid.kernel.support; z > bottom - fluid.kernel.support; z -= step) {
        const double here = filled(fluid, near, {place.x(), place.y(), z});
        if (here >= 0.5) {
            return z + step * (here - 0.5) / (here - above);
        }
        above = here;
    }
    return nothing;
}

// Kernel average over the fluid about a place.
template <class T, class F>
T average(const Fluid& fluid, const Vec3& place, const T& zero, const T& dry, const F& value)
{
    const auto x = fluid.particles[field::position];
    const auto V = fluid.particles[field::volume];
    const Rows rows = fluid.particles.fluid();
    T weighted = zero;
    double weight = 0;
    for (Index j = rows.begin; j < rows.end; ++j) {
        const Vec3 r = place - x[at(j)];
        if (r.squaredNorm() < sq(fluid.kernel.support)) {
            const double w = V[at(j)] * pair_at(fluid, r).w;
            weighted += w * value(at(j));
            weight += w;
        }
    }
    return weight > 0 ? T(weighted / weight) : dry;
}

double front(const Fluid& fluid, int axis)
{
    const auto x = fluid.particles[field::position];
    const Rows rows = fluid.particles.fluid();
    return largest(rows.begin, rows.end, -infinity, [&](Index i) { return x[at(i)][axis]; }) +
           fluid.parameters.spacing / 2;
}

Vec3 force_on(const Simulation& sim, const std::string& name)
{
    for (std::size_t b = 0; b < sim.scene.bodies.size(); ++b) {
        if (sim.scene.bodies[b].name == name) {
            return sim.loads.bodies[b].force;
        }
    }
    for (std::size_t w = 0; w < sim.scene.walls.size() && !sim.loads.walls.empty(); ++w) {
        if (sim.scene.walls[w].name == name) {
            return sim.loads.walls[w];
        }
    }
    return Vec3::Zero();
}

void read(const Simulation& sim, const Gauge& gauge, std::vector<double>& readings)
{
    const auto push = [&](const Vec3& v) { readings.insert(readings.end(), v.begin(), v.end()); };
    if (gauge.type == GaugeType::force) {
        push(force_on(sim, gauge.on));
        return;
    }
    const Fluid& fluid = *sim.fluid;
    const auto p = fluid.particles[field::pressure];
    const auto v = fluid.particles[field::velocity];
    switch (gauge.type) {
    case GaugeType::elevation:
        readings.push_back(elevation(fluid, gauge.at));
        break;
    case GaugeType::pressure:
        readings.push_back(
            average(fluid, gauge.at, 0.0, nothing, [&](std::size_t j) { return p[j]; }));
        break;
    case GaugeType::velocity:
        push(average(fluid, gauge.at, Vec3(Vec3::Zero()), Vec3(Vec3::Constant(nothing)),
                     [&](std::size_t j) { return v[j]; }));
        break;
    case GaugeType::front:
        readings.push_back(front(fluid, gauge.axis));
        break;
    case GaugeType::force:
        break;
    }
}

} // namespace

std::vector<Table::Head> gauge_heads(const Scene& scene)
{
    std::vector<Table::Head> heads;
    const std::string newton = scene.dimensions == 2 ? "N/m" : "N";
    for (const Gauge& gauge : scene.gauges) {
        const bool vector = gauge.type == GaugeType::velocity || gauge.type == GaugeType::force;
        const std::string unit = gauge.type == GaugeType::pressure   ? "Pa"
                                 : gauge.type == GaugeType::velocity ? "m/s"
                                 : gauge.type == GaugeType::force    ? newton
                                                                     : "m";
        if (!vector) {
            heads.push_back({gauge.name, unit});
            continue;
        }
        for (const char axis : {'x', 'y', 'z'}) {
            heads.push_back({gauge.name + "_" + axis, unit});
        }
    }
    return heads;
}

std::vector<double> read_gauges(const Simulation& sim)
{
    std::vector<double> readings;
    for (const Gauge& gauge : sim.scene.gauges) {
        read(sim, gauge, readings);
    }
    return readings;
}

} // namespace hyoryu
