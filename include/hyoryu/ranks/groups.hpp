// SPDX-License-Identifier: MIT
// Ranks that write files together: a file for each rank would be too many of them.
#pragma once

#include "hyoryu/ranks/comm.hpp"

#include <functional>

namespace hyoryu {

/// Groups of ranks that follow each other. The first of a group is its leader.
struct Groups {
    int ranks = 1;
    int count = 1;

    int of(int rank) const
    {
        return static_cast<int>(static_cast<std::int64_t>(rank) * count / ranks);
    }
    int leader(int group) const
    {
        return static_cast<int>((static_cast<std::int64_t>(group) * ranks + count - 1) / count);
    }
    bool leads(int rank) const { return leader(of(rank)) == rank; }
};

/// About equal groups, at most as many as asked for.
Groups group_ranks(int ranks, int most);

/// Gives the leader of each group what its members have, one after the other in their order, its
/// own first: it never holds two of them. `pack` is called once on each rank, `take` on leaders.
void gather_in_groups(Comm& comm, const Groups& groups, const std::function<Parcel()>& pack,
                      const std::function<void(Unpacking)>& take);

/// A value of rank 0, on all ranks.
template <Sendable T>
T value_of_root(Comm& comm, const T& value)
{
    return gather(comm, std::span<const T>(&value, 1)).all.front();
}

} // namespace hyoryu
