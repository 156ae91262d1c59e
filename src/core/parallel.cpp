// SPDX-License-Identifier: MIT
#include "hyoryu/core/parallel.hpp"

#include <omp.h>

namespace hyoryu {

void set_threads(int threads)
{
    // Before it is first set, this is what OMP_NUM_THREADS says, else the number of processors.
    static const int offered = omp_get_max_threads();
    omp_set_num_threads(threads > 0 ? threads : offered);
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
