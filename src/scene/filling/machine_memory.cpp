// SPDX-License-Identifier: MIT
#include "hyoryu/scene/machine_memory.hpp"

#include "hyoryu/core/types.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace hyoryu {

double machine_memory()
{
    double bytes = infinity;
    const long pages = ::sysconf(_SC_PHYS_PAGES);
    const long page = ::sysconf(_SC_PAGESIZE);
    if (pages > 0 && page > 0) {
        bytes = static_cast<double>(pages) * static_cast<double>(page);
    }
    double group = 0; // the file holds a number or "max", or is not there
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> group) {
        bytes = std::min(bytes, group);
    }
    struct rlimit own = {};
    if (::getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY) {
        bytes = std::min(bytes, static_cast<double>(own.rlim_cur));
    }
    return bytes;
}

} // namespace hyoryu
