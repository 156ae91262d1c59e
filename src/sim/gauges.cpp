// SPDX-License-Identifier: MIT
#include "hyoryu/sim/gauges.hpp"

#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

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

// From a particle, or its nearest image, to a place.
Vec3 way(const Fluid& fluid, const Vec3& from, const Vec3& to)
{
    return fluid.neighbours.fluid.lattice.shortest(to - from);
}

// Particles about a vertical line.
struct Column {
    std::vector<Index> fluid, solid;
    double top = -infinity; // of the fluid [m]
    double bottom = infinity;
};

Column column_about(const Fluid& fluid, const Vec3& place)
{
    const auto x = fluid.particles[field::position];
    const Index fluid_rows = fluid.particles.fluid().end;
    Column column;
    for (Index j = 0; j < fluid.particles.size(); ++j) {
        const Vec3 r = way(fluid, x[at(j)], place);
        if (std::hypot(r.x(), r.y()) >= fluid.kernel.support) {
            continue;
        }
        if (j >= fluid_rows) {
            column.solid.push_back(j);
            continue;
        }
        column.fluid.push_back(j);
        column.top = std::max(column.top, x[at(j)].z());
        column.bottom = std::min(column.bottom, x[at(j)].z());
    }
    return column;
}

// Part of space about a point that particles fill: sum V W.
double filled(const Fluid& fluid, const std::vector<Index>& near, const Vec3& point)
{
    const auto x = fluid.particles[field::position];
    const auto V = fluid.particles[field::volume];
    double sum_ = 0;
    for (const Index j : near) {
        sum_ += V[at(j)] * pair_at(fluid, way(fluid, x[at(j)], point)).w;
    }
    return sum_;
}

// Highest place of the vertical through (x, y) where fluid fills half of what solids leave, from
// above in steps of a quarter spacing, then by the line between two of them.
double elevation(const Fluid& fluid, const Vec3& place)
{
    constexpr double least_open = 0.2; // less is the inside of a solid
    const double step = fluid.parameters.spacing / 4;
    const Column column = column_about(fluid, place);
    double above = 0;
    for (double z = column.top + fluid.kernel.support; z > column.bottom - fluid.kernel.support;
         z -= step) {
        const Vec3 point{place.x(), place.y(), z};
        const double open = 1 - filled(fluid, column.solid, point);
        const double here = open > least_open ? filled(fluid, column.fluid, point) / open : 0;
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
        const Vec3 r = way(fluid, x[at(j)], place);
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

// Points that stand for the face of a sensor: the middles of equal parts of a length, or a spiral
// of equal areas over a disc; not closer than half a spacing, which the kernel would not tell
// apart.
std::vector<Vec3> face_points(const Gauge& gauge, const Fluid& fluid)
{
    constexpr double most = 64;
    const double cell = fluid.parameters.spacing / 2;
    const int d = fluid.parameters.dimensions;
    const double cells = gauge.area / (d == 2 ? cell : sq(cell));
    const auto n = static_cast<int>(std::clamp(std::ceil(cells), 1.0, most));
    const Vec3 t = d == 2 ? Vec3(Vec3::UnitY().cross(gauge.normal)) : gauge.normal.unitOrthogonal();
    const Vec3 s = gauge.normal.cross(t);
    const double radius = std::sqrt(gauge.area / std::numbers::pi);
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    std::vector<Vec3> points;
    for (int k = 0; k < n; ++k) {
        const double part = (k + 0.5) / n;
        const double r = radius * std::sqrt(part);
        points.push_back(gauge.at + (d == 2 ? Vec3(gauge.area * (part - 0.5) * t)
                                            : Vec3(r * std::cos(golden * k) * t +
                                                   r * std::sin(golden * k) * s)));
    }
    return points;
}

double pressure(const Fluid& fluid, const Gauge& gauge)
{
    const auto x = fluid.particles[field::position];
    const auto p = fluid.particles[field::pressure];
    const auto rho = fluid.particles[field::density];
    const Vec3& g = fluid.parameters.gravity;
    double total = 0;
    const std::vector<Vec3> points = face_points(gauge, fluid);
    for (const Vec3& point : points) {
        total += std::max(0.0, average(fluid, point, 0.0, 0.0, [&](std::size_t j) {
                              return p[j] + rho[j] * g.dot(point - x[j]);
                          }));
    }
    return total / static_cast<double>(points.size());
}

double flux(const Fluid& fluid, const Gauge& gauge)
{
    const auto x = fluid.particles[field::position];
    const auto v = fluid.particles[field::velocity];
    const auto V = fluid.particles[field::volume];
    const Rows rows = fluid.particles.fluid();
    const double reach = 2 * fluid.parameters.spacing;
    return sum(rows.begin, rows.end, 0.0, [&](Index i) {
        const double distance = std::abs(gauge.normal.dot(x[at(i)] - gauge.at));
        const double hat = std::max(0.0, 1 - distance / reach) / reach;
        return V[at(i)] * gauge.normal.dot(v[at(i)]) * hat;
    });
}

void push(std::vector<double>& readings, const Vec3& v)
{
    readings.insert(readings.end(), v.begin(), v.end());
}

void read_force(const Simulation& sim, const GaugedForce& force, std::vector<double>& readings)
{
    const double span = sim.clock.time - sim.gauges.last_row;
    const Vec3 gained = force.contact_impulse - force.contact_at_row;
    push(readings, force.pressure + force.viscous);
    push(readings, force.pressure);
    push(readings, force.viscous);
    push(readings, span > 0 ? Vec3(gained / span) : Vec3(Vec3::Zero()));
    push(readings, force.fluid_impulse);
    push(readings, force.contact_impulse);
}

std::vector<double> read_fluid(const Fluid& fluid, const Gauge& gauge)
{
    const auto v = fluid.particles[field::velocity];
    switch (gauge.type) {
    case GaugeType::elevation:
        return {elevation(fluid, gauge.at)};
    case GaugeType::pressure:
        return {pressure(fluid, gauge)};
    case GaugeType::velocity: {
        const Vec3 mean =
            average(fluid, gauge.at, Vec3(Vec3::Zero()), Vec3(Vec3::Constant(nothing)),
                    [&](std::size_t j) { return v[j]; });
        return {mean.x(), mean.y(), mean.z()};
    }
    case GaugeType::front:
        return {front(fluid, gauge.axis)};
    case GaugeType::flux:
        return {flux(fluid, gauge)};
    case GaugeType::force:
        break;
    }
    return {};
}

} // namespace

std::vector<Table::Head> gauge_heads(const Scene& scene)
{
    std::vector<Table::Head> heads;
    for (const Gauge& gauge : scene.gauges) {
        const std::vector<Table::Head> own = gauge_columns(gauge, scene.dimensions);
        heads.insert(heads.end(), own.begin(), own.end());
    }
    return heads;
}

std::vector<double> read_gauges(const Simulation& sim)
{
    // A gauge looks at every particle: gauges side by side, each written by one thread.
    const std::vector<Gauge>& gauges = sim.scene.gauges;
    std::vector<std::vector<double>> of_fluid(gauges.size());
    if (sim.fluid) {
        parallel_blocks(
            0, static_cast<Index>(gauges.size()),
            [&](Index k) { of_fluid[at(k)] = read_fluid(*sim.fluid, gauges[at(k)]); }, 2);
    }
    std::vector<double> readings;
    auto force = sim.gauges.forces.begin();
    for (std::size_t k = 0; k < gauges.size(); ++k) {
        if (gauges[k].type == GaugeType::force) {
            read_force(sim, *force++, readings);
        } else {
            readings.insert(readings.end(), of_fluid[k].begin(), of_fluid[k].end());
        }
    }
    return readings;
}

} // namespace hyoryu
