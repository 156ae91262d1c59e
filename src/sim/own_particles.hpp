// SPDX-License-Identifier: MIT
// The particles that a process begins with: all of a filling, or those that rank 0 deals out to it.
#pragma once

#include "hyoryu/sim/simulation.hpp"

namespace hyoryu {

/// Numbers of the particles of a filling; empty: 0, 1, ...
struct Numbers {
    std::vector<std::int64_t> fluid, wall;

    std::int64_t of_fluid(std::size_t k) const { return number(fluid, k); }
    std::int64_t of_wall(std::size_t k) const { return number(wall, k); }

private:
    static std::int64_t number(const std::vector<std::int64_t>& numbers, std::size_t k)
    {
        return numbers.empty() ? static_cast<std::int64_t>(k) : numbers[k];
    }
};

/// What a rank begins with.
struct Share {
    Filling filling;  // of the fluid, what is in its tiles; of the walls, those that move
    Numbers numbers;  // of these particles in the whole filling
    FixedWalls walls; // of all ranks, without what makes them
    Cuts cuts;        // of the fluid
};

/// Whether the wall of an index moves.
bool is_moving(const Scene& scene, std::int32_t wall);

/// Where the particles of walls that do not move are, without what makes them.
FixedWalls find_fixed_walls(const Scene& scene, const Filling& filling, const TileLattice& lattice);

/// Deals out the filling of rank 0; those of the others are not looked at. Called by all ranks.
/// `lattice`: null without fluid. Rank 0 needs memory for its filling and one share at a time.
Share deal_out(const Scene& scene, const Filling& filling, const TileLattice* lattice, Comm& comm);

} // namespace hyoryu
