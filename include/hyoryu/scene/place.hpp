// SPDX-License-Identifier: MIT
// A place in a case file.
#pragma once

namespace hyoryu {

/// Where in the case file something was said, for messages that come after reading.
struct Place {
    int line = 0;
    int column = 0;
    int length = 1;
};

} // namespace hyoryu
