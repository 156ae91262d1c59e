// SPDX-License-Identifier: MIT
#include "clock.hpp"
#include "hot_loops.hpp"
#include "hyoryu/bench/bench.hpp"

#include "hyoryu/core/parallel.hpp"

namespace hyoryu::bench {

namespace {

constexpr int tries = 5;
constexpr Index doubles_in_stream = Index(1) << 23; // 64 MiB, beyond the caches

// The chains on every thread at once; flop/s together.
template <class Real>
double chain_rate(InstructionSet set, int threads, double seconds)
{
    const auto& loops = std::get<HotLoops<Real>>(hot_loops_for(set));
    std::vector<double> results(static_cast<std::size_t>(threads));
    const auto run = [&](Index rounds) {
        set_threads(threads);
        parallel_blocks(
            0, threads,
            [&](Index k) {
                results[k] = loops.chains(rounds, 0.999, 1e-3 * static_cast<double>(k + 1));
            },
            2);
    };
    Index rounds = 100'000;
    const double pilot = best_time(2, [&] { run(rounds); });
    rounds = static_cast<Index>(static_cast<double>(rounds) * seconds / pilot) + 1;
    const double best = best_time(tries, [&] { run(rounds); });
    return loops.flops_of_a_round * static_cast<double>(rounds) * threads / best;
}

double triad_rate(int threads)
{
    set_threads(threads);
    constexpr auto n = static_cast<std::size_t>(doubles_in_stream);
    // Written first by the threads that use it, whose memory it then is.
    const auto a = std::make_unique_for_overwrite<double[]>(n);
    const auto b = std::make_unique_for_overwrite<double[]>(n);
    const auto c = std::make_unique_for_overwrite<double[]>(n);
    const auto at = [](Index k) { return static_cast<std::size_t>(k); };
    parallel_for(0, doubles_in_stream, [&](Index k) {
        a[at(k)] = 0;
        b[at(k)] = 1;
        c[at(k)] = static_cast<double>(k);
    });
    const double best = best_time(tries, [&] {
        parallel_for(0, doubles_in_stream, [&](Index k) { a[at(k)] = b[at(k)] + 3 * c[at(k)]; });
    });
    return 3 * sizeof(double) * static_cast<double>(doubles_in_stream) / best;
}

} // namespace

MachineLimits measure_limits(InstructionSet set, int threads, double seconds)
{
    return {.fma_single = chain_rate<float>(set, 1, seconds),
            .fma_double = chain_rate<double>(set, 1, seconds),
            .fma_single_all = chain_rate<float>(set, threads, seconds),
            .triad = triad_rate(1),
            .triad_all = triad_rate(threads)};
}

} // namespace hyoryu::bench
