// SPDX-License-Identifier: MIT
// Sums over the particles of all processes that share a case.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

namespace hyoryu {

/// Adds to sums what the other ranks have of them; `comm` is null for one process.
inline void add_other_ranks(Comm* comm, std::span<FixedSum> sums)
{
    Reduction all(comm);
    all.add(sums);
    all.run();
}

/// The terms of all ranks, in the order in which one process has them: those of a rank are in the
/// order of its rows, which are in the order of tiles.
template <class T>
std::vector<T> terms_of_all(const Fluid& fluid, std::vector<T> own)
{
    return fluid.ghosts ? gather(fluid.ghosts->comm, std::span<const T>(own)).all : own;
}

/// Sums of term(row) over the fluid of all ranks, as sums_by_tile takes them.
template <std::size_t n, class F>
std::array<double, n> sum_over_fluid(const Fluid& fluid, const FixedUnits<n>& units, const F& term)
{
    FixedSums<n> sums = sums_by_tile<n>(fluid.neighbours.fluid, units, term);
    add_other_ranks(comm_of(fluid), sums.each());
    return sums.values(units);
}

/// Sums of term(k) over the terms of all ranks, of which this one has k in [0, count); with `comm`
/// null those of this process alone.
template <std::size_t n, class F>
std::array<double, n> sum_over_ranks(Comm* comm, Index count, const FixedUnits<n>& units,
                                     const F& term)
{
    FixedSums<n> sums = sums_of_each<n>(count, units, term);
    add_other_ranks(comm, sums.each());
    return sums.values(units);
}
/// The same of vectors.
template <class F>
Vec3 vector_sum_over_ranks(Comm* comm, Index count, const FixedUnit& unit, const F& term)
{
    const auto [x, y, z] = sum_over_ranks<3>(comm, count, {unit, unit, unit}, [&](Index k) {
        const Vec3& v = term(k);
        return std::array{v.x(), v.y(), v.z()};
    });
    return {x, y, z};
}

} // namespace hyoryu
