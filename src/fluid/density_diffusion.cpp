// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/fluid.hpp"

#include "moments.hpp"
#include "sharing.hpp"
#include "sweeps.hpp"

namespace hyoryu {

namespace {

// M^-1 G, or zero if the moments are nearly singular: a row of particles has no transverse
// gradient.
Vec3 renormalised(const Vec3& G, const Mat3& M)
{
    constexpr real least_determinant = 1e-3;
    return M.determinant() > least_determinant ? Vec3(M.inverse() * G) : Vec3(Vec3::Zero());
}

} // namespace

void add_renormalised_diffusion(Fluid& fluid)
{
    Store& store = fluid.particles.fluid;
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, 0);
    clear(store, DensityGradient::Writes{});
    run<PassOf<DensityGradient>>(fluid, n.fluid_fluid, to_fluid(fluid), terms);
    const auto G = store[field::pressure_gradient];
    const auto moments = store[field::moments];
    const auto mixed = store[field::mixed_moments];
    parallel_for(0, store.size(), [&](Index i) {
        G[i] = renormalised(G[i], moment_matrix(moments[i], mixed[i], fluid.parameters.dimensions));
    });
    share_fluid(fluid, Fields<PressureGradient>{});
    run<RenormalisedDiffusion::Sum>(fluid, n.fluid_fluid, to_fluid(fluid), terms);
}

} // namespace hyoryu
