// SPDX-License-Identifier: MIT
#include "hyoryu/core/mps_kernel.hpp"

namespace hyoryu {

MpsKernel make_mps_kernel(real support, real spacing, int dimensions)
{
    MpsKernel kernel{
        .support = support, .w_scale = 1, .f_scale = 1, .softening = sq(0.5 * spacing)};
    const bool plane = dimensions == 2;
    const int reach = static_cast<int>(std::ceil(support / spacing));
    const int reach_y = plane ? 0 : reach;
    real sum = 0;    // of w
    real moment = 0; // of F x^2, with F of scale 1
    for (int i = -reach; i <= reach; ++i) {
        for (int j = -reach_y; j <= reach_y; ++j) {
            for (int k = -reach; k <= reach; ++k) {
                const bool self = i == 0 && j == 0 && k == 0;
                const Vec<real> r{i * spacing, j * spacing, k * spacing};
                const auto ij = kernel(r);
                sum += self ? 0 : ij.w;
                moment += ij.f * sq(r.x);
            }
        }
    }
    const real cell = plane ? sq(spacing) : spacing * spacing * spacing;
    kernel.w_scale = 1 / (sum * cell);
    kernel.f_scale = -1 / (moment * cell);
    return kernel;
}

} // namespace hyoryu
