// SPDX-License-Identifier: MIT
// The formulations: by which kernel and which pressure terms the one set of pair loops works.
#pragma once

#include "hyoryu/core/mps_kernel.hpp"
#include "hyoryu/fluid/mps.hpp"
#include "hyoryu/fluid/pressure.hpp"

namespace hyoryu {

/// Weakly compressible SPH.
struct Sph {
    static constexpr std::string_view name = "sph";
    static constexpr bool may_correct = true; // see fluid/gradient
    using PairKernel = Kernel;
    using FluidPressure = PressureForce;     // fluid <- fluid
    using SolidPressure = WallPressureForce; // fluid <- solid
    static PairKernel make(real h, real spacing, int dimensions)
    {
        return make_kernel(h, spacing, dimensions);
    }
};

/// Weakly compressible MPS: the weight of MPS and its gradient of differences. Solids feel the
/// symmetric force in either formulation.
struct Mps {
    static constexpr std::string_view name = "mps";
    static constexpr bool may_correct = false; // it has a correction of its own
    using PairKernel = MpsKernel;
    using FluidPressure = MpsGradient;
    using SolidPressure = MpsWallGradient;
    static PairKernel make(real h, real spacing, int dimensions)
    {
        return make_mps_kernel(2 * h, spacing, dimensions);
    }
};

} // namespace hyoryu
