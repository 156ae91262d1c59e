// SPDX-License-Identifier: MIT
#include "hyoryu/core/parallel.hpp"

#include <omp.h>

namespace hyoryu {

void set_threads(int threads)
{
    omp_set_num_threads(threads > 0 ? threads : omp_get_num_procs());
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
