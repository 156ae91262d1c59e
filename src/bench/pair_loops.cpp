// SPDX-License-Identifier: MIT
// Cost of the pair loops and of building lists on one core.
#include "clock.hpp"
#include "hot_loops.hpp"
#include "hyoryu/bench/bench.hpp"
#include "operations.hpp"
#include "pairs.hpp"

#include "hyoryu/core/parallel.hpp"

#include <random>

namespace hyoryu::bench {

namespace {

Fluid make_cube(const LoopSetting& setting)
{
    constexpr double dp = 0.01;
    Fluid fluid;
    FluidParameters& f = fluid.parameters;
    f = {.eos = {1000, 30},
         .spacing = dp,
         .h = setting.smoothing_ratio * dp,
         .mass = 1000 * dp * dp * dp};
    fluid.neighbours.skins = {setting.skin * dp, setting.skin * dp};
    f.precision = setting.precision;
    fluid.kernel = make_kernel(f.h, dp, 3);
    fluid.effects[slot::viscosity] = Viscosity{1000, artificial_kappa(0.02, f.h, f.eos.c0), f.h};
    fluid.effects[slot::diffusion] =
        DensityDiffusion{0.2 * f.h * f.eos.c0, f.eos, Vec3(f.eos.rho0 / sq(f.eos.c0) * f.gravity)};
    const int n = setting.edge;
    allocate(fluid, Index(n) * n * n, 0, 0);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-0.2, 0.2);
    for (int k = 0; k < n * n * n; ++k) {
        const double jx = off(random);
        const double jy = off(random);
        const Vec3 jitter(jx, jy, off(random));
        const int x = k % n;
        const int y = k / n % n;
        const int z = k / n / n;
        fluid.particles.fluid[field::position][k] = dp * (Vec3(x, y, z) + jitter);
        fluid.particles.fluid[field::velocity][k] = {off(random), off(random), off(random)};
        fluid.particles.fluid[field::density][k] = 1000 + 5 * off(random);
    }
    return fluid;
}

void sweep_all(Fluid& fluid)
{
    const FluidNeighbours& n = fluid.neighbours;
    const FluidTerms terms{{}, {}, fluid.effects};
    std::visit(
        [&]<class Real>(PairData<Real>& data) {
            const auto& loops = std::get<HotLoops<Real>>(hot_loops_for(fluid.instruction_set));
            const SweepView<Real> view{n.fluid_fluid.blocks().data(),
                                       data.records().data(),
                                       fluid.particles.fluid.pointers(),
                                       n.fluid.row.data(),
                                       0,
                                       n.fluid.lattice.edge,
                                       fluid.kernel};
            const auto rows = static_cast<std::size_t>(chunk_slots * n.fluid_fluid.most_chunks());
            RecordMemory memory;
            std::byte* const local = memory.at_least(rows * sizeof(RecordRow<Stored, Real>));
            for (Index b = 0; b < static_cast<Index>(n.fluid_fluid.blocks().size()); ++b) {
                loops.all_terms(view, b, local, terms);
            }
        },
        fluid.pair_data);
}

// Through memory go the lists once, the records once (neighbours come from the caches), and the
// sums, read and written.
double memory_traffic(const Fluid& fluid, std::size_t list_bytes)
{
    using Sums = Union<PressureForce::Writes, DensityDiffusion::Writes, Continuity::Writes,
                       Viscosity::Writes>;
    const double record = fluid.parameters.precision == Precision::single_precision
                              ? sizeof(RecordRow<Stored, float>)
                              : sizeof(RecordRow<Stored, double>);
    return static_cast<double>(list_bytes) + static_cast<double>(fluid.particles.fluid.size()) *
                                                 (record + 2 * sizeof(real) * Sums::scalars);
}

} // namespace

double flops_of_a_pair()
{
    Operations all;
    Record<Stored, Counted> i, j;
    for_each(Stored{}, [&](auto field) {
        for (auto* record : {&i, &j}) {
            if constexpr (width<decltype(field)> == 3) {
                (*record)[field] = {Counted::input(all), Counted::input(all), Counted::input(all)};
            } else {
                (*record)[field] = Counted::input(all);
            }
        }
    });
    using Out = Union<PressureForce::Writes, DensityDiffusion::Writes, Continuity::Writes,
                      Viscosity::Writes>;
    Record<Out, Counted> sum;
    const auto ij = Kernel{}(i[field::position] - j[field::position]);
    PressureForce{}(ij, i, j, sum);
    DensityDiffusion{}(ij, i, j, sum);
    Continuity{}(ij, i, j, sum);
    Viscosity{}(ij, i, j, sum);
    std::vector<int> results;
    for_each(Out{}, [&](auto field) {
        if constexpr (width<decltype(field)> == 3) {
            for (const Counted* part : {&sum[field].x, &sum[field].y, &sum[field].z}) {
                results.push_back(part->node());
            }
        } else {
            results.push_back(sum[field].node());
        }
    });
    return all.needed_for(results);
}

LoopRates measure_loops(const LoopSetting& setting)
{
    set_threads(1);
    Fluid fluid = make_cube(setting);
    update_neighbours(fluid);
    update_pressure(fluid);
    const PairList& list = fluid.neighbours.fluid_fluid;
    const double pairs = pairs_within_support(fluid, list);
    const auto n = static_cast<double>(fluid.particles.fluid.size());
    const auto time = [&](const auto& call) { return median_time(setting.seconds, call); };
    const double build = time([&] { rebuild_neighbours(fluid); });
    const double all = time([&] { sweep_all(fluid); });
    return {.setting = setting,
            .neighbours = pairs / n,
            .hit_share = pairs / static_cast<double>(list.entries()),
            .all_terms = pairs / all,
            .forces = pairs / time([&] { update_forces(fluid, 1e-4); }),
            .rates = pairs / time([&] { update_rates(fluid); }),
            .pressure = n / time([&] { update_pressure(fluid); }),
            .lists = pairs / build,
            .lists_in_loops = build / all,
            .list_bytes = static_cast<double>(list.bytes()) / n,
            .flops = flops_of_a_pair(),
            .bytes = memory_traffic(fluid, list.bytes()) / pairs};
}

} // namespace hyoryu::bench
