// SPDX-License-Identifier: MIT
#include "gauge_readings.hpp"

#include "hyoryu/fluid/sum_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hyoryu {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// Bounds of tiles at rest are in single precision: searches are extended by the rounding.
constexpr double wider = 1 + 1e-5;

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
    const TileLattice& lattice = fluid.neighbours.fluid.lattice;
    const bool repeats = (lattice.period[0] | lattice.period[1] | lattice.period[2]) != 0;
    return repeats ? lattice.shortest(to - from) : Vec3(to - from);
}

// Least distance of an extent from bounds along each axis; below zero where they overlap.
Vec3 gap_between(const Fluid& fluid, const TileExtent& a, const TileExtent& b)
{
    return way(fluid, a.middle, b.middle).cwiseAbs() - a.half - b.half;
}

// Particles about a vertical line.
struct Column {
    std::vector<Index> fluid, wall, body; // rows of each store
    double top = -infinity;               // of the fluid [m]
    double bottom = infinity;
};

Column column_about(const Fluid& fluid, const GaugeSearch& search, const Vec3& place)
{
    const FluidNeighbours& n = fluid.neighbours;
    const double reach = wider * fluid.kernel.support;
    const auto near = [&](const TileExtent& extent) {
        const Vec3 gap = gap_between(fluid, extent, {place, Vec3::Zero()});
        return gap.x() < reach && gap.y() < reach;
    };
    const auto rows_of = [&](const Store& store, const Tiles& tiles, const TileBounds& bounds) {
        const auto x = store[field::position];
        std::vector<Index> rows;
        append_rows_near(tiles, bounds, x, near, rows);
        std::erase_if(rows, [&](Index row) {
            const Vec3 r = way(fluid, x[row], place);
            return std::hypot(r.x(), r.y()) >= fluid.kernel.support;
        });
        return rows;
    };
    Column column{rows_of(fluid.particles.fluid, n.fluid, search.fluid),
                  rows_of(fluid.particles.wall, n.wall, search.wall),
                  rows_of(fluid.particles.body, n.body, search.body)};
    const auto x = fluid.particles.fluid[field::position];
    for (const Index row : column.fluid) {
        column.top = std::max(column.top, x[row].z());
        column.bottom = std::min(column.bottom, x[row].z());
    }
    return column;
}

// Part of space about a point that particles of a store fill: sum V W, added to `others`.
double filled(const Fluid& fluid, const Store& store, const std::vector<Index>& near,
              const Vec3& point, double others = 0)
{
    const auto x = store[field::position];
    const auto V = store[field::volume];
    const double reach = wider * fluid.kernel.support;
    for (const Index j : near) {
        const Vec3 r = way(fluid, x[j], point);
        if (std::abs(r.z()) < reach) { // W is zero beyond
            others += V[j] * pair_at(fluid, r).w;
        }
    }
    return others;
}

double filled_by_solids(const Fluid& fluid, const Column& column, const Vec3& point)
{
    const double by_walls = filled(fluid, fluid.particles.wall, column.wall, point);
    return filled(fluid, fluid.particles.body, column.body, point, by_walls);
}

// Highest point on the vertical through (x, y) where fluid fills half of the space outside solids:
// a search from above in steps of a quarter spacing, then linear interpolation.
double elevation(const Fluid& fluid, const GaugeSearch& search, const Vec3& place)
{
    constexpr double least_open = 0.2; // less is the inside of a solid
    const double step = fluid.parameters.spacing / 4;
    const Column column = column_about(fluid, search, place);
    double above = 0;
    for (double z = column.top + fluid.kernel.support; z > column.bottom - fluid.kernel.support;
         z -= step) {
        const Vec3 point{place.x(), place.y(), z};
        const double wet = filled(fluid, fluid.particles.fluid, column.fluid, point);
        const double open = wet > 0 ? 1 - filled_by_solids(fluid, column, point) : 1;
        const double here = open > least_open ? wet / open : 0;
        if (here >= 0.5) {
            return z + step * (here - 0.5) / (here - above);
        }
        above = here;
    }
    return nothing;
}

// Rows of the fluid about any point of bounds.
std::vector<Index> fluid_about(const Fluid& fluid, const GaugeSearch& search, const Bounds& place)
{
    const double reach = wider * fluid.kernel.support;
    const auto near = [&](const TileExtent& extent) {
        return gap_between(fluid, extent, extent_of(place)).maxCoeff() < reach;
    };
    std::vector<Index> rows;
    append_rows_near(fluid.neighbours.fluid, search.fluid, fluid.particles.fluid[field::position],
                     near, rows);
    return rows;
}

// Kernel average over the fluid about a place; `rows` are those that may be near.
template <class T, class F>
T average(const Fluid& fluid, const std::vector<Index>& rows, const Vec3& place, const T& zero,
          const T& dry, const F& value)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto V = fluid.particles.fluid[field::volume];
    T weighted = zero;
    double weight = 0;
    for (const Index j : rows) {
        const Vec3 r = way(fluid, x[j], place);
        if (r.squaredNorm() < sq(fluid.kernel.support)) {
            const double w = V[j] * pair_at(fluid, r).w;
            weighted += w * value(at(j));
            weight += w;
        }
    }
    return weight > 0 ? T(weighted / weight) : dry;
}

double front(const Fluid& fluid, const GaugeSearch& search, int axis)
{
    double farthest = -infinity;
    for (const Bounds& group : search.fluid.group) {
        farthest = std::max(farthest, group.max[axis]);
    }
    return farthest + fluid.parameters.spacing / 2;
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

double pressure(const Fluid& fluid, const GaugeSearch& search, const Gauge& gauge)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto p = fluid.particles.fluid[field::pressure];
    const auto rho = fluid.particles.fluid[field::density];
    const Vec3& g = fluid.parameters.gravity;
    const std::vector<Vec3> points = face_points(gauge, fluid);
    Bounds face;
    for (const Vec3& point : points) {
        face.add(point);
    }
    const std::vector<Index> rows = fluid_about(fluid, search, face);
    double total = 0;
    for (const Vec3& point : points) {
        total += std::max(0.0, average(fluid, rows, point, 0.0, 0.0, [&](std::size_t j) {
                              return p[j] + rho[j] * g.dot(point - x[j]);
                          }));
    }
    return total / static_cast<double>(points.size());
}

Vec3 velocity(const Fluid& fluid, const GaugeSearch& search, const Vec3& place)
{
    const auto v = fluid.particles.fluid[field::velocity];
    return average(fluid, fluid_about(fluid, search, {place, place}), place, Vec3(Vec3::Zero()),
                   Vec3(Vec3::Constant(nothing)), [&](std::size_t j) { return v[j]; });
}

double flux(const Fluid& fluid, const GaugeSearch& search, const Gauge& gauge)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto v = fluid.particles.fluid[field::velocity];
    const auto V = fluid.particles.fluid[field::volume];
    const double reach = 2 * fluid.parameters.spacing;
    const auto near = [&](const TileExtent& extent) {
        const double distance = std::abs(gauge.normal.dot(extent.middle - gauge.at));
        return distance - gauge.normal.cwiseAbs().dot(extent.half) < wider * reach;
    };
    std::vector<Index> rows;
    append_rows_near(fluid.neighbours.fluid, search.fluid, x, near, rows);
    const auto of_rows =
        sum_of_each<1>(static_cast<Index>(rows.size()), {sum_units(fluid.parameters).flux},
                       [&](Index k) -> std::array<double, 1> {
                           const Index i = rows[at(k)];
                           const double distance = std::abs(gauge.normal.dot(x[i] - gauge.at));
                           const double hat = std::max(0.0, 1 - distance / reach) / reach;
                           return {V[i] * gauge.normal.dot(v[i]) * hat};
                       });
    return of_rows[0];
}

} // namespace

GaugeSearch make_gauge_search(const Fluid& fluid, const std::vector<Gauge>& gauges)
{
    const auto has = [&](const auto& test) { return std::ranges::any_of(gauges, test); };
    const FluidNeighbours& n = fluid.neighbours;
    const Particles& particles = fluid.particles;
    GaugeSearch search;
    if (has([](const Gauge& gauge) { return gauge.type != GaugeType::force; })) {
        search.fluid = measure_bounds(n.fluid, particles.fluid[field::position]);
    }
    if (has([](const Gauge& gauge) { return gauge.type == GaugeType::elevation; })) {
        search.wall = fluid.moving_walls ? measure_bounds(n.wall, particles.wall[field::position])
                                         : sorted_bounds(n.wall);
        search.body = measure_bounds(n.body, particles.body[field::position]);
    }
    return search;
}

std::vector<double> read_fluid(const Fluid& fluid, const GaugeSearch& search, const Gauge& gauge)
{
    switch (gauge.type) {
    case GaugeType::elevation:
        return {elevation(fluid, search, gauge.at)};
    case GaugeType::pressure:
        return {pressure(fluid, search, gauge)};
    case GaugeType::velocity: {
        const Vec3 mean = velocity(fluid, search, gauge.at);
        return {mean.x(), mean.y(), mean.z()};
    }
    case GaugeType::front:
        return {front(fluid, search, gauge.axis)};
    case GaugeType::flux:
        return {flux(fluid, search, gauge)};
    case GaugeType::force:
        break;
    }
    return {};
}

} // namespace hyoryu
