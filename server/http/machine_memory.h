#pragma once

#include <cstdint>

namespace patchlight::server {

/// What this program may use: the machine's memory, or what its container has of it [bytes].
std::uint64_t machine_memory();

}  // namespace patchlight::server
