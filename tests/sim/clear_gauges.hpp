// SPDX-License-Identifier: MIT
// Gauges read in the clear way: every gauge looks at every particle, in the order of the tiles.
// What the readings of the program are held against, to the bit.
#pragma once

#include "hyoryu/fluid/sum_units.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace hyoryu::by_all_particles {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

inline Pair<real> pair_at(const Fluid& fluid, const Vec3& r)
{
    return fluid.kernel(Vec<real>{r.x(), r.y(), r.z()});
}

// From a particle, or its nearest image, to a place.
inline Vec3 way(const Fluid& fluid, const Vec3& from, const Vec3& to)
{
    return fluid.neighbours.fluid.lattice.shortest(to - from);
}

// Particles about a vertical line.
struct Column {
    std::vector<Index> fluid, wall, body; // rows of each store
    double top = -infinity;               // of the fluid [m]
    double bottom = infinity;
};

inline Column column_about(const Fluid& fluid, const Vec3& place)
{
    const auto rows_about = [&](const Store& store, const Tiles& tiles) {
        std::vector<Index> rows;
        for (const Index j : tiles.row) {
            const Vec3 r = way(fluid, store[field::position][j], place);
            if (std::hypot(r.x(), r.y()) < fluid.kernel.support) {
                rows.push_back(j);
            }
        }
        return rows;
    };
    const FluidNeighbours& n = fluid.neighbours;
    Column column{rows_about(fluid.particles.fluid, n.fluid),
                  rows_about(fluid.particles.wall, n.wall),
                  rows_about(fluid.particles.body, n.body)};
    const auto x = fluid.particles.fluid[field::position];
    for (const Index j : column.fluid) {
        column.top = std::max(column.top, x[j].z());
        column.bottom = std::min(column.bottom, x[j].z());
    }
    return column;
}

// Part of space about a point that particles fill: sum V W.
inline double filled(const Fluid& fluid, const Store& store, const std::vector<Index>& near,
                     const Vec3& point, double others = 0)
{
    const auto x = store[field::position];
    const auto V = store[field::volume];
    for (const Index j : near) {
        others += V[j] * pair_at(fluid, way(fluid, x[j], point)).w;
    }
    return others;
}

// Highest place of the vertical through (x, y) where fluid fills half of what solids leave, from
// above in steps of a quarter spacing, then by the line between two of them.
inline double elevation(const Fluid& fluid, const Vec3& place)
{
    constexpr double least_open = 0.2; // less is the inside of a solid
    const double step = fluid.parameters.spacing / 4;
    const Column column = column_about(fluid, place);
    double above = 0;
    for (double z = column.top + fluid.kernel.support; z > column.bottom - fluid.kernel.support;
         z -= step) {
        const Vec3 point{place.x(), place.y(), z};
        const Particles& p = fluid.particles;
        const double by_walls = filled(fluid, p.wall, column.wall, point);
        const double open = 1 - filled(fluid, p.body, column.body, point, by_walls);
        const double here =
            open > least_open ? filled(fluid, p.fluid, column.fluid, point) / open : 0;
        if (here >= 0.5) {
            return z + step * (here - 0.5) / (here - above);
        }
        above = here;
    }
    return nothing;
}

// Whether a particle lies behind the face of a sensor; a point has no face.
inline bool is_behind(const Fluid& fluid, const Gauge& gauge, const Vec3& particle)
{
    return gauge.type == GaugeType::pressure && gauge.area > 0 &&
           way(fluid, gauge.at, particle).dot(gauge.normal) < -0.5 * fluid.parameters.spacing;
}

// Kernel average about a place over the fluid that a gauge sees.
template <class T, class F>
T average(const Fluid& fluid, const Gauge& gauge, const Vec3& place, const T& zero, const T& dry,
          const F& value)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto V = fluid.particles.fluid[field::volume];
    const Rows rows = fluid.particles.fluid.rows();
    T weighted = zero;
    double weight = 0;
    for (Index j = rows.begin; j < rows.end; ++j) {
        const Vec3 r = way(fluid, x[at(j)], place);
        if (r.squaredNorm() < sq(fluid.kernel.support) && !is_behind(fluid, gauge, x[at(j)])) {
            const double w = V[at(j)] * pair_at(fluid, r).w;
            weighted += w * value(at(j));
            weight += w;
        }
    }
    return weight > 0 ? T(weighted / weight) : dry;
}

inline double front(const Fluid& fluid, int axis)
{
    const auto x = fluid.particles.fluid[field::position];
    const Rows rows = fluid.particles.fluid.rows();
    return largest(rows.begin, rows.end, -infinity, [&](Index i) { return x[at(i)][axis]; }) +
           fluid.parameters.spacing / 2;
}

// Points that stand for the face of a sensor: the middles of equal parts of a length, or a spiral
// of equal areas over a disc; not closer than half a spacing, which the kernel would not tell
// apart.
inline std::vector<Vec3> face_points(const Gauge& gauge, const Fluid& fluid)
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

inline double pressure(const Fluid& fluid, const Gauge& gauge)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto p = fluid.particles.fluid[field::pressure];
    const auto rho = fluid.particles.fluid[field::density];
    const Vec3& g = fluid.parameters.gravity;
    double total = 0;
    const std::vector<Vec3> points = face_points(gauge, fluid);
    for (const Vec3& point : points) {
        total += std::max(0.0, average(fluid, gauge, point, 0.0, 0.0, [&](std::size_t j) {
                              return p[j] + rho[j] * g.dot(point - x[j]);
                          }));
    }
    return total / static_cast<double>(points.size());
}

inline double flux(const Fluid& fluid, const Gauge& gauge)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto v = fluid.particles.fluid[field::velocity];
    const auto V = fluid.particles.fluid[field::volume];
    const double reach = 2 * fluid.parameters.spacing;
    const FixedUnit unit = sum_units(fluid.parameters).flux;
    const auto first = [&](const Vec3& place) {
        return fluid.period == Vec3(0, 0, 0) ? place
                                             : fluid.neighbours.fluid.lattice.wrapped(place);
    };
    const Vec3 place = first(gauge.at);
    FixedSum total;
    for (std::size_t i = 0; i < x.size(); ++i) {
        double hat = 0; // over 27 images, those of an axis without period being the same
        for (int image = 0; image < 27; ++image) {
            const Vec3 shift(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1);
            bool counts = true;
            for (int a = 0; a < 3; ++a) {
                counts = counts && (fluid.period[a] > 0 || shift[a] == 0);
            }
            const Vec3 own = first(x[i]) + shift.cwiseProduct(fluid.period);
            const double distance = gauge.normal.dot(own - place);
            const Vec3 foot = own - distance * gauge.normal;
            for (int a = 0; a < 3; ++a) {
                const bool across = std::abs(gauge.normal[a]) > 1 - 1e-12;
                const double from = foot[a] - fluid.domain_min[a];
                counts = counts &&
                         (fluid.period[a] == 0 || across || (from >= 0 && from < fluid.period[a]));
            }
            hat += counts ? std::max(0.0, 1 - std::abs(distance) / reach) / reach : 0;
        }
        total.add(V[i] * gauge.normal.dot(v[i]) * hat, unit);
    }
    return total.value(unit);
}

inline std::vector<double> read_fluid(const Fluid& fluid, const Gauge& gauge)
{
    const auto v = fluid.particles.fluid[field::velocity];
    switch (gauge.type) {
    case GaugeType::elevation:
        return {elevation(fluid, gauge.at)};
    case GaugeType::pressure:
        return {pressure(fluid, gauge)};
    case GaugeType::velocity: {
        const Vec3 mean =
            average(fluid, gauge, gauge.at, Vec3(Vec3::Zero()), Vec3(Vec3::Constant(nothing)),
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

/// Sum of the viscous forces on the particles of a body, or of wall -1 - target.
inline Vec3 viscous_force(const Fluid& fluid, int target)
{
    const FixedUnit unit = sum_units(fluid.parameters).force;
    std::array<FixedSum, 3> total;
    const Store& store = target >= 0 ? fluid.particles.body : fluid.particles.wall;
    for (Index k = 0; k < store.size(); ++k) {
        for (std::size_t axis = 0; axis < 3 && store.owner()[k] == target; ++axis) {
            total[axis].add(store[field::viscous_force][k][static_cast<Index>(axis)], unit);
        }
    }
    return {total[0].value(unit), total[1].value(unit), total[2].value(unit)};
}

} // namespace hyoryu::by_all_particles
