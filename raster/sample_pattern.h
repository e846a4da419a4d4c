#pragma once

#include <array>
#include <cstdint>

namespace patchlight::raster {

/// Screen positions are whole multiples of 1/256 pixel, so that edge functions are exact.
inline constexpr int subpixels = 256;
/// Widest picture whose edge functions cannot overflow [pixels].
inline constexpr int most_pixels = 16384;
/// Samples are worked on this many at a time.
inline constexpr int lane_group = 8;
inline constexpr int most_samples_per_axis = 8;
inline constexpr int most_lanes = most_samples_per_axis * most_samples_per_axis;

/// Where a pixel is sampled. Lanes are the samples rounded up to whole groups; the surplus lanes
/// repeat the last sample and weigh nothing.
struct SamplePattern {
    int count = 0;
    int lanes = 0;
    std::array<std::int32_t, most_lanes> x{};              // from the left side [1/256 pixel]
    std::array<std::int32_t, most_lanes> y{};              // from the top [1/256 pixel]
    alignas(32) std::array<float, most_lanes> x_pixels{};  // the same [pixels]
    alignas(32) std::array<float, most_lanes> y_pixels{};
};

/// A grid of samples_per_axis² samples (1 to 8 an axis) turned a little, so that no two share a
/// row or a column: an upright or level edge has as many grades as there are samples.
SamplePattern sample_pattern(int samples_per_axis);

}  // namespace patchlight::raster
