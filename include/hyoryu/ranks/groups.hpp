// SPDX-License-Identifier: MIT
// Groups of ranks that write one file together, which bounds the number of files.
#pragma once

#include "hyoryu/ranks/comm.hpp"

#include <functional>

namespace hyoryu {

/// `ranks` ranks in `count` groups of consecutive ranks. The first rank of a group is its leader.
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

/// Groups of about equal size, at most `most` of them.
Groups group_ranks(int ranks, int most);

/// Sends the parcel of each rank to the leader of its group. `pack` creates the parcel, once on
/// each rank; `take` is called on the leader for each member, in the order of the ranks. A leader
/// holds one parcel at a time.
void gather_in_groups(Comm& comm, const Groups& groups, const std::function<Parcel()>& pack,
                      const std::function<void(Unpacking)>& take);

/// A value of rank 0, on all ranks.
template <Sendable T>
T value_of_root(Comm& comm, const T& value)
{
    return gather(comm, std::span<const T>(&value, 1)).all.front();
}

} // namespace hyoryu
