#pragma once

#include "raster/lanes.h"
#include "raster/sample_pattern.h"
#include "raster/screen.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace patchlight::raster {

/// Pixels [first, last) of a row.
struct Span {
    int first = 0;
    int last = 0;

    bool empty() const { return first >= last; }
};

/// a x + b y + c on the 1/256 pixel grid, positive inside; exact in 64 bits. One less where a
/// sample on the edge belongs to the neighbour, so that value >= 0 means covered.
struct EdgeFunction {
    std::int64_t value = 0;  // at the top left corner of the row's first pixel
    std::int64_t per_pixel = 0;
    std::int64_t per_row = 0;
    std::int64_t least = 0;  // over the samples of a pixel, relative to its corner
    std::int64_t most = 0;
    alignas(32) std::array<std::int32_t, most_lanes> at_sample;  // the same for each sample
};

/// The inside of the edge from -> to lies at its right hand on the screen. Samples on a top or left
/// edge are covered, those on a bottom or right edge are not.
[[gnu::always_inline]] inline void set_up(EdgeFunction& edge, const FixedPoint& from,
                                          const FixedPoint& to, const SamplePattern& pattern,
                                          int row) {
    const std::int32_t a = from.y - to.y;
    const std::int32_t b = to.x - from.x;
    const bool top_or_left = a > 0 || (a == 0 && b > 0);
    edge.per_pixel = std::int64_t{a} * subpixels;
    edge.per_row = std::int64_t{b} * subpixels;
    edge.value = row * edge.per_row - std::int64_t{a} * from.x - std::int64_t{b} * from.y -
                 (top_or_left ? 0 : 1);
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    std::int32_t most = std::numeric_limits<std::int32_t>::min();
    for (std::size_t lane = 0; lane < static_cast<std::size_t>(pattern.lanes); ++lane) {
        const std::int32_t value = a * pattern.x[lane] + b * pattern.y[lane];
        edge.at_sample[lane] = value;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    edge.least = least;
    edge.most = most;
}

/// Narrows the span to the pixels where value + per_pixel * x >= 0. Quotients of whole numbers
/// below 2^53 never round across a whole number, so doubles decide exactly.
[[gnu::always_inline]] inline void narrow(Span& span, std::int64_t value, std::int64_t per_pixel) {
    if (per_pixel == 0) {
        if (value < 0) span.last = span.first;
        return;
    }
    const double root = -static_cast<double>(value) / static_cast<double>(per_pixel);
    const auto whole = static_cast<std::int64_t>(root);
    if (per_pixel > 0) {
        const std::int64_t above = whole + (static_cast<double>(whole) < root ? 1 : 0);
        span.first = static_cast<int>(std::clamp<std::int64_t>(above, span.first, span.last));
    } else {
        const std::int64_t below = whole - (static_cast<double>(whole) > root ? 1 : 0);
        span.last = static_cast<int>(std::clamp<std::int64_t>(below + 1, span.first, span.last));
    }
}

}  // namespace patchlight::raster
