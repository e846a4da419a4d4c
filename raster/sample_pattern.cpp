#include "raster/sample_pattern.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace patchlight::raster {

SamplePattern sample_pattern(int samples_per_axis) {
    if (samples_per_axis < 1 || samples_per_axis > most_samples_per_axis)
        throw std::invalid_argument("samples per axis must be 1 to 8");
    const int n = samples_per_axis;
    SamplePattern pattern;
    pattern.count = n * n;
    pattern.lanes = (pattern.count + lane_group - 1) / lane_group * lane_group;
    const auto on_grid = [&](int rank) {
        return static_cast<std::int32_t>(std::lround((rank + 0.5) * subpixels / pattern.count));
    };
    for (int lane = 0; lane < pattern.lanes; ++lane) {
        const int sample = std::min(lane, pattern.count - 1);
        const int column = sample % n;
        const int row = sample / n;
        const auto at = static_cast<std::size_t>(lane);
        pattern.x[at] = on_grid(column * n + row);
        pattern.y[at] = on_grid(row * n + (n - 1 - column));
        pattern.x_pixels[at] = static_cast<float>(pattern.x[at]) / subpixels;
        pattern.y_pixels[at] = static_cast<float>(pattern.y[at]) / subpixels;
    }
    return pattern;
}

}  // namespace patchlight::raster
