// SPDX-License-Identifier: MIT
#include "hyoryu/core/kernel.hpp"

#include <numbers>

namespace hyoryu {

Kernel make_kernel(real h, real spacing, int dimensions, KernelShape shape)
{
    using std::numbers::pi;
    const bool plane = dimensions == 2;
    const real a = plane ? 7 / (4 * pi * sq(h)) : 21 / (16 * pi * h * h * h);
    Kernel kernel{
        .h = h, .support = 2 * h, .w_scale = a, .f_scale = -5 * a / sq(h), .shape = shape};

    // The sums of the uncalibrated kernel over the lattice: S0 = sum W V, A0 = -sum F x^2 V.
    const int reach = static_cast<int>(std::ceil(kernel.support / spacing));
    const int reach_y = plane ? 0 : reach;
    const real cell_volume = plane ? sq(spacing) : spacing * spacing * spacing;
    real s0 = 0;
    real a0 = 0;
    for (int i = -reach; i <= reach; ++i) {
        for (int j = -reach_y; j <= reach_y; ++j) {
            for (int k = -reach; k <= reach; ++k) {
                const auto ij = kernel(Vec<real>{i * spacing, j * spacing, k * spacing});
                s0 += ij.w * cell_volume;
                a0 -= ij.f * sq(ij.r.x) * cell_volume;
            }
        }
    }
    kernel.w_scale /= s0;
    kernel.f_scale /= a0;
    return kernel;
}

} // namespace hyoryu
