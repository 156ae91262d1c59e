// SPDX-License-Identifier: MIT
// A place in a case file.
#pragma once

namespace hyoryu {

/// The position of a key or value in the case file, for messages after reading.
struct Place {
    int line = 0;
    int column = 0;
    int length = 1;
};

} // namespace hyoryu
