#include "core/base/memory_limit.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace grainfield::core {

double memory_of_process() {
    double memory =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        memory = std::min(memory, static_cast<double>(limit.rlim_cur));
    double group = 0.0;  // "max" where there is no limit
    if (std::ifstream("/sys/fs/cgroup/memory.max") >> group && group > 0.0)
        memory = std::min(memory, group);
    return memory;
}

}  // namespace grainfield::core
