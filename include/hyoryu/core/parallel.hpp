// SPDX-License-Identifier: MIT
// Parallel loops and sums that give the same bits for any number of threads: a loop body writes
// only its own row, and sums are taken over fixed chunks in a fixed order. Where rows begin decides
// the chunks: sums of rounded numbers that belong to the state are those of fixed_sum.hpp.
#pragma once

#include "hyoryu/core/types.hpp"

#include <algorithm>
#include <array>

namespace hyoryu {

/// Sets the number of threads of parallel loops. 0 or less: the value of OMP_NUM_THREADS,
/// or else the number of processors.
void set_threads(int threads);
int thread_count();
/// Number of the calling thread within a parallel loop, below thread_count().
int worker();

// Below these sizes waking the other threads costs more than they save. The loop then runs without
// a parallel region, since even a region of one thread costs as much as some rows.
inline constexpr Index worth_sharing_rows = 4096;
inline constexpr Index worth_sharing_blocks = 16;

/// Calls f(k) for k in [begin, end), each of a few operations; every thread gets an equal share.
/// Fewer rows than `worth` stay on the calling thread.
template <class F>
void parallel_for(Index begin, Index end, const F& f, Index worth = worth_sharing_rows)
{
    if (end - begin < worth) {
        for (Index k = begin; k < end; ++k) {
            f(k);
        }
        return;
    }
#pragma omp parallel for schedule(static)
    for (Index k = begin; k < end; ++k) {
        f(k);
    }
}

/// Approximate number of runs of blocks that a thread gets in one loop.
inline constexpr Index runs_of_a_thread = 32;

/// Calls f(k) for k in [begin, end), each a block of much and uneven work. The threads take runs of
/// consecutive blocks dynamically: consecutive blocks read the same neighbours, which would
/// otherwise move between the caches of the threads. Fewer blocks than `worth` stay on the calling
/// thread.
template <class F>
void parallel_blocks(Index begin, Index end, const F& f, Index worth = worth_sharing_blocks)
{
    if (end - begin < worth) {
        for (Index k = begin; k < end; ++k) {
            f(k);
        }
        return;
    }
    const Index run = std::max<Index>((end - begin) / (runs_of_a_thread * thread_count()), 1);
#pragma omp parallel for schedule(dynamic, run)
    for (Index k = begin; k < end; ++k) {
        f(k);
    }
}

/// Chunks of a sum: at most `most_chunks`, each of at least `chunk_rows` rows except the last. The
/// chunks, not the threads, decide the order of additions.
inline constexpr Index most_chunks = 256;
inline constexpr Index chunk_rows = 1024;

/// add(... add(add(zero, f(begin)), f(begin + 1)) ...) in fixed chunks.
template <class T, class F, class Add>
T reduce(Index begin, Index end, const T& zero, const F& f, const Add& add)
{
    const Index rows = std::max<Index>(end - begin, 0);
    const Index length = std::max(chunk_rows, (rows + most_chunks - 1) / most_chunks);
    const Index chunks = (rows + length - 1) / length;
    std::array<T, most_chunks> partial;
    const auto add_up = [&](Index chunk) {
        T total = zero;
        const Index first = begin + chunk * length;
        const Index last = std::min(end, first + length);
        for (Index k = first; k < last; ++k) {
            total = add(total, f(k));
        }
        partial[chunk] = total;
    };
    parallel_for(0, chunks, add_up, worth_sharing_blocks);
    T total = zero;
    for (Index chunk = 0; chunk < chunks; ++chunk) {
        total = add(total, partial[chunk]);
    }
    return total;
}

/// Sum of f(k) over the rows; T needs +.
template <class T, class F>
T sum(Index begin, Index end, const T& zero, const F& f)
{
    return reduce(begin, end, zero, f, [](const T& a, const T& b) { return T(a + b); });
}

/// Largest f(k), or `lowest` if there are no rows.
template <class F>
real largest(Index begin, Index end, real lowest, const F& f)
{
    return reduce(begin, end, lowest, f, [](real a, real b) { return a > b ? a : b; });
}

} // namespace hyoryu
