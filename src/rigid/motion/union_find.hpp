// SPDX-License-Identifier: MIT
// Sets that are joined step by step (union-find).
#pragma once

#include <vector>

namespace hyoryu {

/// The root of the set of element k; `parents` holds the parent of each element, a root its own
/// number. Halves the path on the way.
inline int root_of(std::vector<int>& parents, int k)
{
    while (parents[k] != k) {
        parents[k] = parents[parents[k]];
        k = parents[k];
    }
    return k;
}

} // namespace hyoryu
