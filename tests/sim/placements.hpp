// SPDX-License-Identifier: MIT
// Families of scenes that follow from their seeds.
#pragma once

#include "../dice.hpp"
#include "hyoryu/core/parallel.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace hyoryu {

/// Calls f(seed) for HYORYU_PLACEMENTS seeds, as many as usual where it is not set, from
/// HYORYU_SEED on.
inline void for_seeds(int usual, const auto& f)
{
    const int first = number_from("HYORYU_SEED", 1);
    const int count = number_from("HYORYU_PLACEMENTS", usual);
    set_threads(1); // the scenes are small
    for (int seed = first; seed < first + count; ++seed) {
        SCOPED_TRACE(fmt::format("HYORYU_SEED={} HYORYU_PLACEMENTS=1", seed));
        f(static_cast<std::uint64_t>(seed));
    }
    set_threads(0);
}

} // namespace hyoryu
