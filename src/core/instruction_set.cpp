// SPDX-License-Identifier: MIT
#include "hyoryu/core/instruction_set.hpp"

#include "hyoryu/core/compiled_sets.hpp"

#include <array>

namespace hyoryu {

namespace {

constexpr std::array sets{InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512};

template <int... bytes>
constexpr bool compiled(InstructionSet set, RegisterSizes<bytes...>)
{
    return ((static_cast<int>(set) == bytes) || ...);
}

bool machine_has([[maybe_unused]] InstructionSet set)
{
#ifdef __x86_64__
    // What x86-64-v3 and v4 add, as far as compilers use it.
    const bool v3 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                    __builtin_cpu_supports("bmi2") != 0;
    if (set == InstructionSet::avx2) {
        return v3;
    }
    if (set == InstructionSet::avx512) {
        return v3 && __builtin_cpu_supports("avx512f") != 0 &&
               __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
               __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
    }
#endif
    return set == InstructionSet::baseline;
}

} // namespace

std::string_view name(InstructionSet set)
{
    switch (set) {
    case InstructionSet::avx512:
        return "AVX-512";
    case InstructionSet::avx2:
        return "AVX2";
    case InstructionSet::baseline:
        return "baseline";
    }
    return "";
}

bool available(InstructionSet set)
{
    return compiled(set, CompiledSets{}) && machine_has(set);
}

InstructionSet widest_instruction_set()
{
    InstructionSet widest = InstructionSet::baseline;
    for (const InstructionSet set : sets) {
        widest = available(set) ? set : widest;
    }
    return widest;
}

} // namespace hyoryu
