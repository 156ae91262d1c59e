// SPDX-License-Identifier: MIT
// When the lists of the fluid are made, and from what.
#include "hyoryu/fluid/fluid.hpp"

#include <cmath>

namespace hyoryu {

namespace {

auto at(Index row)
{
    return static_cast<std::size_t>(row);
}

real displacement(const Fluid& fluid, Rows rows)
{
    const auto x = fluid.particles[field::position];
    const auto& x0 = fluid.neighbours.built_at;
    return std::sqrt(largest(rows.begin, rows.end, 0,
                             [&](Index i) { return (x[at(i)] - x0[at(i)]).squaredNorm(); }));
}

// Two particles close by at most the sum of their displacements.
bool stale(const Fluid& fluid)
{
    const Particles& particles = fluid.particles;
    if (fluid.neighbours.built_at.size() != at(particles.size())) {
        return true;
    }
    const real moved_fluid = displacement(fluid, particles.fluid());
    const real moved_solid = displacement(fluid, particles.solid());
    return moved_fluid + std::max(moved_fluid, moved_solid) > fluid.parameters.skin ||
           2 * moved_solid > fluid.parameters.skin;
}

std::span<const Vec3> slice(std::span<const Vec3> column, Rows rows)
{
    return column.subspan(at(rows.begin), at(rows.size()));
}

real radius(const Fluid& fluid)
{
    return fluid.kernel.support + fluid.parameters.skin;
}

// Cells of half the radius: more of the candidates they offer are near than with whole ones.
real cell_size(const Fluid& fluid)
{
    return radius(fluid) / 2;
}

// Fluid rows in the order of the cells, without those that left the domain.
void sort_and_drop(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    CellGrid& grid = fluid.neighbours.fluid_grid;
    build(grid, slice(particles[field::position], particles.fluid()), 0, cell_size(fluid));
    const auto x = particles[field::position];
    const auto v = particles[field::velocity];
    const real m = fluid.parameters.mass;
    std::vector<std::int32_t> kept;
    kept.reserve(grid.order.size());
    for (const std::int32_t i : grid.order) {
        const Vec3& xi = x[at(i)];
        const bool inside = (xi.array() >= fluid.domain_min.array()).all() &&
                            (xi.array() <= fluid.domain_max.array()).all();
        if (inside) {
            kept.push_back(i);
        } else {
            const Vec3& vi = v[at(i)];
            fluid.lost.count += 1;
            fluid.lost.momentum += m * vi;
            fluid.lost.energy += 0.5 * m * vi.squaredNorm() - m * fluid.parameters.gravity.dot(xi);
        }
    }
    particles.permute_fluid(kept);
}

void build_lists(Fluid& fluid)
{
    const Particles& particles = fluid.particles;
    FluidNeighbours& n = fluid.neighbours;
    const std::span<const Vec3> x = n.built_at;
    build(n.fluid_grid, slice(x, particles.fluid()), 0, cell_size(fluid));
    const Rows walls = particles.wall();
    if (fluid.moving_walls || n.walls_in_grid.begin != walls.begin ||
        n.walls_in_grid.end != walls.end) {
        n.walls_in_grid = walls;
        build(n.wall_grid, slice(x, walls), walls.begin, cell_size(fluid));
    }
    build(n.body_grid, slice(x, particles.body()), particles.body().begin, cell_size(fluid));

    const real r = radius(fluid);
    const CellGrid* const fluid_grid[] = {&n.fluid_grid};
    const CellGrid* const body_grid[] = {&n.body_grid};
    const CellGrid* const solid_grids[] = {&n.wall_grid, &n.body_grid};
    n.fluid_fluid.build(x, particles.fluid(), fluid_grid, r);
    // Dry walls meet nothing and get no lists of their own.
    if (particles.solid().size() > 0) {
        n.fluid_solid.build(x, particles.fluid(), solid_grids, r);
        n.solid_fluid.build(x, particles.solid(), fluid_grid, r,
                            {.wanted = n.fluid_solid.met(particles.size())});
    }
    if (particles.body().size() > 0) {
        n.body_solid.build(x, particles.body(), solid_grids, r, {.owner = particles.owner()});
        n.wall_body.build(x, particles.wall(), body_grid, r,
                          {.wanted = n.body_solid.met(particles.size())});
    }
    n.builds += 1;
    // Pressure and velocity loops of the fluid; extrapolation and loads of the solids; films.
    n.visits = 2 * (n.fluid_fluid.entries() + n.fluid_solid.entries() + n.solid_fluid.entries()) +
               n.body_solid.entries() + n.wall_body.entries();
}

} // namespace

void update_neighbours(Fluid& fluid)
{
    if (!stale(fluid)) {
        return;
    }
    sort_and_drop(fluid);
    const auto x = fluid.particles[field::position];
    fluid.neighbours.built_at.assign(x.begin(), x.end());
    build_lists(fluid);
}

void rebuild_neighbours(Fluid& fluid)
{
    build_lists(fluid);
}

} // namespace hyoryu
