// SPDX-License-Identifier: MIT
#include "seeded_water.hpp"

#include "cells.hpp"

#include "hyoryu/core/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

constexpr double most_cells = 3e8;
// A wall thinner than this part of a spacing may be passed; `check` warns of walls thinner than
// one.
constexpr int halvings = 5;

using Cell = std::array<Index, 3>;

Index number_of(const SeededCells& cells, const Cell& c)
{
    return (c[2] * cells.count[1] + c[1]) * cells.count[0] + c[0];
}

// The cell at a place, which may be outside of the lattice.
Cell cell_about(const SeededCells& cells, const Vec3& place)
{
    Cell cell{};
    for (int a = 0; a < 3; ++a) {
        cell[at(a)] = static_cast<Index>(std::floor((place[a] - cells.first[a]) / cells.edge));
    }
    return cell;
}

Vec3 middle_of(const SeededCells& cells, const Cell& c)
{
    Vec3 p = cells.first;
    for (Index a = 0; a < 3; ++a) {
        p[a] += (static_cast<double>(c[at(a)]) + 0.5) * cells.edge;
    }
    return p;
}

bool is_within(const SeededCells& cells, const Cell& c)
{
    for (std::size_t a = 0; a < 3; ++a) {
        if (c[a] < 0 || c[a] >= cells.count[a]) {
            return false;
        }
    }
    return true;
}

bool is_wet(const SeededCells& cells, const Cell& c)
{
    return is_within(cells, c) && cells.wet[at(number_of(cells, c))] != 0;
}

// Whether a line is free: its ends have clearances that cover it, or both of its halves are.
bool is_free(const FreeSpace& space, const Vec3& a, double clear_a, const Vec3& b, double clear_b,
             int halved)
{
    if (!(clear_a > 0) || !(clear_b > 0)) {
        return false;
    }
    if (clear_a + clear_b >= (b - a).norm() || halved == halvings) {
        return true;
    }
    const Vec3 middle = (a + b) / 2;
    const double clear = space.clearance(middle);
    return is_free(space, a, clear_a, middle, clear, halved + 1) &&
           is_free(space, middle, clear, b, clear_b, halved + 1);
}

bool is_free(const FreeSpace& space, const Vec3& a, const Vec3& b)
{
    return is_free(space, a, space.clearance(a), b, space.clearance(b), 0);
}

SeededCells lattice_of(const Scene& scene, const SeededWater& water, const Bounds& within)
{
    SeededCells cells;
    cells.edge = scene.spacing;
    double all = 1;
    for (int a = 0; a < 3; ++a) {
        const double length = (a == 2 ? water.level : within.max[a]) - within.min[a];
        const double n = scene.dimensions == 2 && a == 1
                             ? 1
                             : std::ceil(length / cells.edge - 1e-6); // a part of a cell counts
        all *= std::max(n, 0.0);
        cells.count[at(a)] = n < most_cells ? static_cast<Index>(n) : 0;
    }
    cells.first = within.min;
    cells.first.y() = scene.dimensions == 2 ? -cells.edge / 2 : cells.first.y();
    cells.first.z() = water.level - static_cast<double>(cells.count[2]) * cells.edge;
    if (!(all > 0)) {
        cells.fault =
            fmt::format("the level, z = {:.6g} m, is below all walls, which begin at z = {:.6g} m",
                        water.level, within.min.z());
    } else if (!(all <= most_cells)) {
        cells.fault =
            fmt::format("the scene below the level has {:.2g} cells of a spacing, at most "
                        "{:.0g} are supported",
                        all, most_cells);
    } else {
        cells.wet.assign(static_cast<std::size_t>(all), 0);
    }
    return cells;
}

// A step from a wet cell across a face.
struct Crossing {
    Cell from{}, to{};
    bool open = false;
};

std::vector<Crossing> crossings_from(const SeededCells& cells, const std::vector<Index>& front,
                                     int dimensions)
{
    std::vector<Crossing> found;
    for (const Index number : front) {
        const Cell from = cell_at(number, cells.count);
        for (std::size_t face = 0; face < 6; ++face) {
            const std::size_t axis = face / 2;
            if (dimensions == 2 && axis == 1) {
                continue;
            }
            Cell to = from;
            to[axis] += face % 2 == 0 ? -1 : 1;
            const bool above = to[2] >= cells.count[2];
            if (!above && !is_wet(cells, to)) {
                found.push_back({from, to});
            }
        }
    }
    return found;
}

// Whether a step from this place out of the box crosses a window.
bool at_window(const Scene& scene, const Vec3& from, double edge)
{
    return std::ranges::any_of(scene.open, [&](const OpenSettings& open) {
        const int axis = open.axis();
        const int along = 1 - axis;
        const bool beside = scene.dimensions == 2 || (from[along] > open.min[along] - edge &&
                                                      from[along] < open.max[along] + edge);
        return beside && std::abs(from[axis] - open.plane()) < edge &&
               from.z() > open.min.z() - edge && from.z() < open.max.z() + edge;
    });
}

// The cells beyond a front, which become wet; notes where water would leave the box.
std::vector<Index> advance(const Scene& scene, SeededCells& cells, const FreeSpace& space,
                           const std::vector<Index>& front)
{
    std::vector<Crossing> crossings = crossings_from(cells, front, space.dimensions());
    parallel_for(
        0, static_cast<Index>(crossings.size()),
        [&](Index k) {
            Crossing& c = crossings[at(k)];
            c.open = is_free(space, middle_of(cells, c.from), middle_of(cells, c.to));
        },
        256);
    std::vector<Index> next;
    for (const Crossing& c : crossings) {
        if (!c.open) {
            continue;
        }
        if (!is_within(cells, c.to)) {
            const Vec3 from = middle_of(cells, c.from);
            if (!cells.leak && !at_window(scene, from, cells.edge)) {
                cells.leak = from;
            }
            continue;
        }
        std::uint8_t& wet = cells.wet[at(number_of(cells, c.to))];
        if (wet == 0) {
            wet = 1;
            next.push_back(number_of(cells, c.to));
        }
    }
    return next;
}

} // namespace

SeededCells seeded_cells(const Scene& scene, std::size_t block, const Bounds& within)
{
    const SeededWater& water = *scene.fluid->blocks[block].seeded;
    SeededCells cells = lattice_of(scene, water, within);
    if (!cells.fault.empty()) {
        return cells;
    }
    const FreeSpace space(scene, block);
    Cell seed = cell_about(cells, water.seed);
    seed[1] = scene.dimensions == 2 ? 0 : seed[1];
    seed[2] = cells.count[2] - 1;
    if (!is_within(cells, seed)) {
        cells.fault = fmt::format("the seed lies outside of the scene, which has x from {:.6g} to "
                                  "{:.6g} m and y from {:.6g} to {:.6g} m",
                                  within.min.x(), within.max.x(), within.min.y(), within.max.y());
        return cells;
    }
    if (!(space.clearance(middle_of(cells, seed)) > 0)) {
        cells.fault =
            fmt::format("the place at the seed, x = {:.6g} m and y = {:.6g} m, {:.3g} m below the "
                        "level is inside a wall, such as dry ground, or another block",
                        water.seed.x(), water.seed.y(), cells.edge / 2);
        return cells;
    }
    std::vector<Index> front{number_of(cells, seed)};
    cells.wet[at(front.front())] = 1;
    while (!front.empty()) {
        cells.reached += static_cast<Index>(front.size());
        front = advance(scene, cells, space, front);
    }
    return cells;
}

Bounds box_about(const SeededCells& cells)
{
    Bounds box;
    for (std::size_t k = 0; k < cells.wet.size(); ++k) {
        if (cells.wet[k] != 0) {
            const Cell c = cell_at(static_cast<Index>(k), cells.count);
            Bounds own;
            for (std::size_t a = 0; a < 3; ++a) {
                const auto axis = static_cast<Index>(a);
                const Index low = std::max<Index>(c[a] - 1, 0);
                const Index high = std::min(c[a] + 2, cells.count[a]);
                own.min[axis] = cells.first[axis] + static_cast<double>(low) * cells.edge;
                own.max[axis] = cells.first[axis] + static_cast<double>(high) * cells.edge;
            }
            box.add(own);
        }
    }
    return box;
}

bool share_a_cell(const SeededCells& a, const SeededCells& b)
{
    for (std::size_t k = 0; k < a.wet.size(); ++k) {
        if (a.wet[k] == 0) {
            continue;
        }
        const Vec3 middle = middle_of(a, cell_at(static_cast<Index>(k), a.count));
        if (is_wet(b, cell_about(b, middle))) {
            return true;
        }
    }
    return false;
}

bool is_reached(const SeededCells& cells, const FreeSpace& space, const Vec3& place)
{
    Cell own = cell_about(cells, place);
    own[1] = space.dimensions() == 2 ? 0 : own[1];
    for (int way = 0; way < 27; ++way) {
        const int first = (way + 13) % 27; // the own cell first
        const Cell c{own[0] + first % 3 - 1, own[1] + first / 3 % 3 - 1, own[2] + first / 9 - 1};
        if (is_wet(cells, c) && is_free(space, middle_of(cells, c), place)) {
            return true;
        }
    }
    return false;
}

} // namespace hyoryu
