// SPDX-License-Identifier: MIT
// Sums and maxima over the whole scene between two steps. The length of the next step, the momentum
// balance of the last one and the detection of instability follow from them. All processes together
// need one call of MPI for all of them.
#pragma once

#include "hyoryu/core/error.hpp"
#include "hyoryu/fluid/fluid.hpp"

#include <cmath>

namespace hyoryu {

struct Simulation;

struct StateSurvey {
    Vec3 momentum{0, 0, 0};      // of fluid and bodies [kg m/s]
    double momentum_scale = 0;   // sum of |m v| [kg m/s]
    Index particles = 0;         // of the fluid
    double top_speed = 0;        // of the fluid, as all that follows [m/s]; not-a-number if any is
    double top_acceleration = 0; // [m/s2]
    double viscosity = 0;        // largest effective one [m2/s]
    double compression = 0;      // largest |rho/rho0 - 1|; infinite if a particle is out of bounds
    double request = 0;          // largest Simulation::request
};

/// Thrown if the bodies on the processes that share a case are no longer identical bit for bit,
/// although every process moves all of them. Checked in every hundredth step.
struct BodiesDiffer : IoError {
    using IoError::IoError;
};

/// The scene as it is now. Completes the loads of the step, if they are not.
StateSurvey survey(Simulation& sim);

/// |rho/rho0 - 1| of fluid particles; infinite if the run is lost: at twice the density, at twice
/// the speed of sound, or where either is not a number.
class Compression {
public:
    explicit Compression(const Fluid& fluid);
    double operator()(Index row) const
    {
        // A weakly compressible fluid is designed for 1 %. A few particles squeezed between bodies
        // in a jam reach tens of percent and recover; at twice the density the run is lost.
        constexpr double worst = 1.0;
        const double e = std::abs(density_[row] / rest_density_ - 1);
        // Not-a-number fails both comparisons and so counts as lost.
        return e <= worst && velocity_[row].squaredNorm() <= top_squared_ ? e : infinity;
    }

private:
    ColumnView<const real> density_;
    ColumnView<const Vec3> velocity_;
    double rest_density_;
    double top_squared_; // nothing in the flow can be faster without the run being lost
};

/// Shortest limit of the next step.
TimeLimit time_limit(const Simulation& sim, const StateSurvey& now);

} // namespace hyoryu
