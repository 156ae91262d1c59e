// SPDX-License-Identifier: MIT
// Any text is a quantity or has a fault.
#include "../../src/scene/case/units.hpp"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text(reinterpret_cast<const char*>(data), size);
    for (const char* expected : {"m", "kg/m3", "N/m", "s", "deg", "1"}) {
        const hyoryu::ParsedQuantity quantity = hyoryu::parse_quantity(text, expected);
        if (quantity.fault.empty() != quantity.hint.empty()) {
            std::abort();
        }
    }
    hyoryu::parse_unit(text);
    return 0;
}
