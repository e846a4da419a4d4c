#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// A picture that was made.
struct ImageReport {
    std::string camera;
    std::string content_type;
    int width = 0;                   // [pixels]
    int height = 0;                  // [pixels]
    std::optional<double> exposure;  // of pictures made to be looked at [stops]
};

/// What a run knows beside its solution.
struct RunReport {
    std::vector<ImageReport> images;
    double load_seconds = 0.0;
    double render_seconds = 0.0;
    double total_seconds = 0.0;
    int threads = 1;
    std::uint64_t peak_memory = 0;  // of the whole process so far [bytes]
};

}  // namespace patchlight::server
