// SPDX-License-Identifier: MIT
// Faults of places that follow from several keys.
#pragma once

#include <string>

namespace hyoryu {

/// The fault of a place. An empty hint stands for the meaning of the key.
struct PlaceFault {
    std::string what;
    std::string hint = {};
};

} // namespace hyoryu
