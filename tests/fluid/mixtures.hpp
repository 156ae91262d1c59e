// SPDX-License-Identifier: MIT
// Fluids of a few particles for the tests of the loops.
#pragma once

#include "hyoryu/fluid/fluid.hpp"

#include <algorithm>
#include <ostream>
#include <random>

namespace hyoryu {

constexpr real dp = 0.1;

struct Choice {
    Precision precision;
    InstructionSet set;
    bool diffusion;
    bool viscosity;
    FormulationKind formulation = FormulationKind::sph;
    KernelShape kernel = KernelShape::wendland;
};

// How GoogleTest names it.
inline void PrintTo(const Choice& choice, std::ostream* to)
{
    *to << name(choice.set) << ' ' << name(choice.precision)
        << (choice.formulation == FormulationKind::mps ? " mps" : "")
        << (choice.kernel == KernelShape::isotropic ? " isotropic" : "")
        << (choice.diffusion ? " diffusion" : "") << (choice.viscosity ? " viscosity" : "");
}

// A jittered lattice: wall below z = 0.3, in the middle two bodies that touch, fluid elsewhere.
inline Fluid make_mixture(const Choice& choice)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<real> off(-0.2, 0.2);
    std::vector<Vec3> places[3];
    std::vector<std::int32_t> owners;
    for (int k = 0; k < 14 * 14 * 14; ++k) {
        const Vec3 lattice(k % 14, k / 14 % 14, k / 196);
        const real jx = off(random);
        const real jy = off(random);
        const Vec3 place = dp * (lattice + Vec3(jx, jy, off(random)));
        const bool inside = (lattice - Vec3(7, 7, 8)).cwiseAbs().maxCoeff() < 2.5;
        if (lattice.z() >= 3 && inside) {
            owners.push_back(lattice.x() < 7 ? 0 : 1);
        }
        places[lattice.z() < 3 ? 1 : inside ? 2 : 0].push_back(place);
    }
    Fluid fluid;
    fluid.instruction_set = choice.set;
    FluidParameters& f = fluid.parameters;
    f = {.eos = {1000, 30}, .spacing = dp, .h = 1.5 * dp, .mass = 1, .precision = choice.precision};
    f.formulation = choice.formulation;
    f.kernel = choice.kernel;
    fluid.kernel = make_kernel(f.h, dp, 3, f.kernel);
    fluid.mps_kernel = make_mps_kernel(2 * f.h, dp, 3);
    if (choice.diffusion) {
        fluid.effects[slot::diffusion] =
            DensityDiffusion{0.2 * f.h * 30, f.eos, Vec3(f.eos.rho0 / sq(f.eos.c0) * f.gravity)};
    }
    if (choice.formulation == FormulationKind::mps) {
        fluid.effects[slot::gradient] = CorrectedGradient{};
    }
    if (choice.viscosity) {
        fluid.effects[slot::viscosity] = Viscosity{1000, artificial_kappa(0.1, f.h, 30), f.h};
    }
    allocate(fluid, static_cast<Index>(places[0].size()), static_cast<Index>(places[1].size()),
             static_cast<Index>(places[2].size()));
    Particles& particles = fluid.particles;
    const std::vector<Vec3>* place_of_kind = places;
    for (Store* store : {&particles.fluid, &particles.wall, &particles.body}) {
        std::ranges::copy(*place_of_kind++, (*store)[field::position].begin());
        for (Index k = 0; k < store->size(); ++k) {
            (*store)[field::velocity][k] = {off(random), 0.1, off(random)};
            (*store)[field::density][k] = 1005 + 20 * off(random);
        }
    }
    for (Index k = 0; k < particles.fluid.size(); k += 3) {
        particles.fluid[field::gap][k] = 100; // parted from what solids it may be near
    }
    std::ranges::fill(particles.wall.owner(), -1);
    std::ranges::copy(owners, particles.body.owner().begin());
    for (Index k = 0; k < particles.body.size(); ++k) {
        particles.body[field::displaced_mass][k] = particles.body.owner()[k] == 0 ? 0.9 : 1.1;
    }
    return fluid;
}

} // namespace hyoryu
