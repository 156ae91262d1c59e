// SPDX-License-Identifier: MIT
// Any text is a case or a list of mistakes; a case survives being written and read again, and can
// be filled and planned.
#include "../../src/scene/filling/fill_size.hpp"
#include "hyoryu/core/error.hpp"
#include "hyoryu/scene/case_file.hpp"
#include "hyoryu/scene/plan.hpp"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hyoryu;
    constexpr double few = 2e4; // particles that take no time
    try {
        const Scene scene =
            parse_case(std::string(reinterpret_cast<const char*>(data), size), "fuzz.toml");
        const std::string resolved = to_toml(scene);
        if (to_toml(parse_case(resolved, "fuzz.toml")) != resolved) {
            std::abort();
        }
        if (particles_asked(scene) < few && scene.bodies.size() < 100) {
            make_plan(scene, fill(scene));
        }
    } catch (const CaseError&) {
        return 0;
    }
    return 0;
}
