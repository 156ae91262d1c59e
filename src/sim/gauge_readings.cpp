// SPDX-License-Identifier: MIT
#include "gauge_readings.hpp"

#include "hyoryu/fluid/sum_units.hpp"

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

Pair<real> pair_at(const Fluid& fluid, const Vec3& r)
{
    return fluid.kernel(Vec<real>{r.x(), r.y(), r.z()});
}

// Part of space about a point that particles fill: sum V W, added to `others`.
template <class Near>
double filled(const Fluid& fluid, const std::vector<Near>& particles, const Vec3& point,
              double others = 0)
{
    const double reach = fluid.kernel.support;
    for (const Near& particle : particles) {
        const Vec3 r = shortest_way(fluid, particle.place, point);
        if (std::abs(r.z()) < reach) { // W is zero beyond
            others += particle.volume * pair_at(fluid, r).w;
        }
    }
    return others;
}

// Highest point on the vertical through (x, y) where fluid fills half of the space outside solids:
// a search from above in steps of a quarter spacing, then linear interpolation.
double elevation(const Fluid& fluid, const GaugeTerms& column, const Vec3& place)
{
    constexpr double least_open = 0.2; // less is the inside of a solid
    const double step = fluid.parameters.spacing / 4;
    double top = -infinity;
    double bottom = infinity;
    for (const FluidNear& particle : column.fluid) {
        top = std::max(top, particle.place.z());
        bottom = std::min(bottom, particle.place.z());
    }
    double above = 0;
    for (double z = top + fluid.kernel.support; z > bottom - fluid.kernel.support; z -= step) {
        const Vec3 point{place.x(), place.y(), z};
        const double wet = filled(fluid, column.fluid, point);
        const double solid =
            wet > 0 ? filled(fluid, column.body, point, filled(fluid, column.wall, point)) : 0;
        const double open = 1 - solid;
        const double here = open > least_open ? wet / open : 0;
        if (here >= 0.5) {
            return z + step * (here - 0.5) / (here - above);
        }
        above = here;
    }
    return not_a_number;
}

// Kernel average of value(particle) over the fluid about a place.
template <class T, class F>
T average(const Fluid& fluid, const std::vector<FluidNear>& particles, const Vec3& place,
          const T& zero, const T& dry, const F& value)
{
    T weighted = zero;
    double weight = 0;
    for (const FluidNear& particle : particles) {
        const Vec3 r = shortest_way(fluid, particle.place, place);
        if (r.squaredNorm() < sq(fluid.kernel.support)) {
            const double w = particle.volume * pair_at(fluid, r).w;
            weighted += w * value(particle);
            weight += w;
        }
    }
    return weight > 0 ? T(weighted / weight) : dry;
}

double pressure(const Fluid& fluid, const GaugeTerms& terms, const Gauge& gauge)
{
    const Vec3& g = fluid.parameters.gravity;
    const std::vector<Vec3> points = face_points(gauge, fluid);
    double total = 0;
    for (const Vec3& point : points) {
        total += std::max(
            0.0, average(fluid, terms.fluid, point, 0.0, 0.0, [&](const FluidNear& particle) {
                return particle.pressure + particle.density * g.dot(point - particle.place);
            }));
    }
    return total / static_cast<double>(points.size());
}

Vec3 velocity(const Fluid& fluid, const GaugeTerms& terms, const Vec3& place)
{
    return average(fluid, terms.fluid, place, Vec3(Vec3::Zero()),
                   Vec3(Vec3::Constant(not_a_number)),
                   [](const FluidNear& particle) { return particle.velocity; });
}

} // namespace

std::vector<double> read_fluid(const Fluid& fluid, const GaugeTerms& terms, const Gauge& gauge)
{
    switch (gauge.type) {
    case GaugeType::elevation:
        return {elevation(fluid, terms, gauge.at)};
    case GaugeType::pressure:
        return {pressure(fluid, terms, gauge)};
    case GaugeType::velocity: {
        const Vec3 mean = velocity(fluid, terms, gauge.at);
        return {mean.x(), mean.y(), mean.z()};
    }
    case GaugeType::front:
        return {terms.farthest + fluid.parameters.spacing / 2};
    case GaugeType::flux:
        return {terms.flux.value(sum_units(fluid.parameters).flux)};
    case GaugeType::force:
        break;
    }
    return {};
}

} // namespace hyoryu
