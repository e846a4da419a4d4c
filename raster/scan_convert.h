#pragma once

#include "raster/edge_functions.h"

namespace patchlight::raster {

/// The corners clockwise on the screen; nothing is drawn of others.
using ScreenCorners = std::array<FixedPoint, 3>;

/// The edge functions of a triangle, walked from row to row.
class TriangleEdges {
  public:
    [[gnu::always_inline]] TriangleEdges(const ScreenCorners& corners, const SamplePattern& pattern,
                                         int row) {
        set_up(edges_[0], corners[0], corners[1], pattern, row);
        set_up(edges_[1], corners[1], corners[2], pattern, row);
        set_up(edges_[2], corners[2], corners[0], pattern, row);
    }

    [[gnu::always_inline]] void next_row() {
        for (EdgeFunction& edge : edges_) edge.value += edge.per_row;
    }

    /// Pixels of the span with a covered sample; now and then one without, at a corner.
    [[gnu::always_inline]] Span touched(Span span) const {
        for (const EdgeFunction& edge : edges_)
            narrow(span, edge.value + edge.most, edge.per_pixel);
        return span;
    }

    /// Pixels of the span with every sample covered.
    [[gnu::always_inline]] Span filled(Span span) const {
        for (const EdgeFunction& edge : edges_)
            narrow(span, edge.value + edge.least, edge.per_pixel);
        return span;
    }

    /// Which samples of a pixel are covered, for the group of lanes that starts at `lane`.
    [[gnu::always_inline]] IntLanes covered(int column, int lane) const {
        IntLanes mask = IntLanes{} == IntLanes{};
        for (const EdgeFunction& edge : edges_) {
            const std::int64_t missing = -(edge.value + column * edge.per_pixel);
            const auto threshold = static_cast<std::int32_t>(
                std::clamp<std::int64_t>(missing, std::numeric_limits<std::int32_t>::min(),
                                         std::numeric_limits<std::int32_t>::max()));
            IntLanes at_sample;
            std::memcpy(&at_sample, &edge.at_sample[static_cast<std::size_t>(lane)],
                        sizeof at_sample);
            mask &= at_sample >= threshold;
        }
        return mask;
    }

  private:
    std::array<EdgeFunction, 3> edges_;
};

/// Finds the samples that a triangle covers in rows [first, last) of a picture `width` pixels wide.
/// Triangles that share an edge cover each sample beside it once: none twice, none missing.
/// Calls sink.filled(row, columns) for runs of pixels with every sample covered and
/// sink.partly(row, column, edges) for single pixels, of which edges.covered tells the samples.
/// Pineda, "A Parallel Algorithm for Polygon Rasterization", 1988.
template <class Sink>
[[gnu::always_inline]] inline void scan_convert(const ScreenCorners& corners,
                                                const SamplePattern& pattern, int width, Span rows,
                                                Sink& sink) {
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const Span box = {left / subpixels, std::min(width, right / subpixels + 1)};
    const int first_row = std::max(rows.first, top / subpixels);
    const int last_row = std::min(rows.last, bottom / subpixels + 1);
    if (box.empty() || first_row >= last_row) return;
    TriangleEdges edges(corners, pattern, first_row);
    for (int row = first_row; row < last_row; ++row, edges.next_row()) {
        const Span touched = edges.touched(box);
        if (touched.empty()) continue;
        Span filled = pattern.count == 1 ? touched : edges.filled(touched);
        if (filled.empty()) filled = {touched.last, touched.last};
        for (int x = touched.first; x < filled.first; ++x) sink.partly(row, x, edges);
        if (!filled.empty()) sink.filled(row, filled);
        for (int x = filled.last; x < touched.last; ++x) sink.partly(row, x, edges);
    }
}

}  // namespace patchlight::raster
