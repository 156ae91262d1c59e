// SPDX-License-Identifier: MIT
#include "watch.hpp"

#include "hyoryu/core/error.hpp"
#include "hyoryu/sim/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyoryu {

namespace {

// A weakly compressible fluid is designed for 1 %. A few particles squeezed between bodies in a jam
// reach tens of percent and recover; at twice the density the run is lost.
constexpr double worst_compression = 1.0;
// Nothing in the flow can be faster than its sound without the run being lost.
constexpr double fastest_over_sound = 2;

std::size_t at(Index row)
{
    return static_cast<std::size_t>(row);
}

std::string probable_cause(const Simulation& sim)
{
    if (sim.scene.time.step) {
        return "probably the fixed `time.step` is too long";
    }
    if (sim.scene.time.cfl > 0.6) {
        return fmt::format("probably `time.cfl` = {} is too large; 0.6 is the default",
                           sim.scene.time.cfl);
    }
    if (sim.plan.expected_speed > 0.2 * sim.plan.fluid->eos.c0) {
        return "probably `fluid.sound_speed` is too low for the speeds of this flow";
    }
    return "probably an overlap at the start, a body thinner than 3 spacings, or fluid squeezed "
           "between solids";
}

[[noreturn]] void report(const Simulation& sim, std::string who, std::string field_name,
                         std::string cause)
{
    throw NumericalError(
        {sim.clock.step, sim.clock.time, std::move(who), std::move(field_name), std::move(cause)});
}

void watch_fluid(Simulation& sim)
{
    const Fluid& fluid = *sim.fluid;
    const Rows rows = fluid.particles.fluid();
    const auto rho = fluid.particles[field::density];
    const auto v = fluid.particles[field::velocity];
    const real rho0 = fluid.parameters.eos.rho0;
    const real top = sq(fastest_over_sound * fluid.parameters.eos.c0);
    // Not-a-number fails both comparisons and so counts as bad.
    const auto error = [&](Index i) {
        const real e = std::abs(rho[at(i)] / rho0 - 1);
        const bool good = e <= worst_compression && v[at(i)].squaredNorm() <= top;
        return good ? e : infinity;
    };
    const real worst = largest(rows.begin, rows.end, 0, error);
    if (worst == infinity) {
        Index bad = rows.begin;
        while (error(bad) != infinity) {
            ++bad;
        }
        const Vec3& x = fluid.particles[field::position][at(bad)];
        report(
            sim,
            fmt::format("fluid particle {} at ({:.4g}, {:.4g}, {:.4g}) m",
                        fluid.particles.id()[at(bad)], x.x(), x.y(), x.z()),
            fmt::format("density {:.4g} kg/m3, speed {:.4g} m/s", rho[at(bad)], v[at(bad)].norm()),
            probable_cause(sim));
    }
    sim.ledger.worst_density_error = std::max(sim.ledger.worst_density_error, worst);
}

} // namespace

void watch(Simulation& sim)
{
    if (sim.fluid) {
        watch_fluid(sim);
    }
    for (const Body& body : sim.rigid.bodies) {
        const bool finite = body.position.allFinite() && body.velocity.allFinite() &&
                            body.angular_momentum.allFinite() &&
                            body.orientation.coeffs().allFinite();
        if (!finite) {
            report(sim, fmt::format("body \"{}\"", body.name), "pose or velocity is not finite",
                   "probably its mass or a load on it is extreme; compare it with its neighbours");
        }
    }
}

} // namespace hyoryu
