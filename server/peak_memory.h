#pragma once

#include <sys/resource.h>

#include <cstdint>

namespace patchlight::server {

/// Of the whole process so far [bytes].
inline std::uint64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    constexpr std::uint64_t kibibyte = 1024;  // what Linux counts in
    return static_cast<std::uint64_t>(usage.ru_maxrss) * kibibyte;
}

}  // namespace patchlight::server
