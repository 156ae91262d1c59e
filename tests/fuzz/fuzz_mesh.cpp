// SPDX-License-Identifier: MIT
// Any bytes in a file named .stl or .obj are a surface or an error. The first byte tells the name.
#include "hyoryu/core/error.hpp"
#include "hyoryu/geometry/mesh.hpp"
#include "scratch.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hyoryu;
    static const test_help::Scratch scratch;
    const bool obj = size > 0 && (data[0] == 'v' || data[0] == '#');
    const auto file = scratch.put(obj ? "mesh.obj" : "mesh.stl", data, size);
    try {
        const Mesh mesh = read_mesh(file, 1.0);
        if (closure_fault(mesh).empty()) {
            solid_properties(mesh);
        }
    } catch (const IoError&) {
        return 0;
    }
    return 0;
}
