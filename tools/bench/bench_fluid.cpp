// SPDX-License-Identifier: MIT
// bench_fluid: rates of the pair loops and of making lists, on one core.
#include "fluid_loops.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>

int main(int count, char** words)
{
    using namespace hyoryu;
    bench::LoopSetting setting;
    for (int k = 1; k + 1 < count; k += 2) {
        const double value = std::atof(words[k + 1]);
        if (std::strcmp(words[k], "--edge") == 0) {
            setting.edge = static_cast<int>(value);
        } else if (std::strcmp(words[k], "--skin") == 0) {
            setting.skin = value;
        } else if (std::strcmp(words[k], "--seconds") == 0) {
            setting.seconds = value;
        } else {
            fmt::print("usage: bench_fluid [--edge PARTICLES] [--skin SPACINGS] [--seconds S]\n");
            return 2;
        }
    }
    fmt::print("{} registers, {} particles, one thread\n", name(widest_instruction_set()),
               setting.edge * setting.edge * setting.edge);
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        setting.precision = precision;
        fmt::print("\n{} precision\n",
                   precision == Precision::single_precision ? "single" : "double");
        for (const bench::Figure& figure : bench::measure_loops(setting)) {
            fmt::print("  {:42} {:10.2f} {}\n", figure.name, figure.value, figure.unit);
        }
    }
    return 0;
}
