#pragma once

#include "server/http/http_limits.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// What one request may ask of the solver. Beyond it is refused before the work is begun; but a
/// time limit reached gives what there is.
struct RenderLimits {
    std::size_t patches = 20'000;
    std::uint64_t pixels = std::uint64_t{4096} * 4096;  // in all pictures of one answer
    std::size_t sensors = 10'000;
    std::size_t rays = 65'536;  // per patch; between two rows of patches nothing can be stopped
    std::uint64_t memory = 0;   // of one solve; 0: no limit [bytes]
    double seconds = 30.0;      // for one solve [s]
    int at_once = 1;            // solves that run side by side
    int waiting = 8;            // solves that wait for their turn
};

struct ServiceSettings {
    std::string host = "127.0.0.1";
    std::vector<std::string> allowed_hosts;  // names it is reached by, beside its own
    std::optional<std::string> token;        // what clients have to show
    HttpLimits http;
    RenderLimits render;
    int threads = 0;  // that a solve uses; 0: all cores
};

}  // namespace patchlight::server
