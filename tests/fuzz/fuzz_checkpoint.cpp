// SPDX-License-Identifier: MIT
// Any bytes in the place of a checkpoint are one, or an error.
#include "hyoryu/core/error.hpp"
#include "hyoryu/io/results.hpp"
#include "scratch.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hyoryu;
    static const testing::Scratch scratch;
    const auto file = scratch.put("checkpoint.h5", data, size);
    try {
        read_newest_checkpoint(file.parent_path());
    } catch (const IoError&) {
        return 0;
    }
    return 0;
}
