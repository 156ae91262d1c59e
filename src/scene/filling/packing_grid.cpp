// SPDX-License-Identifier: MIT
#include "packing_grid.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace hyoryu {

namespace {

// Sixteen lanes on every machine. The sums are integer sums, so that they do not depend on the
// number of lanes.
using Lanes = Pack<float, 64>;
constexpr Index lanes = Lanes::lanes;
using Whole = std::int32_t __attribute__((vector_size(64)));

// Cells of the grid along an axis that places within `reach` of one may be in.
struct Range {
    Index first = 0, last = 0;
};

Range cells_within(const PackingGrid& grid, std::size_t axis, std::int32_t place, double reach)
{
    const double from = static_cast<double>(place) - static_cast<double>(grid.origin[axis]);
    const double most = static_cast<double>(grid.count[axis]);
    const auto cell = [&](double distance) { // above zero, truncation is the floor
        return static_cast<Index>(std::clamp(distance * grid.inverse_edge[axis], 0.0, most));
    };
    return {cell(from - reach), cell(from + reach + grid.edge[axis])};
}

// From a place to the nearest point of a cell, along an axis [units].
double gap(const PackingGrid& grid, std::size_t axis, std::int32_t place, Index cell)
{
    const double from = static_cast<double>(place) - static_cast<double>(grid.origin[axis]);
    const double low = static_cast<double>(cell) * grid.edge[axis];
    return std::max({low - from, from - low - grid.edge[axis], 0.0});
}

// Calls f(begin, end) for the runs of points that hold all within the reach.
void over_runs(const PackingGrid& grid, const UnitPlace& place, double reach, const auto& f)
{
    const Range rows = cells_within(grid, 1, place[1], reach);
    const Range layers = cells_within(grid, 2, place[2], reach);
    for (Index layer = layers.first; layer < layers.last; ++layer) {
        const double left = sq(reach) - sq(gap(grid, 2, place[2], layer));
        for (Index row = rows.first; row < rows.last; ++row) {
            const double chord = left - sq(gap(grid, 1, place[1], row));
            if (chord < 0) {
                continue;
            }
            const Range cells = cells_within(grid, 0, place[0], std::sqrt(chord));
            const Index first = (layer * grid.count[1] + row) * grid.count[0];
            f(grid.start[at(first + cells.first)], grid.start[at(first + cells.last)]);
        }
    }
}

Lanes lengths(const std::vector<std::int32_t>& values, Index first, std::int32_t from,
              const PackingPressure& pressure)
{
    Whole its;
    std::memcpy(&its, &values[at(first)], sizeof its);
    const Whole way = from - its;
    return static_cast<float>(pressure.unit) * __builtin_convertvector(way, Lanes::Register);
}

// A sum of vectors in whole numbers of a part of a weight.
struct ForceSum {
    Whole x{}, y{}, z{};
};

std::int64_t total(const Whole& lanes_of)
{
    std::int64_t all = 0;
    for (Index lane = 0; lane < lanes; ++lane) {
        all += lanes_of[lane];
    }
    return all;
}

// The factor on the kernel force of a pair, max(1, apart/|r|): the force grows below the distance
// `apart` and does not vanish at distance zero.
Lanes repulsion(const Lanes& distance)
{
    constexpr float far = PackingPressure::apart;
    constexpr float near = 1e-3F; // [spacings]
    const Lanes at_least = near + positive(Lanes(distance - near));
    return 1 + positive(Lanes(far / at_least - 1));
}

// `depths(k, r)`: of the points from k on, as long as they count.
void add(const PackingGrid& grid, const PackingPressure& pressure, const UnitPlace& place,
         double weight, const auto& depths, ForceSum& force)
{
    Whole lane;
    for (int k = 0; k < lanes; ++k) {
        lane[k] = k;
    }
    over_runs(grid, place, pressure.reach, [&](Index begin, Index end) {
        for (Index k = begin; k < end; k += lanes) {
            const Vec<Lanes> r{lengths(grid.x, k, place[0], pressure),
                               lengths(grid.y, k, place[1], pressure),
                               lengths(grid.z, k, place[2], pressure)};
            const auto pair = pressure.kernel(r);
            const Lanes f = Lanes(weight) * depths(k, r) * pair.f * repulsion(pair.distance);
            const Whole counts = lane < static_cast<std::int32_t>(end - k);
            force.x += counts & __builtin_convertvector((f * r.x).value, Whole);
            force.y += counts & __builtin_convertvector((f * r.y).value, Whole);
            force.z += counts & __builtin_convertvector((f * r.z).value, Whole);
        }
    });
}

std::array<Index, 3> counts(const UnitPlace& low, const UnitPlace& high, const UnitPlace& edge)
{
    std::array<Index, 3> count{};
    for (std::size_t a = 0; a < 3; ++a) {
        count[a] = (static_cast<Index>(high[a]) - low[a]) / edge[a] + 1;
    }
    return count;
}

// At most two cells for each point: where the fluid fills a small part of its bounding box, the
// cells are enlarged.
void lay_out(PackingGrid& grid, const UnitPlace& low, const UnitPlace& high, double reach,
             std::size_t points)
{
    constexpr double most = 2; // cells for each point
    grid.origin = low;
    // Narrow along x, where runs are cut, and as wide as the reach across: longer runs of fewer
    // rows took a fifth less time than shorter ones.
    const auto across = static_cast<std::int32_t>(std::ceil(reach));
    grid.edge = {std::max(across / 4, 1), across, across};
    grid.count = counts(low, high, grid.edge);
    const double allowed = most * static_cast<double>(points) + 1e5;
    for (std::size_t a = 0;; a = (a + 1) % 3) {
        const double cells = static_cast<double>(grid.count[0]) *
                             static_cast<double>(grid.count[1]) *
                             static_cast<double>(grid.count[2]);
        if (cells <= allowed) {
            break;
        }
        grid.edge[a] = std::min(grid.edge[a], std::numeric_limits<std::int32_t>::max() / 2) * 2;
        grid.count = counts(low, high, grid.edge);
    }
    for (std::size_t a = 0; a < 3; ++a) {
        grid.inverse_edge[a] = 1.0 / grid.edge[a];
    }
}

Index cell_of(const PackingGrid& grid, const UnitPlace& place)
{
    std::array<Index, 3> c{};
    for (std::size_t a = 0; a < 3; ++a) {
        c[a] = (static_cast<Index>(place[a]) - grid.origin[a]) / grid.edge[a];
    }
    return (c[2] * grid.count[1] + c[1]) * grid.count[0] + c[0];
}

} // namespace

UnitPlace PackingUnits::whole(const Vec3& place) const
{
    const Vec3 units = (place - middle) / size;
    return {static_cast<std::int32_t>(std::nearbyint(units.x())),
            static_cast<std::int32_t>(std::nearbyint(units.y())),
            static_cast<std::int32_t>(std::nearbyint(units.z()))};
}

Vec3 PackingUnits::rounded(const Vec3& place) const
{
    const UnitPlace units = whole(place);
    return middle + size * Vec3(units[0], units[1], units[2]);
}

PackingUnits packing_units(const Vec3& middle, double spacing, const Vec3& low, const Vec3& high)
{
    constexpr double most = 0x1p29; // units from the middle
    const double extent = (high - middle).cwiseAbs().cwiseMax((low - middle).cwiseAbs()).maxCoeff();
    PackingUnits units{middle, PackingUnits::in_spacings * spacing};
    while (extent > most * units.size) {
        units.size *= 2;
    }
    return units;
}

PackingGrid packing_grid(std::span<const UnitPlace> places, double reach)
{
    PackingGrid grid;
    if (places.empty()) {
        return grid;
    }
    UnitPlace low = places[0];
    UnitPlace high = places[0];
    for (const UnitPlace& place : places) {
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], place[a]);
            high[a] = std::max(high[a], place[a]);
        }
    }
    lay_out(grid, low, high, reach, places.size());
    grid.start.assign(at(grid.count[0] * grid.count[1] * grid.count[2] + 1), 0);
    for (const UnitPlace& place : places) {
        ++grid.start[at(cell_of(grid, place) + 1)];
    }
    for (std::size_t c = 1; c < grid.start.size(); ++c) {
        grid.start[c] += grid.start[c - 1];
    }
    grid.order.resize(places.size());
    for (std::size_t k = places.size(); k-- > 0;) { // from behind, each cell filled from its end
        std::int32_t& end = grid.start[at(cell_of(grid, places[k]) + 1)];
        grid.order[at(--end)] = static_cast<std::int32_t>(k);
    }
    // Each entry is the beginning of the cell before it now.
    grid.start.erase(grid.start.begin());
    grid.start.push_back(static_cast<std::int32_t>(places.size()));
    for (auto* values : {&grid.x, &grid.y, &grid.z}) {
        values->assign(places.size() + at(lanes), 0);
    }
    parallel_for(0, static_cast<Index>(places.size()), [&](Index k) {
        const UnitPlace& place = places[at(grid.order[at(k)])];
        grid.x[at(k)] = place[0];
        grid.y[at(k)] = place[1];
        grid.z[at(k)] = place[2];
    });
    return grid;
}

bool any_within(const PackingGrid& grid, const UnitPlace& place, double reach)
{
    bool any = false;
    over_runs(grid, place, reach, [&](Index begin, Index end) { any = any || begin < end; });
    return any;
}

Vec3 pressure_sum(const PackingGrid& fluid, const PackingGrid* solids,
                  const PackingPressure& pressure, const UnitPlace& place, float depth)
{
    // A crowd of some hundred times the lattice has room in 31 bits.
    const double scale = 0x1p24 / pressure.deepest;
    const Lanes own = std::max(depth, 0.0F);
    ForceSum force;
    const auto of_fluid = [&](Index k, const Vec<Lanes>&) {
        Lanes its;
        std::memcpy(&its.value, &fluid.depth[at(k)], sizeof its.value);
        return own + positive(its);
    };
    add(fluid, pressure, place, scale * pressure.volume, of_fluid, force);
    const auto of_solids = [&](Index k, const Vec<Lanes>& r) {
        Lanes cubes;
        std::memcpy(&cubes.value, &solids->cubes[at(k)], sizeof cubes.value);
        return cubes * (own + positive(Lanes(depth) - dot(pressure.down, r)));
    };
    if (solids != nullptr) {
        add(*solids, pressure, place, scale, of_solids, force);
    }
    const auto part = [&](const Whole& sum) { return static_cast<double>(total(sum)) / scale; };
    return {part(force.x), part(force.y), part(force.z)};
}

} // namespace hyoryu
