#include "server/http/machine_memory.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace patchlight::server {

std::uint64_t machine_memory() {
    constexpr std::uint64_t if_unknown = std::uint64_t{8} << 30;
    const long pages = ::sysconf(_SC_PHYS_PAGES);
    const long page = ::sysconf(_SC_PAGESIZE);
    std::uint64_t memory = if_unknown;
    if (pages > 0 && page > 0)
        memory = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
    std::ifstream limit("/sys/fs/cgroup/memory.max");  // "max" where there is no limit
    std::uint64_t bytes = 0;
    if (limit >> bytes) memory = std::min(memory, bytes);
    return memory;
}

}  // namespace patchlight::server
