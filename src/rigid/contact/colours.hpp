// SPDX-License-Identifier: MIT
// Graph colouring of the rows of a contact problem: rows of one colour can be swept in parallel.
#pragma once

#include "row.hpp"

#include "hyoryu/core/parallel.hpp"

#include <limits>
#include <span>
#include <vector>

namespace hyoryu {

/// The contacts of one pair of bodies form a group, swept in order by one thread; groups of one
/// colour share no movable body, so that their order, and the number of threads, changes no bit.
struct Colours {
    std::vector<std::size_t> group_start; // first row of each group; one entry more than groups
    std::vector<std::size_t>
        colour_start;        // first group of each colour; one entry more than colours
    bool last_alone = false; // the groups of the last colour may share bodies
};

/// Sorts the rows by colour, the lowest that is free at both bodies. Rows below `worth_colouring`
/// stay in their order, all in one group.
void sort_by_colour(std::span<Row> rows, const std::vector<Response>& bodies, Colours& colours);

/// Rows below which sweeping them side by side costs more than it saves.
inline constexpr std::size_t worth_colouring = 512;
/// Number of groups of a colour below which waking the other threads costs more than they save.
inline constexpr Index worth_sharing_groups = 256;

/// Calls f(k) for every row k, colour after colour.
template <class F>
void for_each_row(const Colours& colours, const F& f)
{
    for (std::size_t c = 0; c + 1 < colours.colour_start.size(); ++c) {
        const bool alone = colours.last_alone && c + 2 == colours.colour_start.size();
        parallel_for(
            static_cast<Index>(colours.colour_start[c]),
            static_cast<Index>(colours.colour_start[c + 1]),
            [&](Index group) {
                const auto g = static_cast<std::size_t>(group);
                for (std::size_t k = colours.group_start[g]; k < colours.group_start[g + 1]; ++k) {
                    f(k);
                }
            },
            alone ? std::numeric_limits<Index>::max() : worth_sharing_groups);
    }
}

} // namespace hyoryu
