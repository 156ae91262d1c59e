// SPDX-License-Identifier: MIT
#include "hyoryu/ranks/groups.hpp"

#include "hyoryu/core/error.hpp"

#include <algorithm>

namespace hyoryu {

Groups group_ranks(int ranks, int most)
{
    expects(ranks >= 1 && most >= 1);
    return {ranks, std::min(ranks, most)};
}

void gather_in_groups(Comm& comm, const Groups& groups, const std::function<Parcel()>& pack,
                      const std::function<void(Unpacking)>& take)
{
    expects(groups.ranks == comm.size());
    const int rank = comm.rank();
    const int leader = groups.leader(groups.of(rank));
    const int largest = (groups.ranks + groups.count - 1) / groups.count;
    for (int member = 0; member < largest; ++member) {
        std::vector<Parcel> out(static_cast<std::size_t>(comm.size()));
        if (rank - leader == member) {
            out[leader] = pack();
        }
        const std::vector<Parcel> in = comm.exchange(std::move(out));
        const int sender = rank + member;
        if (rank == leader && sender < comm.size() && groups.of(sender) == groups.of(rank)) {
            take(Unpacking(in[sender]));
        }
    }
}

} // namespace hyoryu
