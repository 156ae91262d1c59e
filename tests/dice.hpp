// SPDX-License-Identifier: MIT
// What scenes drawn at random are drawn with: the same numbers on every machine.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace hyoryu {

/// Numbers that follow from a seed: a counter and the hash of Steele, Lea and Flood (2014).
class Dice {
public:
    explicit Dice(std::uint64_t seed) : state_(seed) {}

    double between(double low, double high)
    {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15U);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return low + (high - low) * static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    bool chance(double p) { return between(0, 1) < p; }
    /// 0 to n - 1.
    int below(int n) { return static_cast<int>(between(0, n)); }

private:
    std::uint64_t state_;
};

/// The number that an environment variable holds; `otherwise` where it is not set.
inline int number_from(const char* variable, int otherwise)
{
    const char* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::atoi(text);
}

} // namespace hyoryu
