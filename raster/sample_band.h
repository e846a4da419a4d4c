#pragma once

#include "raster/sample_pattern.h"
#include "raster/shaded_triangle.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patchlight::raster {

/// The samples of a few rows of the picture, with a z-buffer.
class SampleBand {
  public:
    /// Starts empty: colour 0, infinitely far. Rows are those of the whole picture.
    void reset(const SamplePattern& pattern, int width, Span rows);

    /// Draws the triangles in the order given. Where two are equally near the later one is seen.
    void draw(std::span<const ShadedTriangle> triangles, std::span<const std::uint32_t> order);

    /// Mean colour of the samples of each pixel, into rgb of size 3 * width * rows.
    void average(std::span<float> rgb) const;

  private:
    SamplePattern pattern_;
    int width_ = 0;
    Span rows_;
    // For each pixel: nearness, r, g, b of its lanes, group after group of lanes.
    std::vector<float> samples_;
};

}  // namespace patchlight::raster
