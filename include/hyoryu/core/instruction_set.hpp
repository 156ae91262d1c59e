// SPDX-License-Identifier: MIT
// Which instruction sets the hot loops were compiled for, and which of them this machine has.
//
// A source file with hot loops is compiled once for each set (tools/cmake/hyoryu_layer.cmake). All
// it defines are templates over the size of a register, so no function of one set is ever taken for
// that of another; the loops of a set stand in a table of functions, and tables are found here.
#pragma once

#include <string_view>

namespace hyoryu {

/// By the bytes of a register. 16: what every machine of the architecture has (SSE2, NEON); 32:
/// AVX2 (x86-64-v3); 64: AVX-512 (x86-64-v4).
enum class InstructionSet { baseline = 16, avx2 = 32, avx512 = 64 };

std::string_view name(InstructionSet set);

/// Whether the hot loops were compiled for the set and this machine has it.
bool available(InstructionSet set);
/// The widest that is available.
InstructionSet widest_instruction_set();

} // namespace hyoryu
