// SPDX-License-Identifier: MIT
// Any text is an expression that has a value, or none.
#include "hyoryu/scene/formula.hpp"

#include <cstdint>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hyoryu;
    try {
        const Formula formula(std::string(reinterpret_cast<const char*>(data), size));
        formula.value(std::vector<double>(formula.names().size(), 0.5));
    } catch (const FormulaError&) {
        return 0;
    }
    return 0;
}
