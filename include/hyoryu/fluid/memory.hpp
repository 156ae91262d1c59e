// SPDX-License-Identifier: MIT
// Memory report of a fluid, by part.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

#include <string>

namespace hyoryu {

/// Bytes that one part holds, used or not.
struct MemoryUse {
    std::string part;
    std::size_t bytes = 0;
};

/// Every part that grows with the number of particles.
std::vector<MemoryUse> memory_of(const Fluid& fluid);

/// Sum over the parts [B].
std::size_t total(const std::vector<MemoryUse>& parts);

} // namespace hyoryu
