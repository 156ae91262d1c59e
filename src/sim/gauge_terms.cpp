// SPDX-License-Identifier: MIT
#include "gauge_terms.hpp"

#include "solid_places.hpp"

#include "hyoryu/fluid/sum_units.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyoryu {

namespace {

// Bounds of tiles at rest are in single precision: searches are extended by the rounding.
constexpr double wider = 1 + 1e-5;

// Least distance of an extent from bounds along each axis; below zero where they overlap.
Vec3 gap_between(const Fluid& fluid, const TileExtent& a, const TileExtent& b)
{
    return shortest_way(fluid, a.middle, b.middle).cwiseAbs() - a.half - b.half;
}

std::vector<FluidNear> fluid_of(const Fluid& fluid, const std::vector<Index>& rows)
{
    const Store& store = fluid.particles.fluid;
    std::vector<FluidNear> near;
    near.reserve(rows.size());
    for (const Index row : rows) {
        near.push_back({store[field::position][row], store[field::velocity][row],
                        store[field::volume][row], store[field::pressure][row],
                        store[field::density][row]});
    }
    return near;
}

std::vector<SolidNear> solids_of(const Store& store, const std::vector<Index>& rows)
{
    std::vector<SolidNear> near;
    near.reserve(rows.size());
    for (const Index row : rows) {
        near.push_back({store[field::position][row], store[field::volume][row]});
    }
    return near;
}

// Particles about a vertical line.
void add_column(const Fluid& fluid, const GaugeSearch& search, const Vec3& place, GaugeTerms& terms)
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
            const Vec3 r = shortest_way(fluid, x[row], place);
            return std::hypot(r.x(), r.y()) >= fluid.kernel.support;
        });
        return rows;
    };
    const Particles& p = fluid.particles;
    terms.fluid = fluid_of(fluid, rows_of(p.fluid, n.fluid, search.fluid));
    terms.wall = solids_of(p.wall, rows_of(p.wall, n.wall, search.wall));
    terms.body = solids_of(p.body, rows_of(p.body, n.body, search.body));
}

// The fluid about any point of bounds.
std::vector<FluidNear> fluid_about(const Fluid& fluid, const GaugeSearch& search,
                                   const Bounds& place)
{
    const double reach = wider * fluid.kernel.support;
    const auto near = [&](const TileExtent& extent) {
        return gap_between(fluid, extent, extent_of(place)).maxCoeff() < reach;
    };
    std::vector<Index> rows;
    append_rows_near(fluid.neighbours.fluid, search.fluid, fluid.particles.fluid[field::position],
                     near, rows);
    return fluid_of(fluid, rows);
}

// A sensor sees the fluid in front of its face, not that behind a thin wall; a face may lie half a
// spacing in front of the surface of its wall.
void leave_out_behind(const Fluid& fluid, const Gauge& gauge, std::vector<FluidNear>& near)
{
    const double behind = -0.5 * fluid.parameters.spacing;
    std::erase_if(near, [&](const FluidNear& particle) {
        return shortest_way(fluid, gauge.at, particle.place).dot(gauge.normal) < behind;
    });
}

double farthest(const GaugeSearch& search, int axis)
{
    double place = -infinity;
    for (const Bounds& group : search.fluid.group) {
        place = std::max(place, group.max[axis]);
    }
    return place;
}

// The image of a place in the first period.
Vec3 first_image(const Fluid& fluid, const Vec3& place)
{
    return fluid.period == Vec3(0, 0, 0) ? place
                                         : Vec3(fluid.neighbours.fluid.lattice.wrapped(place));
}

// How far images of a place lie along a normal from it; 0 alone without periodic sides [m].
std::vector<double> image_offsets(const Fluid& fluid, const Vec3& normal)
{
    std::vector<double> offsets{0};
    for (int axis = 0; axis < 3; ++axis) {
        const double period = fluid.period[axis];
        for (std::size_t k = period > 0 ? offsets.size() : 0; k-- > 0;) {
            offsets.push_back(offsets[k] - period * normal[axis]);
            offsets.push_back(offsets[k] + period * normal[axis]);
        }
    }
    return offsets;
}

// Whether a point of a plane belongs to the first period; a plane across an axis has one place
// there.
bool in_first_period(const Fluid& fluid, const Vec3& normal, const Vec3& point)
{
    constexpr double rounding = 1e-12;
    for (int axis = 0; axis < 3; ++axis) {
        const double from_low = point[axis] - fluid.domain_min[axis];
        if (fluid.period[axis] > 0 && std::abs(normal[axis]) < 1 - rounding &&
            !(from_low >= 0 && from_low < fluid.period[axis])) {
            return false;
        }
    }
    return true;
}

// The plane of the first period alone, seen by the particles and by their images.
FixedSum flux(const Fluid& fluid, const GaugeSearch& search, const Gauge& gauge)
{
    const auto x = fluid.particles.fluid[field::position];
    const auto v = fluid.particles.fluid[field::velocity];
    const auto V = fluid.particles.fluid[field::volume];
    const double reach = 2 * fluid.parameters.spacing;
    const Vec3 place = first_image(fluid, gauge.at);
    const std::vector<double> offsets = image_offsets(fluid, gauge.normal);
    const auto near = [&](const TileExtent& extent) {
        const double distance = gauge.normal.dot(extent.middle - place);
        const double half = gauge.normal.cwiseAbs().dot(extent.half);
        return std::ranges::any_of(offsets, [&](double offset) {
            return std::abs(distance + offset) - half < wider * reach;
        });
    };
    std::vector<Index> rows;
    append_rows_near(fluid.neighbours.fluid, search.fluid, x, near, rows);
    FixedSums<1> of_rows =
        sums_of_each<1>(static_cast<Index>(rows.size()), {sum_units(fluid.parameters).flux},
                        [&](Index k) -> std::array<double, 1> {
                            const Index i = rows[at(k)];
                            double hat = 0;
                            for_images(fluid, x[i], reach, [&](const Vec3& image) {
                                const double distance = gauge.normal.dot(image - place);
                                const Vec3 foot = image - distance * gauge.normal;
                                hat += in_first_period(fluid, gauge.normal, foot)
                                           ? std::max(0.0, 1 - std::abs(distance) / reach) / reach
                                           : 0;
                            });
                            return {V[i] * gauge.normal.dot(v[i]) * hat};
                        });
    return of_rows.each()[0];
}

} // namespace

Vec3 shortest_way(const Fluid& fluid, const Vec3& from, const Vec3& to)
{
    const TileLattice& lattice = fluid.neighbours.fluid.lattice;
    const bool repeats = (lattice.period[0] | lattice.period[1] | lattice.period[2]) != 0;
    return repeats ? lattice.shortest(to - from) : Vec3(to - from);
}

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

GaugeTerms terms_of(const Fluid& fluid, const GaugeSearch& search, const Gauge& gauge)
{
    GaugeTerms terms;
    switch (gauge.type) {
    case GaugeType::elevation:
        add_column(fluid, search, gauge.at, terms);
        break;
    case GaugeType::pressure: {
        Bounds face;
        for (const Vec3& point : face_points(gauge, fluid)) {
            face.add(point);
        }
        terms.fluid = fluid_about(fluid, search, face);
        if (gauge.area > 0) {
            leave_out_behind(fluid, gauge, terms.fluid);
        }
        break;
    }
    case GaugeType::velocity:
        terms.fluid = fluid_about(fluid, search, {gauge.at, gauge.at});
        break;
    case GaugeType::front:
        terms.farthest = farthest(search, gauge.axis);
        break;
    case GaugeType::flux:
        terms.flux = flux(fluid, search, gauge);
        break;
    case GaugeType::force:
        break;
    }
    return terms;
}

namespace {

void put_terms(Parcel& parcel, const GaugeTerms& terms)
{
    put_list(parcel, terms.fluid);
    put_list(parcel, terms.wall);
    put_list(parcel, terms.body);
    put(parcel, terms.farthest);
    put(parcel, terms.flux);
}

void append_terms(Unpacking& from, GaugeTerms& terms)
{
    take_more(from, terms.fluid);
    take_more(from, terms.wall);
    take_more(from, terms.body);
    terms.farthest = std::max(terms.farthest, from.take<double>());
    terms.flux.add(from.take<FixedSum>());
}

} // namespace

void gather_terms(Comm& comm, std::vector<GaugeTerms>& terms)
{
    std::vector<Parcel> out(at(comm.size()));
    for (const GaugeTerms& own : terms) {
        put_terms(out.front(), own);
    }
    const std::vector<Parcel> in = comm.exchange(std::move(out));
    terms.assign(terms.size(), {});
    for (const Parcel& parcel : in) {
        Unpacking from(parcel);
        for (std::size_t k = 0; k < terms.size() && !from.empty(); ++k) {
            append_terms(from, terms[k]);
        }
    }
}

} // namespace hyoryu
