#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace patchlight::server {

/// What the colours of a picture stand for.
struct FalseColourReport {
    double least = 0.0;     // shown in the first colour [unit]
    double most = 0.0;      // and in the last [unit]
    bool is_mapped = true;  // else the picture holds the quantity itself
};

/// A picture that was made.
struct ImageReport {
    std::string camera;
    std::string content_type;
    int width = 0;                   // [pixels]
    int height = 0;                  // [pixels]
    std::optional<double> exposure;  // of pictures made to be looked at [stops]
    std::optional<FalseColourReport> false_colour = {};
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
