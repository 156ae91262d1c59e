// SPDX-License-Identifier: MIT
#include "hyoryu/core/parallel.hpp"

#include "hyoryu/core/error.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <latch>
#include <system_error>
#include <thread>
#include <vector>

namespace hyoryu {

namespace {

// Starts the threads of a loop once as a test: if OpenMP cannot start a thread, it ends the program
// with a message of its own.
void expect_threads(int threads)
{
    std::latch all(1);
    std::vector<std::jthread> started;
    try {
        while (static_cast<int>(started.size()) < threads - 1) {
            started.emplace_back([&all] { all.wait(); });
        }
        all.count_down();
    } catch (const std::system_error&) {
        all.count_down();
        throw IoError(fmt::format(
            "only {} of {} threads can be started: the limit on memory or processes is reached\n"
            "  hint: request fewer with --threads or OMP_NUM_THREADS, or raise the limits (`ulimit "
            "-u`, `ulimit -v`); a smaller `ulimit -s` reduces the memory of each thread",
            started.size() + 1, threads));
    }
}

} // namespace

void set_threads(int threads)
{
    // Before it is first set, this is what OMP_NUM_THREADS says, else the number of processors.
    static const int offered = omp_get_max_threads();
    const int wanted = threads > 0 ? threads : offered;
    constexpr int most = 4096; // as of --threads
    if (wanted > most) {
        throw CaseError(fmt::format("OMP_NUM_THREADS requests {} threads, at most {} are allowed",
                                    wanted, most),
                        "set it to the number of processors, or give --threads");
    }
    expect_threads(wanted);
    omp_set_num_threads(wanted);
}

int thread_count()
{
    return omp_get_max_threads();
}

int worker()
{
    return omp_get_thread_num();
}

} // namespace hyoryu
