// SPDX-License-Identifier: MIT
// What is wrong with places that follow from several keys.
#pragma once

#include <string>

namespace hyoryu {

/// What is wrong with a place; without a hint the meaning of the key stands for one.
struct PlaceFault {
    std::string what;
    std::string hint = {};
};

} // namespace hyoryu
