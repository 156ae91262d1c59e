// SPDX-License-Identifier: MIT
#include "fluid_loops.hpp"

#include "hyoryu/core/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>

namespace hyoryu::bench {

namespace {

constexpr int bytes = HYORYU_REGISTER_BYTES;

double cpu_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Median CPU time of a call, over calls that take `least` seconds in all and are five or more.
double median_time(double least, const auto& call)
{
    std::vector<double> times;
    double total = 0;
    call();
    while (times.size() < 5 || total < least) {
        const double start = cpu_seconds();
        call();
        times.push_back(cpu_seconds() - start);
        total += times.back();
    }
    std::nth_element(times.begin(), times.begin() + static_cast<Index>(times.size() / 2),
                     times.end());
    return times[times.size() / 2];
}

Fluid make_cube(const LoopSetting& setting)
{
    constexpr double dp = 0.01;
    Fluid fluid;
    FluidParameters& f = fluid.parameters;
    f = {.eos = {1000, 30}, .spacing = dp, .h = 1.5 * dp, .mass = 1000 * dp * dp * dp};
    fluid.neighbours.skins = {setting.skin * dp, setting.skin * dp};
    f.precision = setting.precision;
    fluid.kernel = make_kernel(f.h, dp, 3);
    fluid.effects.viscosity = Viscosity{1000, artificial_kappa(0.02, f.h, f.eos.c0), f.h};
    fluid.effects.diffusion =
        DensityDiffusion{0.2 * f.h * f.eos.c0, f.eos, Vec3(f.eos.rho0 / sq(f.eos.c0) * f.gravity)};
    const int n = setting.edge;
    allocate(fluid, Index(n) * n * n, 0, 0);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-0.2, 0.2);
    for (int k = 0; k < n * n * n; ++k) {
        const auto row = static_cast<std::size_t>(k);
        const double jx = off(random);
        const double jy = off(random);
        const Vec3 jitter(jx, jy, off(random));
        fluid.particles[field::position][row] = dp * (Vec3(k % n, k / n % n, k / n / n) + jitter);
        fluid.particles[field::velocity][row] = {off(random), off(random), off(random)};
        fluid.particles[field::density][row] = 1000 + 5 * off(random);
    }
    return fluid;
}

double count_pairs(const Fluid& fluid)
{
    const auto x = fluid.particles[field::position];
    double pairs = 0;
    fluid.neighbours.fluid_fluid.for_each_pair([&](Index i, Index j) {
        const double squared =
            (x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(j)]).squaredNorm();
        pairs += i != j && squared < sq(fluid.kernel.support) ? 1 : 0;
    });
    return pairs;
}

// All terms of both loops in one sweep, as schemes with one force evaluation have them.
void sweep_all(Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    std::visit(
        [&]<class Real>(PairData<Real>& data) {
            const SweepView<Stored, Real> view{n.fluid_fluid.blocks().data(),
                                               data.records.data(),
                                               fluid.particles.pointers(),
                                               n.fluid.row.data(),
                                               0,
                                               n.fluid.lattice.edge,
                                               fluid.kernel};
            for (Index b = 0; b < static_cast<Index>(n.fluid_fluid.blocks().size()); ++b) {
                sweep_block<bytes>(view, b, data.local[0].data(), PressureForce{},
                                   std::get<DensityDiffusion>(fluid.effects.diffusion),
                                   Continuity{}, std::get<Viscosity>(fluid.effects.viscosity));
            }
        },
        fluid.pair_data);
}

} // namespace

std::vector<Figure> measure_loops(const LoopSetting& setting)
{
    set_threads(1);
    Fluid fluid = make_cube(setting);
    update_neighbours(fluid);
    update_pressure(fluid);
    const double pairs = count_pairs(fluid);
    const auto n = static_cast<double>(fluid.particles.fluid().size());
    const auto rate = [&](const auto& call) {
        return 1e-6 * pairs / median_time(setting.seconds, call);
    };
    const double build = median_time(setting.seconds, [&] { rebuild_neighbours(fluid); });
    const double all = 1e-6 * pairs / rate([&] { sweep_all(fluid); });
    return {
        {"neighbours of a particle", pairs / n, "1"},
        {"share of list entries inside the support",
         pairs / static_cast<double>(fluid.neighbours.fluid_fluid.entries()), "1"},
        {"all terms in one loop", 1e-6 * pairs / all, "Mpair/s"},
        {"force stage", rate([&] { update_forces(fluid, 1e-4); }), "Mpair/s"},
        {"rate stage", rate([&] { update_rates(fluid); }), "Mpair/s"},
        {"pressure stage", 1e-6 * n / median_time(setting.seconds, [&] { update_pressure(fluid); }),
         "Mparticle/s"},
        {"making lists", 1e-6 * pairs / build, "Mpair/s"},
        {"making lists over one loop", build / all, "1"},
        {"bytes of lists", static_cast<double>(fluid.neighbours.fluid_fluid.bytes()) / n,
         "B/particle"},
    };
}

} // namespace hyoryu::bench
