// SPDX-License-Identifier: MIT
#include "hyoryu/fluid/fluid.hpp"

#include "moments.hpp"
#include "sweeps.hpp"

namespace hyoryu {

namespace {

// M^-1 G where the moments tell a gradient, else none: a row of particles has no gradient across.
Vec3 renormalised(const Vec3& G, const Mat3& M)
{
    constexpr real least_determinant = 1e-3;
    return M.determinant() > least_determinant ? Vec3(M.inverse() * G) : Vec3(Vec3::Zero());
}

} // namespace

void add_renormalised_diffusion(Fluid& fluid)
{
    Particles& particles = fluid.particles;
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms = terms_of(fluid, 0);
    clear(particles, particles.fluid(), DensityGradient::Writes{});
    run(fluid, n.fluid_fluid, n.fluid, terms, [](const auto& loops) { return loops.gradient; });
    const auto G = particles[field::pressure_gradient];
    const auto moments = particles[field::moments];
    const auto mixed = particles[field::mixed_moments];
    const Rows rows = particles.fluid();
    parallel_for(rows.begin, rows.end, [&](Index i) {
        G[at(i)] = renormalised(
            G[at(i)], moment_matrix(moments[at(i)], mixed[at(i)], fluid.parameters.dimensions));
    });
    std::visit(
        [&](auto& data) {
            data.records.lend(particles, n.fluid, field::pressure_gradient, field::velocity);
        },
        fluid.pair_data);
    run(fluid, n.fluid_fluid, n.fluid, terms, [](const auto& loops) { return loops.diffusion; });
}

} // namespace hyoryu
